//! Blocks of objects that SIMD kernels test at once: the trait, and one file per kind.

mod boxes;
mod interface;
mod spheres;
mod triangles;

pub(super) use boxes::Boxes;
pub(super) use interface::{BLOCK, Block, HitMasks};
pub(super) use spheres::Spheres;
pub(super) use triangles::Triangles;
