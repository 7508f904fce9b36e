//! Intersection tests for every hit of the rays of a pixel.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_RPRT",
    name: "tests per hit",
    unit: "tests per hit",
    meaning: "Intersection tests for every hit of the rays of a pixel, at least 1; none where they hit nothing.",
    source: Source::Rays(|t| t.tests),
    whole: Whole::RatioTo(|t| t.hits),
    grain: 0.1,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_RPRT"],
    }],
};
