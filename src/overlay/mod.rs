//! What is drawn over scenes and pictures, as plain colours, boxes and lines; knows no window.

mod coloring;
mod leaf_boxes;
mod lines;
mod rays;
mod walk;

pub use coloring::{COLORINGS, Coloring, Leaf, Mark, coloring};
pub use leaf_boxes::{Filter, Instance, LeafBoxes, leaf_boxes};
pub use lines::{Line, box_lines, frustum_lines, order_color};
pub use rays::{RayStyle, RaysShown, ray_lines, ray_style};
pub use walk::{CELL, PLANE, WAITING, step_lines, visited_lines};
