//! Objects that the primary ray of a pixel meets.

use super::{Heatmap, RayFilter, Source, Total, Whole};

pub(super) const HEATMAP: Heatmap = Heatmap {
    symbol: "D_COMPX",
    name: "depth complexity",
    unit: "objects per pixel",
    meaning: "Objects that the primary ray of a pixel meets, hidden ones included.",
    source: Source::DepthComplexity,
    whole: Whole::Mean,
    grain: 1.0,
    totals: &[Total {
        rays: RayFilter::All,
        parameters: &["D_COMPX"],
    }],
};
