//! Charts of a sweep: a parameter over the maximum depth, as PNG or SVG.

mod curves;
mod sweep;

pub use curves::{Curve, CurvePoint, curves, is_wide};
pub use sweep::{Chart, ChartError, png, svg};
