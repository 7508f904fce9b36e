//! Bounding volume hierarchies. A builder is one file here and one line in [`BVH_BUILDERS`].
//!
//! A builder makes a binary hierarchy in world coordinates ([`binary`]). It is then laid out with the width
//! that the settings ask for ([`layout`]), in boxes of `f32` that are wider than rounding.

mod binary;
mod binned;
mod bins;
pub(super) mod builder;
mod collapse;
mod constants;
mod costs;
mod layout;
mod lbvh;
mod morton;
mod ploc;
mod presplit;
mod reference;
mod reinsert;
mod spatial;
mod sweep;
mod top_down;

pub use binary::{Binary, BinaryNode, Content};
pub use builder::{BvhBuilder, Input};
pub(super) use layout::{Laid, close, lay_out, sides};

use super::settings::MethodInfo;

/// All builders.
pub static BVH_BUILDERS: &[MethodInfo] = &[
    sweep::METHOD,
    binned::METHOD,
    spatial::METHOD,
    presplit::METHOD,
    lbvh::METHOD,
    ploc::METHOD,
    reinsert::METHOD,
];
