//! Rays that a pixel gave rise to.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_RAYS",
    name: "rays",
    unit: "rays per pixel",
    meaning: "Rays that a pixel gave rise to, the primary one included.",
    source: Source::Rays(|t| t.rays),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[
        Total {
            rays: RayFilter::All,
            parameters: &["N_PR", "N_SR", "N_SECR"],
        },
        Total {
            rays: RayFilter::Primary,
            parameters: &["N_PR"],
        },
        Total {
            rays: RayFilter::Shadow,
            parameters: &["N_SR"],
        },
        Total {
            rays: RayFilter::Secondary,
            parameters: &["N_SECR"],
        },
    ],
};
