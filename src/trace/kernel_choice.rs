//! The choice of the kernel for timed rendering.

use super::{InstructionSet, SimdMode};
use crate::structure::split::Structure;
use serde::{Deserialize, Serialize};

/// The kernel chosen for timed rendering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KernelChoice {
    /// One ray after the other, through exactly the nodes that are counted: the paper's method.
    #[default]
    #[serde(alias = "plain")]
    Scalar,
    /// Streams of rays in SIMD, each ray with its own traversal, in the widest instruction set of
    /// the processor.
    #[serde(alias = "lanes")]
    Stream,
    /// The same instruction set for packets: neighboring rays of a batch traverse the tree together.
    Packets,
    /// Packets where rays are coherent, else streams; scalar on processors without a SIMD kernel of
    /// their own.
    Auto,
}

impl KernelChoice {
    pub const ALL: [KernelChoice; 4] = [
        KernelChoice::Scalar,
        KernelChoice::Stream,
        KernelChoice::Packets,
        KernelChoice::Auto,
    ];

    /// Returns `scalar`, `stream`, `packets` or `auto`.
    pub const fn name(self) -> &'static str {
        ["scalar", "stream", "packets", "auto"][self as usize]
    }

    /// Returns the name in earlier versions, if it was different.
    pub const fn old_name(self) -> Option<&'static str> {
        match self {
            KernelChoice::Scalar => Some("plain"),
            KernelChoice::Stream => Some("lanes"),
            KernelChoice::Packets | KernelChoice::Auto => None,
        }
    }

    /// Returns the choice of this name or old name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|choice| choice.name() == name || choice.old_name() == Some(name))
    }

    /// Returns the SIMD mode and instruction set on this processor; `None` for the scalar kernel.
    pub fn simd(self) -> Option<(SimdMode, InstructionSet)> {
        let best = InstructionSet::best();
        match self {
            KernelChoice::Scalar => None,
            KernelChoice::Stream => Some((SimdMode::Stream, best)),
            KernelChoice::Packets => Some((SimdMode::Packets, best)),
            KernelChoice::Auto => {
                Some((SimdMode::Auto, best)).filter(|_| best != InstructionSet::Portable)
            }
        }
    }

    /// Returns the kernel used on this processor for trees with planes, as reports name it.
    pub fn description(self) -> String {
        self.description_for(Structure::Bintree)
    }

    /// Returns the kernel used on this processor for a structure, as reports name it.
    pub fn description_for(self, structure: Structure) -> String {
        let [kernel, instruction_set] = self.names_for(structure);
        match self.simd() {
            None => kernel.to_owned(),
            Some(_) => format!("{kernel}, {instruction_set}"),
        }
    }

    /// Returns the names of the kernel used on this processor for a structure, and of the instruction set that it
    /// is compiled for. That of the scalar kernel is the architecture, such as `x86_64`.
    pub fn names_for(self, structure: Structure) -> [&'static str; 2] {
        match self.simd() {
            None => ["scalar", std::env::consts::ARCH],
            Some((mode, set)) => [mode.of(structure).name(), set.name()],
        }
    }
}
