//! Streams: every lane traverses the tree with a ray of its own.

mod stacks;
mod traversal;

pub(super) use stacks::Stacks;
pub(super) use traversal::traverse;
