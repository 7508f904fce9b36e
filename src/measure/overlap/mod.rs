//! How far the nodes of a hierarchy overlap: the union of its leaves, and the nodes around end points of rays.

mod end_points;
mod piece;
mod union;

pub(in crate::measure) use end_points::{COST_OF_INNER_NODE, COST_OF_TEST, end_point_overlap};
pub(in crate::measure) use union::leaf_union;
