//! bspscope: see, measure and compare the BSP trees that make ray tracing fast.

pub mod geometry;
pub mod primitive;
pub mod progress;
pub mod scene;
