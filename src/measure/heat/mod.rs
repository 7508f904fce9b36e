//! Heatmaps: what each pixel costs.

mod heatmap;
mod image;
mod pixel_counts;

pub use heatmap::{Heatmap, Source, Whole, heatmap, heatmaps};
pub use image::{HeatImage, HeatStatistics};
pub use pixel_counts::{PIXEL_COUNTS_LIMIT, PixelCounts, RayFilter};
