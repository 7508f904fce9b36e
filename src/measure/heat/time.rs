//! Time that a pixel took.

use super::{Heatmap, Source, Whole};

/// Microseconds, as shown, in a second.
pub(super) const PER_SECOND: f64 = 1e6;

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "T_PIXEL",
    name: "time",
    unit: "µs per pixel",
    meaning: "Time of tracing and shading a pixel on one thread; the least of several.",
    source: Source::Time,
    whole: Whole::Sum,
    grain: 0.1,
    // `T_TR` is taken over whole tiles, not pixel by pixel.
    totals: &[],
};
