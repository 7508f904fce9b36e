//! The two precisions of ray tracing.

use serde::{Deserialize, Serialize};

/// The precision of objects, rays, planes and distances in ray tracing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// 24 bits, relative to the size of the scene ([`super::UnitFrame`]).
    F32,
    /// The reference.
    #[default]
    F64,
}

impl Precision {
    pub const ALL: [Precision; 2] = [Precision::F32, Precision::F64];

    /// Returns `f32` or `f64`.
    pub const fn name(self) -> &'static str {
        ["f32", "f64"][self as usize]
    }

    /// Returns the distance from 1 to the next number.
    pub const fn epsilon(self) -> f64 {
        [f32::EPSILON as f64, f64::EPSILON][self as usize]
    }

    /// Returns the bits of a number.
    pub const fn bits(self) -> u32 {
        [32, 64][self as usize]
    }
}
