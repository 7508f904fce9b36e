//! The choice of the precision.

use serde::{Deserialize, Serialize};

/// The precision chosen for rendering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PrecisionChoice {
    F32,
    #[default]
    F64,
    /// `f32` where it can represent the scene as the camera sees it, else `f64`.
    Auto,
}

impl PrecisionChoice {
    pub const ALL: [PrecisionChoice; 3] = [
        PrecisionChoice::F32,
        PrecisionChoice::F64,
        PrecisionChoice::Auto,
    ];

    /// Returns `f32`, `f64` or `auto`.
    pub const fn name(self) -> &'static str {
        ["f32", "f64", "auto"][self as usize]
    }

    /// Returns the choice of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name)
    }
}
