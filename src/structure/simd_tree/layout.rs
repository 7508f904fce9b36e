//! How a tree for SIMD kernels lies in memory: siblings are adjacent, planes are in the coordinates of
//! the unit frame, and leaves hold blocks of objects, of the kind that suits the scene.

use super::boxes::Boxes;
use super::pages::Pages;
use super::spheres::Spheres;
use super::triangles::Triangles;
use super::wide::WideNodes;
use crate::primitive::UnitFrame;

/// A node in 8 bytes.
///
/// | | inner node | leaf |
/// |---|---|---|
/// | `payload` | plane, as bits of an `f32` | index of the first block |
/// | `word`, bits 0 and 1 | axis | 3 |
/// | `word`, bits 2 and 3 | whether the lower and the upper child is an empty leaf | part of the next |
/// | `word`, other bits | index of the lower child, which the upper one follows | number of blocks |
#[derive(Clone, Copy, Default)]
#[repr(C)]
pub(crate) struct Node {
    pub(crate) payload: u32,
    pub(crate) word: u32,
}

pub(crate) const LEAF: u32 = 3;
pub(crate) const BELOW_EMPTY: u32 = 4;
pub(crate) const ABOVE_EMPTY: u32 = 8;
/// Position of the child index in an inner node's word.
pub(crate) const CHILD_SHIFT: u32 = 4;

impl Node {
    pub(super) fn leaf(first: usize, blocks: usize) -> Node {
        Node {
            payload: first as u32,
            word: (blocks as u32) << 2 | LEAF,
        }
    }

    pub(super) fn is_empty_leaf(self) -> bool {
        self.word == LEAF
    }
}

/// The nodes of a tree.
pub(crate) enum SimdNodes {
    Planes(Pages<Node>),
    Boxes(WideNodes),
}

impl SimdNodes {
    /// Returns the nodes with planes; empty for boxes.
    #[inline(always)]
    pub(crate) fn planes(&self) -> &[Node] {
        match self {
            SimdNodes::Planes(nodes) => nodes,
            SimdNodes::Boxes(_) => &[],
        }
    }
}

/// A tree prepared for SIMD traversal, with blocks of one kind.
pub(crate) struct BlockTree<B> {
    pub(crate) nodes: SimdNodes,
    pub(crate) blocks: Pages<B>,
    /// Maximum number of pending nodes on a ray's stack.
    pub(crate) max_pending: usize,
    /// Half the thickness of every plane and face.
    pub(crate) half_thickness: f32,
    /// Lower and upper corner of the scene's box, enlarged by `half_thickness`.
    pub(crate) corners: [[f32; 3]; 2],
}

impl<B> BlockTree<B> {
    /// Returns the memory that nodes and blocks take.
    pub(crate) fn bytes(&self) -> usize {
        let nodes = match &self.nodes {
            SimdNodes::Planes(nodes) => size_of_val(&**nodes),
            SimdNodes::Boxes(nodes) => size_of_val(&*nodes.nodes),
        };
        nodes + size_of_val(&*self.blocks)
    }
}

/// A tree prepared for SIMD kernels, for one scene and both precisions.
pub struct SimdTree {
    pub(crate) frame: UnitFrame,
    pub(crate) tree: AnyBlockTree,
}

pub(crate) enum AnyBlockTree {
    Triangles(BlockTree<Triangles>),
    Spheres(BlockTree<Spheres>),
    Boxes(BlockTree<Boxes>),
}

/// Evaluates `$body` with `$tree` bound to the [`BlockTree`], monomorphized for each kind of block.
macro_rules! with_block_tree {
    ($simd_tree:expr, $tree:ident => $body:expr) => {
        match &$simd_tree.tree {
            $crate::structure::simd_tree::AnyBlockTree::Triangles($tree) => $body,
            $crate::structure::simd_tree::AnyBlockTree::Spheres($tree) => $body,
            $crate::structure::simd_tree::AnyBlockTree::Boxes($tree) => $body,
        }
    };
}
pub(crate) use with_block_tree;

impl std::fmt::Debug for SimdTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SimdTree")
            .field("bytes", &self.bytes())
            .finish_non_exhaustive()
    }
}

impl SimdTree {
    /// Returns the memory that nodes and blocks take.
    pub fn bytes(&self) -> usize {
        with_block_tree!(self, tree => tree.bytes())
    }
}
