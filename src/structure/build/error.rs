//! Why a build fails.

use crate::progress::Cancelled;
use crate::structure::method::Structure;
use crate::structure::node::Node;
use crate::structure::settings::SettingsError;

/// Why a tree could not be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(
        "the tree exceeds the memory limit of {} MiB: stopped at depth {depth} after {nodes} nodes \
         and {references} references; {} or raise the limit",
        .limit >> 20,
        .structure.how_to_shrink()
    )]
    MemoryLimit {
        /// Bytes.
        limit: u64,
        depth: u32,
        /// Approximate: the exact number depends on the order in which threads work.
        nodes: usize,
        references: usize,
        /// The structure that the method builds.
        structure: Structure,
    },
    #[error("the scene has {0} objects; a tree can hold {most}", most = Node::MAX_LEAF - 1)]
    TooManyObjects(usize),
}
