//! Empty leaves that the rays of a pixel visited.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_VELS",
    name: "visited empty leaves",
    unit: "empty leaves per pixel",
    meaning: "Leaves without an object that the rays of a pixel visited.",
    source: Source::Rays(|t| t.empty_leaves),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_VELS"],
    }],
};
