//! The memory limit of a build.

use super::error::{BuildError, Inseparable};
use crate::geometry::Aabb;
use crate::structure::frame::ObjectPlanes;
use crate::structure::method::Structure;
use crate::structure::node::Node;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Counts the memory that all parts of a build use together. Whether a tree fits does not depend on
/// the order in which its parts are built, because counts only grow and the estimate follows from
/// them.
pub(super) struct Limits {
    /// Bytes.
    limit: u64,
    objects: usize,
    structure: Structure,
    nodes: AtomicUsize,
    references: AtomicUsize,
    /// Maximum over all cells of the objects in the lists of the cells from the root to that cell.
    pending: AtomicUsize,
}

/// Arrays take up to this many times the size of their content: twice after they have just grown,
/// and once more while parts that were built separately are joined.
const GROWTH: usize = 3;

impl Limits {
    /// Creates the limit for a scene with the given number of objects.
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

    /// Adds nodes and references for a cell at `depth`.
    ///
    /// # Errors
    /// The tree would exceed the limit.
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
            inseparable: None,
            structure: self.structure,
        })
    }

    /// Returns whether a tree with this many references certainly exceeds the limit.
    pub(super) fn are_too_many(&self, references: f64) -> bool {
        let bytes = references * (size_of::<u32>() * GROWTH) as f64;
        bytes > self.limit as f64 || references >= f64::from(u32::MAX)
    }

    /// Returns the error for a cell at `depth` whose tree certainly exceeds the limit.
    pub(super) fn inseparable(&self, depth: u32, inseparable: Inseparable) -> BuildError {
        BuildError::MemoryLimit {
            limit: self.limit,
            depth,
            nodes: self.nodes.load(Relaxed),
            references: self.references.load(Relaxed),
            inseparable: Some(inseparable),
            structure: self.structure,
        }
    }

    /// Accounts for the lists of objects that are pending on the path to a cell at `depth`.
    ///
    /// # Errors
    /// The same as for [`Limits::take`].
    pub(super) fn reserve_pending(&self, depth: u32, objects: usize) -> Result<(), BuildError> {
        if self.pending.fetch_max(objects, Relaxed) < objects {
            self.take(depth, 0, 0)?;
        }
        Ok(())
    }
}
