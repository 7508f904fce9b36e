//! Rays through trees: traversal, kernels that time and kernels that count, shading, pictures.
//!
//! Rays are traced in `f64`, or in `f32` on the same tree ([`PrecisionChoice`]); either way the tree's
//! answers are, bit by bit, those of testing every object in that precision.
//!
//! CountingKernel is a type parameter ([`Probe`]): with `()` nothing is counted and nothing is paid.

mod any_order;
mod kernel;
mod lanes;
mod line;
mod pending;
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
mod whitted;

pub use any_order::objects_on_ray;
pub use kernel::{
    Batch, CountingKernel, Hit, RayKind, RayTracer, ScalarKernel, any_hit, any_hit_brute_force,
    closest_hit, closest_hit_brute_force,
};
pub use lanes::{InstructionSet, KernelChoice, SimdKernel, SimdMode, SimdTree, TimedKernel};
#[cfg(test)]
pub(crate) use line::{PlaneCrossing, TraversalRay, TraversalRayF64};
pub use pending::PendingNode;
pub use picture::{Picture, TILE, Tile, srgb8, tiles};
pub use precision::{ChosenPrecision, NotInF32, PrecisionChoice, fits_f32, objects_fit_f32};
pub use probe::{Children, PixelTallies, Probe, RayCounts, RayMaxima, Tally};
pub use record::{
    InnerStep, LeafOutcome, LeafStep, PixelRecord, RayPath, RecordedRay, Step, TestStep,
    record_pixel, record_pixel_within, record_ray,
};
pub use render::{
    CountedRender, CountedTile, RenderError, TimedRender, pixel_times, preview, render_counted,
    render_timed, thread_pool,
};
pub use settings::RenderSettings;
#[cfg(test)]
pub(crate) use traverse::traverse;
pub use traverse::{LeafVisitor, Scratch};
pub use visits::{Visits, count_visits};
pub use whitted::{Shading, trace_samples};
