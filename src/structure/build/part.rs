//! A subtree in its own arrays.

use super::cell_objects::CellObjects;
use super::error::BuildError;
use super::limits::Limits;
use crate::geometry::Axis;
use crate::structure::node::{Node, StopReason};

/// Nodes and references of a subtree in depth-first order, numbered from 0.
#[derive(Default)]
pub(super) struct Part {
    pub(super) nodes: Vec<Node>,
    pub(super) references: Vec<u32>,
    pub(super) depth_reached: u32,
    /// Fraction of the whole build that was done here and is not reported yet.
    pub(super) done: f64,
    /// Nodes and references that are already counted by [`Limits`].
    counted: [usize; 2],
    /// Lists to reuse for other cells.
    pub(super) spare: Vec<CellObjects>,
}

/// Nodes and references between two updates of [`Limits`].
const BATCH: usize = 1 << 10;

impl Part {
    pub(super) fn leaf(
        &mut self,
        limits: &Limits,
        objects: &CellObjects,
        depth: u32,
        stop: StopReason,
    ) -> Result<(), BuildError> {
        self.count(limits, depth, objects.len())?;
        let first = self.references.len() as u32;
        self.nodes
            .push(Node::leaf(first, objects.len() as u32, stop));
        self.references.extend_from_slice(&objects.inside);
        self.references.extend_from_slice(&objects.touching);
        self.references[first as usize..].sort_unstable();
        self.depth_reached = self.depth_reached.max(depth);
        self.done += libm::exp2(-f64::from(depth));
        Ok(())
    }

    /// Adds an inner node whose upper child is not known yet and returns its index.
    pub(super) fn inner(&mut self, limits: &Limits, depth: u32) -> Result<usize, BuildError> {
        self.count(limits, depth, 0)?;
        self.nodes.push(Node::inner(Axis::X, 0.0, 0));
        Ok(self.nodes.len() - 1)
    }

    /// Completes an inner node: the next node becomes its upper child.
    pub(super) fn close(&mut self, node: usize, axis: Axis, plane: f32) {
        self.nodes[node] = Node::inner(axis, plane, self.nodes.len() as u32);
    }

    /// Appends a part that was built separately.
    pub(super) fn append(&mut self, part: Part) {
        let (nodes, references) = (self.nodes.len() as u32, self.references.len() as u32);
        let moved = part.nodes.iter().map(|n| n.moved(nodes, references));
        self.nodes.extend(moved);
        self.references.extend_from_slice(&part.references);
        self.depth_reached = self.depth_reached.max(part.depth_reached);
        self.done += part.done;
        for (all, counted) in self.counted.iter_mut().zip(part.counted) {
            *all += counted;
        }
    }

    /// Updates [`Limits`] before one node and `references` references are added, if a batch is
    /// complete.
    fn count(&mut self, limits: &Limits, depth: u32, references: usize) -> Result<(), BuildError> {
        let [nodes, known] = self.counted;
        let held = [self.nodes.len() + 1, self.references.len() + references];
        if held[0] - nodes + held[1] - known >= BATCH {
            self.counted = held;
            limits.take(depth, held[0] - nodes, held[1] - known)?;
        }
        Ok(())
    }

    /// Updates [`Limits`] with everything that is not counted yet.
    pub(super) fn finish(&mut self, limits: &Limits) -> Result<(), BuildError> {
        let [nodes, known] = self.counted;
        let held = [self.nodes.len(), self.references.len()];
        self.counted = held;
        limits.take(self.depth_reached, held[0] - nodes, held[1] - known)
    }
}
