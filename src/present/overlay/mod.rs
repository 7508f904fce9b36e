//! Overlays of scenes and pictures as plain colors, boxes and lines, independent of a window.

mod coloring;
mod colormap;
mod heat;
mod histogram;
mod leaf_boxes;
mod legend;
mod lines;
mod rays;
mod selection;
mod text;
mod walk;

pub use coloring::{COLORINGS, Coloring, Leaf, Mark, coloring};
pub use colormap::{COLORMAPS, Colormap, colormap};
pub use heat::{HeatScale, Range, Scale, Tick, blend, heat_colors};
pub use histogram::{
    Bars, HISTOGRAM_COUNT, HISTOGRAMS, Histogram, HistogramAxis, NODES_PER_RAY, Ranges, Spread,
    in_ranges, leaves, ranges_need_visits, ray_bars,
};
pub use leaf_boxes::{
    Filter, Focus, Instance, LeafBoxes, Outside, UNDECIDED_COLOR, Visited, leaf_boxes,
};
pub use legend::{Captions, HeatPicture, with_legend};
pub use lines::{BOX_EDGES, Line, box_lines, frustum_lines, order_color};
pub use rays::{RayStyle, RaysShown, ray_lines, ray_style};
pub use selection::{
    CELL_COLOR, FaceCorner, OVERLAP_COLOR, PLANE_COLOR, REFERRING_COLOR, cell_faces, cell_lines,
    cells_along, child_lines, overlap_faces, overlap_share,
};
pub use walk::{CULLED, INTERVAL, WAITING, step_lines, visited_lines};
