//! The finished tree: nodes, references, cells.

use super::frame::Frame;
use super::node::{Node, NodeKind, StopReason};
use super::settings::BuildSettings;
use super::simd_tree::SimdTree;
use super::voxels::Voxels;
use crate::geometry::{Aabb, Axis};
use std::sync::OnceLock;

/// A finished, immutable tree. Node 0 is the root, at depth 0.
///
/// Nodes are stored in depth-first order: the lower child of an inner node directly follows it, so
/// the subtree of a node is one contiguous range of the array.
#[derive(Debug)]
pub struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) references: Vec<u32>,
    pub(super) voxels: Option<Voxels>,
    pub(super) frame: Frame,
    pub(super) settings: BuildSettings,
    pub(super) depth_limit: u32,
    pub(super) depth_reached: u32,
    /// Built when a SIMD kernel first needs it.
    pub(super) simd_tree: OnceLock<SimdTree>,
}

/// A node with its cell, as returned by [`Tree::cells`].
#[derive(Clone, Copy, Debug)]
pub struct CellOfNode {
    /// Index of the node.
    pub node: u32,
    /// Levels below the root. Cutting out an empty slab is one level, although it takes two planes.
    pub depth: u32,
    pub bounds: Aabb,
}

impl Tree {
    /// Returns all nodes, 8 bytes each; there is at least one.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Unpacks a node.
    pub fn kind(&self, node: u32) -> NodeKind {
        self.nodes[node as usize].kind(node)
    }

    /// Returns the objects that a leaf refers to, in ascending order; empty for inner nodes.
    pub fn leaf_objects(&self, node: u32) -> &[u32] {
        match self.kind(node) {
            NodeKind::Leaf { first, count, .. } => {
                &self.references[first as usize..(first + count) as usize]
            }
            NodeKind::Inner { .. } => &[],
        }
    }

    /// Returns the object numbers of all leaves, one leaf after the other.
    pub fn references(&self) -> &[u32] {
        &self.references
    }

    /// Returns the voxels if the leaves form a grid; rays then step from voxel to voxel.
    #[inline]
    pub fn voxels(&self) -> Option<&Voxels> {
        self.voxels.as_ref()
    }

    /// Returns the root cell and its local coordinates, in which split planes are stored.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns the root cell: the bounds of the scene, enlarged by the root margin.
    pub fn root_cell(&self) -> Aabb {
        self.frame.cell()
    }

    /// Returns the settings that the tree was built with.
    pub fn settings(&self) -> &BuildSettings {
        &self.settings
    }

    /// Returns the root margin as a length, whether it was automatic or not.
    pub fn root_margin(&self) -> f64 {
        self.frame.margin()
    }

    /// Returns the depth limit `D_MAX`, whether it was automatic or not; a grid can be deeper.
    pub fn depth_limit(&self) -> u32 {
        self.depth_limit
    }

    /// Returns the maximum depth of all leaves, `D_REACH`.
    pub fn depth_reached(&self) -> u32 {
        self.depth_reached
    }

    /// Returns the bytes of nodes, references and voxels.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.references.as_slice())
            + self.voxels.as_ref().map_or(0, Voxels::bytes)
    }

    /// Returns the root with its cell.
    pub fn root(&self) -> CellOfNode {
        CellOfNode {
            node: 0,
            depth: 0,
            bounds: self.root_cell(),
        }
    }

    /// Returns every node with its depth and cell, in array order.
    pub fn cells(&self) -> impl Iterator<Item = CellOfNode> + '_ {
        let mut stack = vec![self.root()];
        std::iter::from_fn(move || {
            let cell = stack.pop()?;
            if let Some([below, above]) = self.children(&cell) {
                stack.push(above);
                stack.push(below);
            }
            Some(cell)
        })
    }

    /// Returns the cell of a node, by descending from the root.
    ///
    /// # Panics
    /// If the node does not exist.
    pub fn cell_of(&self, node: u32) -> CellOfNode {
        let mut cell = self.root();
        while cell.node != node {
            let [below, above] = self.children(&cell).expect("the node is in the tree");
            // Subtrees are contiguous ranges of the array.
            cell = if node < above.node { below } else { above };
        }
        cell
    }

    /// Returns the cells of the two children of an inner node, below and above its plane; `None`
    /// for a leaf.
    pub fn children(&self, cell: &CellOfNode) -> Option<[CellOfNode; 2]> {
        let NodeKind::Inner {
            axis,
            plane,
            below,
            above,
        } = self.kind(cell.node)
        else {
            return None;
        };
        let (lower, upper) = cell
            .bounds
            .split(axis, self.frame.to_world(axis, f64::from(plane)));
        Some(
            [(below, lower), (above, upper)].map(|(node, bounds)| CellOfNode {
                node,
                depth: cell.depth + u32::from(!self.is_second_plane(node)),
                bounds,
            }),
        )
    }

    /// Returns whether a node is the second plane of a cut, below which is the slab that was cut
    /// out. It does not count as a level of its own.
    fn is_second_plane(&self, node: u32) -> bool {
        let cut_out = |below| {
            matches!(
                self.kind(below),
                NodeKind::Leaf {
                    stop: StopReason::CutOut,
                    ..
                }
            )
        };
        matches!(self.kind(node), NodeKind::Inner { below, .. } if cut_out(below))
    }

    /// Returns the axis and the world coordinate of the plane of an inner node; `None` for a leaf.
    pub fn plane(&self, node: u32) -> Option<(Axis, f64)> {
        match self.kind(node) {
            NodeKind::Inner { axis, plane, .. } => {
                Some((axis, self.frame.to_world(axis, f64::from(plane))))
            }
            NodeKind::Leaf { .. } => None,
        }
    }
}
