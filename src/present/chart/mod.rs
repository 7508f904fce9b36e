//! Charts: a parameter of a sweep over the maximum depth, as PNG or SVG; how well measures predict time, as SVG.

mod curves;
mod measures;
mod sweep;

pub use curves::{Curve, CurvePoint, curves, is_wide};
pub use measures::measures_svg;
pub use sweep::{Chart, ChartError, png, svg};
