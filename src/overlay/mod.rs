//! What is drawn over scenes and pictures, as plain colours, boxes and lines; knows no window.

mod coloring;
mod histogram;
mod leaf_boxes;
mod lines;
mod selection;

pub use coloring::{COLORINGS, Coloring, Leaf, Mark, coloring};
pub use histogram::{
    Bars, HISTOGRAM_COUNT, HISTOGRAMS, Histogram, Ranges, Scale, in_ranges, leaves,
};
pub use leaf_boxes::{Filter, Instance, LeafBoxes, leaf_boxes};
pub use lines::{Line, box_lines, frustum_lines, order_color, path_lines};
pub use selection::{
    CELL_COLOR, FaceCorner, PLANE_COLOR, REFERRING_COLOR, cell_faces, cell_lines, leaves_along,
};
