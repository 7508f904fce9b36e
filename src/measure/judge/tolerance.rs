//! How far rounding may move the numbers of a scene.

use crate::primitive::Precision;

/// How far the numbers that an answer came from may be off those of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of every coordinate and radius, a length.
    pub length: f64,
    /// Of every component of the direction, in units of the largest.
    pub relative: f64,
}

impl Tolerance {
    pub(super) const NONE: Tolerance = Tolerance {
        length: 0.0,
        relative: 0.0,
    };

    /// Roundings in a row that a kernel's answer may carry: those of the numbers themselves, and of
    /// the arithmetic, which is backward stable: its answers are right for numbers a few roundings
    /// away. The most is what a triangle allows to be edge-on, 16.
    const ROUNDINGS: f64 = 32.0;

    /// What rounding to this precision does to coordinates of size `scale`, a length.
    pub fn of(precision: Precision, scale: f64) -> Self {
        let relative = Self::ROUNDINGS * precision.epsilon();
        Tolerance {
            length: relative * scale,
            relative,
        }
    }
}
