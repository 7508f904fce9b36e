//! Points, boxes, axes and rays: what every other folder speaks in.
//!
//! Everything here is `f64`: scenes are stored and trees are built in it.

mod aabb;
mod axis;
mod ray;

pub use aabb::Aabb;
pub use axis::Axis;
pub use glam::DVec3 as Vec3;
pub use ray::Ray;
