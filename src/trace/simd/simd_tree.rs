//! The tree of a scene prepared for SIMD kernels, with the kind of blocks that suits its objects.

use super::block::{Boxes, Spheres, Triangles};
use super::block_tree::BlockTree;
use crate::primitive::{PrimitiveKind, UnitFrame};
use crate::scene::Scene;
use crate::structure::Tree;

/// A tree prepared for SIMD kernels, for one scene and both precisions.
pub struct SimdTree {
    pub(super) frame: UnitFrame,
    pub(super) tree: AnyBlockTree,
}

pub(super) enum AnyBlockTree {
    Triangles(BlockTree<Triangles>),
    Spheres(BlockTree<Spheres>),
    Boxes(BlockTree<Boxes>),
}

/// Evaluates `$body` with `$tree` bound to the [`BlockTree`], monomorphized for each kind of block.
macro_rules! with_block_tree {
    ($simd_tree:expr, $tree:ident => $body:expr) => {
        match &$simd_tree.tree {
            $crate::trace::simd::simd_tree::AnyBlockTree::Triangles($tree) => $body,
            $crate::trace::simd::simd_tree::AnyBlockTree::Spheres($tree) => $body,
            $crate::trace::simd::simd_tree::AnyBlockTree::Boxes($tree) => $body,
        }
    };
}
pub(super) use with_block_tree;

impl SimdTree {
    /// Returns the prepared tree of this scene. It is built by the first call and kept with the tree.
    pub fn of<'a>(scene: &Scene, tree: &'a Tree) -> &'a SimdTree {
        tree.derived(|| SimdTree::new(scene, tree))
    }

    /// # Panics
    /// If the tree has 2²⁸ nodes or more, which take 2 GiB.
    fn new(scene: &Scene, tree: &Tree) -> SimdTree {
        let objects = scene.objects();
        let frame = UnitFrame::around(&scene.bounds());
        let all = |kind| !objects.is_empty() && objects.iter().all(|o| o.kind() == kind);
        let tree = if all(PrimitiveKind::Triangle) {
            AnyBlockTree::Triangles(BlockTree::new(tree, objects, &frame))
        } else if all(PrimitiveKind::Sphere) {
            AnyBlockTree::Spheres(BlockTree::new(tree, objects, &frame))
        } else {
            AnyBlockTree::Boxes(BlockTree::new(tree, objects, &frame))
        };
        SimdTree { frame, tree }
    }

    /// Returns the memory that nodes and blocks take.
    pub fn bytes(&self) -> usize {
        with_block_tree!(self, tree => tree.bytes())
    }
}
