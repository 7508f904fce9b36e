//! Tests of blocks of objects: the trait, and one file per kind of block.

mod boxes;
mod interface;
mod spheres;
mod triangles;

pub(super) use interface::{Block, HitMasks};
