//! Inner nodes and leaves that the rays of a pixel traversed.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_NODES",
    name: "traversed nodes",
    unit: "nodes per pixel",
    meaning: "Inner nodes and leaves that the rays of a pixel traversed.",
    source: Source::Rays(|t| t.inner_nodes + t.leaves),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["N_NODES"],
    }],
};
