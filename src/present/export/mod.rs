//! Exports results as files for other programs: pictures, heatmaps with legends, the boxes of
//! leaves.

mod heatmap;
mod leaves;
mod page;
mod picture;

pub use heatmap::HeatSheet;
pub use leaves::{LEAF_WRITERS, LeafCell, LeafCells};
pub use page::write_page;
pub use picture::{encoded, png};
