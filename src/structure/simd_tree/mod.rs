//! A tree laid out for SIMD kernels, which it keeps as long as it lives. The kernels are in
//! [`crate::trace`].

mod block;
mod boxes;
mod build;
mod build_wide;
mod layout;
mod pages;
mod spheres;
mod triangles;
mod wide;

pub(crate) use block::{BlockData, IN_PLANES, NONE};
pub(crate) use boxes::Boxes;
pub use layout::SimdTree;
pub(crate) use layout::{
    ABOVE_EMPTY, AnyTree, BELOW_EMPTY, BoxTree, ByKind, CHILD_SHIFT, LEAF, Node, PlaneTree,
    with_tree,
};
pub(crate) use spheres::Spheres;
pub(crate) use triangles::Triangles;
pub(crate) use wide::{Child, WideNode};
