//! Intersection tests of the rays of a pixel.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "N_IT",
    name: "intersection tests",
    unit: "tests per pixel",
    meaning: "Intersection tests of the rays of a pixel with objects.",
    source: Source::Rays(|t| t.tests),
    whole: Whole::Sum,
    grain: 1.0,
    totals: &[
        Total {
            rays: RayFilter::All,
            parameters: &["N_PRIT", "N_SRIT", "N_SECRIT"],
        },
        Total {
            rays: RayFilter::Primary,
            parameters: &["N_PRIT"],
        },
        Total {
            rays: RayFilter::Shadow,
            parameters: &["N_SRIT"],
        },
        Total {
            rays: RayFilter::Secondary,
            parameters: &["N_SECRIT"],
        },
    ],
};
