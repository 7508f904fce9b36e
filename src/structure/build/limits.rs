//! How much a build has taken and may take.

use super::error::BuildError;
use crate::geometry::Aabb;
use crate::structure::frame::ObjectPlanes;
use crate::structure::method::Structure;
use crate::structure::node::Node;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// What the parts of a build hold together. Whether a tree fits does not depend on the order in which
/// its parts are built: counts only grow, and what is estimated follows from them.
pub(super) struct Limits {
    /// Bytes.
    limit: u64,
    objects: usize,
    structure: Structure,
    nodes: AtomicUsize,
    references: AtomicUsize,
    /// Objects in the lists of the cells from the root to a cell, the most of any cell.
    pending: AtomicUsize,
}

/// Arrays take up to this many times what is in them: twice where they have just grown, and once more
/// while what was built apart is put together.
const GROWTH: usize = 3;

impl Limits {
    /// For a scene of so many objects.
    pub(super) fn new(limit: u64, objects: usize, structure: Structure) -> Self {
        Limits {
            limit,
            objects,
            structure,
            nodes: AtomicUsize::new(0),
            references: AtomicUsize::new(0),
            pending: AtomicUsize::new(0),
        }
    }

    /// Takes so many more nodes and references into account, for a cell at `depth`.
    ///
    /// # Errors
    /// The tree would take more than the limit with them.
    pub(super) fn take(
        &self,
        depth: u32,
        nodes: usize,
        references: usize,
    ) -> Result<(), BuildError> {
        let held_nodes = self.nodes.fetch_add(nodes, Relaxed);
        let held_references = self.references.fetch_add(references, Relaxed);
        let (all, all_references) = (held_nodes + nodes, held_references + references);
        let tree = all * size_of::<Node>() + all_references * size_of::<u32>();
        let lists = self.pending.load(Relaxed) * size_of::<u32>();
        let objects = self.objects * (size_of::<Aabb>() + size_of::<ObjectPlanes>());
        let bytes = tree.saturating_mul(GROWTH) + lists + objects;
        if bytes as u64 <= self.limit && all < Node::MAX_NODES && all_references < u32::MAX as usize
        {
            return Ok(());
        }
        Err(BuildError::MemoryLimit {
            limit: self.limit,
            depth,
            nodes: held_nodes,
            references: held_references,
            structure: self.structure,
        })
    }

    /// Takes into account that lists of so many objects wait on the way to a cell at `depth`.
    ///
    /// # Errors
    /// As for [`Limits::take`].
    pub(super) fn reserve_pending(&self, depth: u32, objects: usize) -> Result<(), BuildError> {
        if self.pending.fetch_max(objects, Relaxed) < objects {
            self.take(depth, 0, 0)?;
        }
        Ok(())
    }
}
