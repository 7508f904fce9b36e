//! Leaves with objects that the rays of a pixel visited.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_VFLS",
    name: "visited full leaves",
    unit: "full leaves per pixel",
    meaning: "Leaves with objects that the rays of a pixel visited.",
    source: Source::Rays(|t| t.leaves - t.empty_leaves),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_VFLS"],
    }],
};
