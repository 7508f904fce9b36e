//! Why the tree of a file could not be read.

use super::faults::Faults;
use crate::progress::Cancelled;

/// Why the tree of a file could not be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TreeFileError {
    #[error("{0}")]
    Io(String),
    #[error("not the header of a tree file: {0}")]
    Header(String),
    #[error("array '{name}': {reason}")]
    Array { name: &'static str, reason: String },
    #[error(
        "a tree of {file} objects, but the scene has {scene}; is it another scene, or were faces skipped?"
    )]
    Objects { file: u32, scene: usize },
    #[error("the root cell: {0}")]
    Root(&'static str),
    #[error("larger than the memory limit of {} MiB", .0 >> 20)]
    TooLarge(u64),
    #[error("the file changed after it was opened; open it again")]
    Changed,
    #[error("the tree is broken:\n{0}")]
    Broken(Faults),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
