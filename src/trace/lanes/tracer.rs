//! The kernel that a pass is timed with, and its choice.

use super::{InstructionSet, SimdKernel, SimdMode, SimdTree};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{Batch, Hit, RayTracer, ScalarKernel};
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

    /// `scalar`, `stream`, `packets` or `auto`.
    pub const fn name(self) -> &'static str {
        ["scalar", "stream", "packets", "auto"][self as usize]
    }

    /// The name in earlier versions, where it was another.
    pub const fn old_name(self) -> Option<&'static str> {
        match self {
            KernelChoice::Scalar => Some("plain"),
            KernelChoice::Stream => Some("lanes"),
            KernelChoice::Packets | KernelChoice::Auto => None,
        }
    }

    /// The choice of this name or old name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|choice| choice.name() == name || choice.old_name() == Some(name))
    }

    /// The SIMD traversal and instruction set on this processor; `None` for the scalar kernel.
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

    /// The kernel that is timed on this processor, for reports.
    pub fn description(self) -> String {
        match self.simd() {
            None => "scalar".into(),
            Some((mode, set)) => format!("{}, {}", mode.name(), set.name()),
        }
    }
}

/// Below this, lanes stand idle too long (`cargo bench --bench peers`): the plain kernel is as fast.
const FEWEST_RAYS: usize = 64;

/// Rays that are traced between two looks at whether the task was cancelled: about a millisecond.
const RAYS_PER_LOOK: usize = 4096;

/// The kernel whose time counts.
pub struct TimedKernel<'a> {
    plain: ScalarKernel<'a>,
    lanes: Option<SimdKernel<'a>>,
    progress: &'a Progress,
}

impl<'a> TimedKernel<'a> {
    /// The kernel of this choice; `shapes` are the scene's, and the tree is of it. The first that uses
    /// lanes makes the tree ready for them.
    pub fn new(
        choice: KernelChoice,
        scene: &Scene,
        tree: &'a Tree,
        shapes: &'a Shapes,
        progress: &'a Progress,
    ) -> Self {
        let lanes = choice.simd().map(|(mode, instructions)| {
            let lanes = SimdTree::of(scene, tree);
            SimdKernel::new(tree, lanes, shapes, instructions, mode)
        });
        TimedKernel {
            plain: ScalarKernel::new(tree, shapes, progress),
            lanes,
            progress,
        }
    }

    /// Asks the lanes about a batch, a stretch after the other; `false` where the plain kernel is to.
    fn in_lanes<A: Copy>(
        &mut self,
        rays: &[Ray],
        miss: A,
        answers: &mut Vec<A>,
        ask: impl Fn(&mut SimdKernel<'a>, &[Ray], &mut [A]),
    ) -> bool {
        let Some(kernel) = self.lanes.as_mut().filter(|_| rays.len() >= FEWEST_RAYS) else {
            return false;
        };
        answers.clear();
        answers.resize(rays.len(), miss);
        let stretches = rays
            .chunks(RAYS_PER_LOOK)
            .zip(answers.chunks_mut(RAYS_PER_LOOK));
        for (rays, answers) in stretches {
            if self.progress.is_cancelled() {
                break;
            }
            ask(kernel, rays, answers);
        }
        true
    }
}

impl RayTracer for TimedKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        if !self.in_lanes(batch.rays, Hit::MISS, hits, SimdKernel::closest_hits) {
            self.plain.closest_hits(batch, hits);
        }
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        if !self.in_lanes(batch.rays, false, blocked, SimdKernel::any_hits) {
            self.plain.any_hits(batch, blocked);
        }
    }
}
