//! Rays through trees: traversal, kernels that time and kernels that count, shading, pictures.
//!
//! Rays are traced in `f64`, or in `f32` on the same tree ([`PrecisionChoice`]); either way the tree's
//! answers are, bit by bit, those of testing every object in that precision.
//!
//! Counting is a type parameter ([`Probe`]): with `()` nothing is counted and nothing is paid.

mod any_order;
mod kernel;
mod lanes;
mod line;
mod picture;
mod precision;
mod probe;
mod record;
mod render;
mod settings;
mod space;
mod through_voxels;
mod traverse;
mod visits;
mod waiting;
mod whitted;

pub use any_order::objects_along;
pub use kernel::{
    Batch, Counting, Hit, RayKind, RayTracer, Timed, any_hit, any_of_all, closest_hit,
    closest_of_all,
};
pub use lanes::{InstructionSet, KernelChoice, LaneKernel, LaneTree, RayCompany, TimedKernel};
#[cfg(test)]
pub(crate) use line::{Line, Meeting, WideLine};
pub use picture::{Picture, TILE, Tile, srgb8, tiles};
pub use precision::{ChosenPrecision, NotInF32, PrecisionChoice, fits_f32, objects_fit_f32};
pub use probe::{MostOfARay, PixelTallies, Probe, RayCounts, Tally, Way};
pub use record::{
    After, InnerStep, LeafStep, PixelRecord, RayPath, RecordedRay, Step, TestStep, record_pixel,
    record_pixel_within, record_ray,
};
pub use render::{
    CountedPass, CountedTile, RenderError, TimedPass, counted_pass, pixel_times, preview,
    thread_pool, timed_pass,
};
pub use settings::RenderSettings;
#[cfg(test)]
pub(crate) use traverse::traverse;
pub use traverse::{LeafVisitor, Scratch};
pub use visits::{Visits, visits_pass};
pub use waiting::Waiting;
pub use whitted::{Shading, trace_samples};
