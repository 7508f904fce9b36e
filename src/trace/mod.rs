//! Rays through trees: traversal, kernels that time and kernels that count, shading, pictures.
//!
//! Counting is a type parameter ([`Probe`]): with `()` nothing is counted and nothing is paid.

mod any_order;
mod kernel;
mod picture;
mod probe;
mod record;
mod render;
mod settings;
mod shapes;
mod traverse;
mod visits;
mod waiting;
mod whitted;

pub use any_order::objects_along;
pub use kernel::{Batch, Counting, Hit, RayKind, RayTracer, Timed};
pub use picture::{Picture, TILE, Tile, srgb8, tiles};
pub use probe::{PixelTallies, Probe, RayCounts, Tally, Way};
pub use record::{
    After, InnerStep, LeafStep, PixelRecord, RayPath, RecordedRay, Step, TestStep, record_pixel,
    record_pixel_within, record_ray,
};
pub use render::{
    CountedPass, CountedTile, RenderError, TimedPass, counted_pass, pixel_times, preview,
    thread_pool, timed_pass,
};
pub use settings::RenderSettings;
pub use shapes::Shapes;
pub use traverse::{Conservative, Decisions, LeafVisitor, Scratch, traverse, traverse_by};
pub use visits::{Visits, visits_pass};
pub use waiting::Waiting;
pub use whitted::trace_samples;
