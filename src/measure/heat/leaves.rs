//! Leaves that the rays of a pixel visited.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_VLS",
    name: "visited leaves",
    unit: "leaves per pixel",
    meaning: "Leaves that the rays of a pixel visited, empty ones included.",
    source: Source::Rays(|t| t.leaves),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_VLS"],
    }],
};
