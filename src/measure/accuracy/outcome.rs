//! One choice of an accuracy study, and its time and error.

use super::error::ImageError;
use crate::setup::Setup;

/// The settings of one point of a study, and how they differ from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The changed knobs with their values; empty for the reference.
    pub turned: Vec<(String, String)>,
    /// Whether one of these knobs changes the image.
    pub moves_image: bool,
    pub setup: Setup,
}

impl Choice {
    /// Returns a label such as `samples 4, precision f32`, or `reference`.
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
    /// CPU seconds of every round, in ascending order; at least one.
    pub seconds: Vec<f64>,
    /// Share of the pixels whose primary ray hits another object than in the reference, or hits in
    /// only one of the two, 0 to 1. The polygons of a cylinder count as the cylinder.
    pub wrong_hits: f64,
    pub error: ImageError,
    /// Bytes of the objects in the layout that intersection tests use.
    pub object_bytes: u64,
}

impl Outcome {
    /// Returns the median CPU time in seconds. For an even number of rounds, it is the lower of the
    /// two middle values.
    pub fn median(&self) -> f64 {
        self.seconds[(self.seconds.len() - 1) / 2]
    }
}
