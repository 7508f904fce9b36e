//! Inner nodes that the rays of a pixel traversed.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_INODES",
    name: "traversed inner nodes",
    unit: "inner nodes per pixel",
    meaning: "Inner nodes that the rays of a pixel traversed.",
    source: Source::Rays(|t| t.inner_nodes),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_INODES"],
    }],
};
