//! Points, boxes, axes and rays, for all other folders.
//!
//! Everything here is `f64`, the precision in which scenes are stored and trees are built.

mod aabb;
mod axis;
mod ray;

pub use aabb::Aabb;
pub use axis::Axis;
pub use glam::DVec3 as Vec3;
pub use ray::Ray;
