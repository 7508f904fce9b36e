//! How a tree for SIMD kernels lies in memory: siblings are adjacent, planes are in the coordinates of
//! the unit frame, and leaves hold blocks of objects, of the kind that suits the scene.

use super::block::{IN_BOXES, IN_PLANES};
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

/// A tree prepared for SIMD traversal, with nodes and blocks of one kind.
pub(crate) struct BlockTree<N, B> {
    pub(crate) nodes: N,
    pub(crate) blocks: Pages<B>,
    /// Maximum number of pending nodes on a ray's stack.
    pub(crate) max_pending: usize,
}

/// A tree with planes.
pub(crate) type PlaneTree<B> = BlockTree<Pages<Node>, B>;

/// A hierarchy.
pub(crate) type BoxTree<B> = BlockTree<WideNodes, B>;

/// One of three trees, by the kind of its blocks.
pub(crate) enum ByKind<T, S, B> {
    Triangles(T),
    Spheres(S),
    Boxes(B),
}

/// A tree with the nodes of its structure and the blocks that suit its scene.
pub(crate) enum AnyTree {
    Planes(
        ByKind<
            PlaneTree<Triangles<IN_PLANES>>,
            PlaneTree<Spheres<IN_PLANES>>,
            PlaneTree<Boxes<IN_PLANES>>,
        >,
    ),
    Boxes(
        ByKind<BoxTree<Triangles<IN_BOXES>>, BoxTree<Spheres<IN_BOXES>>, BoxTree<Boxes<IN_BOXES>>>,
    ),
}

/// Evaluates `$body` with `$tree` bound to the tree in a [`ByKind`], monomorphized for each kind of block.
macro_rules! with_tree {
    ($by_kind:expr, $tree:ident => $body:expr) => {
        match $by_kind {
            $crate::structure::simd_tree::ByKind::Triangles($tree) => $body,
            $crate::structure::simd_tree::ByKind::Spheres($tree) => $body,
            $crate::structure::simd_tree::ByKind::Boxes($tree) => $body,
        }
    };
}
pub(crate) use with_tree;

/// A tree prepared for SIMD kernels, for one scene and both precisions.
pub struct SimdTree {
    pub(crate) frame: UnitFrame,
    /// Half the thickness of every plane and face.
    pub(crate) half_thickness: f32,
    /// Lower and upper corner of the scene's box, enlarged by `half_thickness`.
    pub(crate) corners: [[f32; 3]; 2],
    pub(crate) tree: AnyTree,
}

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
        match &self.tree {
            AnyTree::Planes(by_kind) => with_tree!(by_kind, tree => {
                size_of_val(&*tree.nodes) + size_of_val(&*tree.blocks)
            }),
            AnyTree::Boxes(by_kind) => with_tree!(by_kind, tree => {
                size_of_val(&*tree.nodes.nodes) + size_of_val(&*tree.blocks)
            }),
        }
    }
}
