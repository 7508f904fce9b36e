//! The finished tree: nodes, references, cells.

use super::box_node::BoxNode;
use super::frame::Frame;
use super::node::{Node, NodeKind, StopReason};
use super::nodes::Nodes;
use super::settings::BuildSettings;
use super::simd_tree::SimdTree;
use super::tree_file::Faults;
use super::voxels::Voxels;
use crate::geometry::{Aabb, Axis, Vec3};
use std::sync::OnceLock;

/// A finished, immutable tree. Node 0 is the root, at depth 0.
///
/// Nodes are stored in depth-first order: the lower child of an inner node directly follows it, so
/// the subtree of a node is one contiguous range of the array.
#[derive(Debug)]
pub struct Tree {
    pub(super) nodes: Nodes,
    pub(super) references: Vec<u32>,
    pub(super) voxels: Option<Voxels>,
    pub(super) frame: Frame,
    pub(super) settings: BuildSettings,
    pub(super) depth_limit: u32,
    pub(super) depth_reached: u32,
    /// What is wrong with the tree of a file; empty for one that was built.
    pub(super) faults: Faults,
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
    /// Returns all nodes.
    pub fn nodes(&self) -> &Nodes {
        &self.nodes
    }

    /// Returns what a node is.
    pub fn kind(&self, node: u32) -> NodeKind {
        self.nodes.kind(node)
    }

    /// Returns the children of an inner node in array order, the child below a plane first; none for a leaf.
    pub fn child_nodes(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        self.nodes.children(node)
    }

    /// Returns one past the last node of a subtree.
    pub fn end_of(&self, node: u32) -> u32 {
        let mut last = node;
        while let Some(child) = self.child_nodes(last).last() {
            last = child;
        }
        last + 1
    }

    /// Returns the objects that a leaf refers to, in ascending order; empty for inner nodes.
    pub fn leaf_objects(&self, node: u32) -> &[u32] {
        match self.kind(node) {
            NodeKind::Leaf { first, count, .. } => {
                &self.references[first as usize..(first + count) as usize]
            }
            NodeKind::Inner => &[],
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

    /// Returns what is wrong with the tree in the file that it was read from; nothing for one that was built.
    pub fn faults(&self) -> &Faults {
        &self.faults
    }

    /// Returns the bytes of nodes, references and voxels.
    pub fn bytes(&self) -> usize {
        self.nodes.bytes()
            + size_of_val(self.references.as_slice())
            + self.voxels.as_ref().map_or(0, Voxels::bytes)
    }

    /// Returns the bytes of what rays step along: a node, or a voxel of a grid.
    pub fn node_bytes(&self) -> usize {
        match (&self.nodes, &self.voxels) {
            (_, Some(_)) => Voxels::VOXEL_BYTES,
            (Nodes::Planes(_), None) => size_of::<Node>(),
            (Nodes::Boxes(_), None) => size_of::<BoxNode>(),
        }
    }

    /// Returns the root with its cell. The cell of a node with a box is the box.
    pub fn root(&self) -> CellOfNode {
        CellOfNode {
            node: 0,
            depth: 0,
            bounds: match &self.nodes {
                Nodes::Planes(_) => self.root_cell(),
                Nodes::Boxes(nodes) => self.box_of(&nodes[0]),
            },
        }
    }

    /// Returns every node with its depth and cell, in array order.
    pub fn cells(&self) -> impl Iterator<Item = CellOfNode> + '_ {
        let mut stack = vec![self.root()];
        std::iter::from_fn(move || {
            let cell = stack.pop()?;
            let from = stack.len();
            stack.extend(self.children(&cell));
            stack[from..].reverse();
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
            // Subtrees are contiguous ranges of the array.
            let children = self.children(&cell).take_while(|child| child.node <= node);
            cell = children.last().expect("the node is in the tree");
        }
        cell
    }

    /// Returns the cells of the children of an inner node in array order, that below a plane first; none for a
    /// leaf.
    pub fn children(&self, cell: &CellOfNode) -> impl Iterator<Item = CellOfNode> + '_ {
        let halves = self
            .plane(cell.node)
            .map(|(axis, plane)| cell.bounds.split(axis, plane));
        let depth = cell.depth;
        self.child_nodes(cell.node)
            .enumerate()
            .map(move |(i, node)| CellOfNode {
                node,
                depth: depth + u32::from(!self.is_second_plane(node)),
                bounds: match (&self.nodes, halves) {
                    (Nodes::Boxes(nodes), _) => self.box_of(&nodes[node as usize]),
                    (_, Some((lower, upper))) => [lower, upper][i],
                    (_, None) => unreachable!("an inner node without a box has a plane"),
                },
            })
    }

    /// Returns the box of a node in world coordinates.
    pub(super) fn box_of(&self, node: &BoxNode) -> Aabb {
        let corner = |local: [f32; 3]| {
            let at = |k: usize| {
                self.frame
                    .to_world(Axis::from_index(k), f64::from(local[k]))
            };
            Vec3::new(at(0), at(1), at(2))
        };
        Aabb::new(corner(node.lo), corner(node.hi))
    }

    /// Returns whether a node is the second plane of a cut, below which is the slab that was cut
    /// out. It does not count as a level of its own.
    fn is_second_plane(&self, node: u32) -> bool {
        let Nodes::Planes(nodes) = &self.nodes else {
            return false;
        };
        let below = nodes.get(node as usize + 1).map(|below| below.kind());
        let cut_out = StopReason::CutOut;
        !nodes[node as usize].is_leaf()
            && matches!(below, Some(NodeKind::Leaf { stop, .. }) if stop == cut_out)
    }

    /// Returns the axis and the world coordinate of the plane of an inner node; `None` for a leaf and for a
    /// node with a box.
    pub fn plane(&self, node: u32) -> Option<(Axis, f64)> {
        let node = self.nodes.planes().get(node as usize)?;
        let (axis, plane, _) = (!node.is_leaf()).then(|| node.as_inner())?;
        let axis = Axis::from_index(axis);
        Some((axis, self.frame.to_world(axis, f64::from(plane))))
    }
}
