//! Bounds on how far rounding may move the coordinates of a scene.

use crate::primitive::Precision;

/// The largest deviation between the coordinates behind an answer and those of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Deviation of every coordinate and radius, a length.
    pub length: f64,
    /// Deviation of every component of the direction, relative to the largest component.
    pub relative: f64,
}

impl Tolerance {
    pub(in crate::measure) const NONE: Tolerance = Tolerance {
        length: 0.0,
        relative: 0.0,
    };

    /// The number of successive roundings that a kernel's answer may contain. Coordinates are
    /// rounded once. The arithmetic is backward stable: its answers are exact for coordinates a few
    /// roundings away. The largest allowance in a kernel is 16, for a triangle seen edge-on.
    const ROUNDINGS: f64 = 32.0;

    /// Returns the tolerance for a precision and for coordinates of size `scale`, a length.
    pub fn of(precision: Precision, scale: f64) -> Self {
        let relative = Self::ROUNDINGS * precision.epsilon();
        Tolerance {
            length: relative * scale,
            relative,
        }
    }
}
