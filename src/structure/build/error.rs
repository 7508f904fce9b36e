//! Why a build fails.

use crate::progress::Cancelled;
use crate::structure::method::Structure;
use crate::structure::node::Node;
use crate::structure::settings::SettingsError;
use crate::structure::tree_file::TreeFileError;
use std::path::PathBuf;

/// Objects that overlap each other so that no further split separates them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inseparable {
    pub objects: usize,
    /// A lower bound on the number of leaves that would hold all of them.
    pub leaves: u64,
}

/// Why a tree could not be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(
        "the tree exceeds the memory limit of {} MiB: {}; {} or raise the limit",
        .limit >> 20,
        match .inseparable {
            None => format!(
                "stopped at depth {depth} after {nodes} nodes and {references} references"
            ),
            Some(Inseparable { objects, leaves }) => format!(
                "at depth {depth}, {objects} objects lie in one place, and the method would split them \
                 into at least {leaves} leaves that all hold every one of them"
            ),
        },
        .structure.how_to_shrink()
    )]
    MemoryLimit {
        /// Bytes.
        limit: u64,
        depth: u32,
        /// Approximate: the exact number depends on the order in which threads work.
        nodes: usize,
        references: usize,
        /// Why the build stopped long before the limit; `None` if it reached the limit.
        inseparable: Option<Inseparable>,
        /// The structure that the method builds.
        structure: Structure,
    },
    #[error(
        "the hierarchy may need {} MiB, more than the memory limit of {} MiB; choose a method with fewer \
         references or raise the limit",
        .needed.div_ceil(1 << 20), .limit >> 20
    )]
    HierarchyTooLarge {
        /// Bytes.
        needed: u64,
        limit: u64,
    },
    #[error("{}: {reason}", .path.display())]
    File {
        path: PathBuf,
        reason: TreeFileError,
    },
    #[error("the scene has {0} objects; a tree can hold {most}", most = Node::MAX_LEAF - 1)]
    TooManyObjects(usize),
}

impl BuildError {
    /// Returns whether the tree is too large, so that one with other settings may be built nevertheless.
    pub fn is_too_large(&self) -> bool {
        matches!(
            self,
            BuildError::MemoryLimit { .. }
                | BuildError::HierarchyTooLarge { .. }
                | BuildError::TooManyObjects(_)
        )
    }
}
