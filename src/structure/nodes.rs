//! The nodes of a tree: split planes, or bounding boxes.

use super::box_node::BoxNode;
use super::node::{Node, NodeKind};

/// The nodes of a tree in depth-first order: the first child of an inner node directly follows it, and the
/// subtree of a node is one contiguous range.
#[derive(Clone, Debug, PartialEq)]
pub enum Nodes {
    /// Inner nodes divide their cell by a plane: kd-trees, octrees and grids.
    Planes(Vec<Node>),
    /// Every node has a box: bounding volume hierarchies.
    Boxes(Vec<BoxNode>),
}

impl Nodes {
    /// Returns the number of nodes; there is at least one.
    pub fn len(&self) -> usize {
        match self {
            Nodes::Planes(nodes) => nodes.len(),
            Nodes::Boxes(nodes) => nodes.len(),
        }
    }

    /// Returns whether there are no nodes, which is never the case for a tree.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the memory that the nodes take.
    pub fn bytes(&self) -> usize {
        match self {
            Nodes::Planes(nodes) => size_of_val(nodes.as_slice()),
            Nodes::Boxes(nodes) => size_of_val(nodes.as_slice()),
        }
    }

    /// Unpacks a node.
    pub fn kind(&self, node: u32) -> NodeKind {
        match self {
            Nodes::Planes(nodes) => nodes[node as usize].kind(),
            Nodes::Boxes(nodes) => nodes[node as usize].kind(),
        }
    }

    /// Returns the children of an inner node in array order, the child below a plane first; none for a leaf.
    pub fn children(&self, node: u32) -> impl Iterator<Item = u32> + '_ {
        let is_inner = self.kind(node) == NodeKind::Inner;
        let first = is_inner.then_some(node + 1);
        std::iter::successors(first, move |&child| match self {
            Nodes::Planes(nodes) => {
                let (_, _, above) = nodes[node as usize].as_inner();
                (child < above).then_some(above)
            }
            Nodes::Boxes(nodes) => {
                let next = nodes[child as usize].end(child);
                (next < nodes[node as usize].end(node)).then_some(next)
            }
        })
    }

    /// Returns the nodes with planes; empty for boxes.
    #[inline]
    pub(crate) fn planes(&self) -> &[Node] {
        match self {
            Nodes::Planes(nodes) => nodes,
            Nodes::Boxes(_) => &[],
        }
    }
}
