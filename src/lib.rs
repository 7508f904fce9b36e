//! bspscope: see, measure and compare the BSP trees that make ray tracing fast.

pub mod cli;
pub mod geometry;
pub mod measure;
pub mod primitive;
pub mod progress;
pub mod report;
pub mod scene;
pub mod trace;
pub mod tree;
pub mod worker;
