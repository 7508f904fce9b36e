//! One choice of an accuracy study, and its time and error.

use super::error::ImageError;
use crate::setup::Setup;

/// What distinguishes a point from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Knobs and what they are turned to; none at the reference.
    pub turned: Vec<(String, String)>,
    /// Whether a knob among them moves the picture.
    pub moves_image: bool,
    pub setup: Setup,
}

impl Choice {
    /// Such as `samples 4, precision f32`, or `reference`.
    pub fn words(&self) -> String {
        let words: Vec<_> = self
            .turned
            .iter()
            .map(|(knob, value)| format!("{knob} {value}"))
            .collect();
        if words.is_empty() {
            "reference".into()
        } else {
            words.join(", ")
        }
    }
}

/// A choice with its time and error.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub choice: Choice,
    /// CPU seconds of every round, ascending; there is at least one.
    pub seconds: Vec<f64>,
    /// Share of the reference's pixels whose primary ray meets another object, or none, or one where
    /// it should meet none. The polygons of a cylinder count as the cylinder.
    pub wrong_hits: f64,
    pub error: ImageError,
    /// Bytes of the objects as intersection tests take them.
    pub object_bytes: u64,
}

impl Outcome {
    /// The median of an odd number of rounds, else the lower of the two in the middle.
    pub fn median(&self) -> f64 {
        self.seconds[(self.seconds.len() - 1) / 2]
    }
}
