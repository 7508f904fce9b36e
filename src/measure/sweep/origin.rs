//! Where and by what rows are measured.

use crate::measure::processor;
use crate::setup::Setup;
use std::fmt;

/// The machine and the program that measured a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The name of the processor, or `unknown`.
    pub processor: String,
    /// What the kernel is compiled for: `AVX-512`, `AVX2` or `portable`, or the architecture for the scalar kernel.
    pub instruction_set: String,
    /// The kernel that traced the rays. `auto` is resolved.
    pub kernel: String,
    /// The version of the program.
    pub version: String,
}

/// The titles of the columns of an origin.
pub(super) const TITLES: [&str; 4] = ["processor", "instruction_set", "kernel", "version"];

impl Origin {
    /// Returns the origin of what is measured here with this setup.
    pub fn here(setup: &Setup) -> Origin {
        let structure = setup.build.method.structure;
        let [kernel, instruction_set] = setup.render.kernel.names_for(structure);
        Origin {
            processor: processor().unwrap_or("unknown").to_owned(),
            instruction_set: instruction_set.to_owned(),
            kernel: kernel.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }

    /// Returns the cells of a row, in the order of [`TITLES`].
    pub(super) fn cells(&self) -> [&str; 4] {
        [
            &self.processor,
            &self.instruction_set,
            &self.kernel,
            &self.version,
        ]
    }

    /// Returns whether a ratio of times from here and from there is one of the trees or the kernels. Kernels are
    /// settings, so different ones may have different instruction sets.
    pub(super) fn is_comparable(&self, other: &Origin) -> bool {
        self.processor == other.processor
            && self.version == other.version
            && (self.kernel != other.kernel || self.instruction_set == other.instruction_set)
    }
}

impl fmt::Display for Origin {
    /// Writes the processor, and the other three in parentheses.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [processor, instruction_set, kernel, version] = self.cells();
        write!(
            f,
            "{processor} ({kernel}, {instruction_set}, version {version})"
        )
    }
}
