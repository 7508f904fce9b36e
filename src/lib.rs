//! bspscope: see, measure and compare the BSP trees that make ray tracing fast.

pub mod geometry;
#[cfg(feature = "gui")]
pub mod gui;
pub mod measure;
pub mod overlay;
pub mod primitive;
pub mod progress;
pub mod scene;
pub mod trace;
pub mod tree;
pub mod worker;
