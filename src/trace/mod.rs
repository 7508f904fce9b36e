//! Ray tracing: traversal, kernels that are timed and kernels that count, shading, rendering.
//!
//! Rays are traced in `f64`, or in `f32` on the same tree ([`PrecisionChoice`]). In either precision the
//! hits are, bit for bit, those of testing every object.
//!
//! Counting is a type parameter ([`Probe`]): with `()` it costs nothing.

mod counting_kernel;
mod hit;
mod kernel_choice;
mod objects_on_ray;
mod pending;
mod picture;
mod precision;
mod precision_choice;
mod probe;
mod query;
mod record;
mod render;
mod render_error;
mod scalar_kernel;
mod settings;
mod simd;
mod space;
mod stack;
mod timed_batches;
mod timed_kernel;
mod traversal_ray;
mod traverse;
mod traverse_boxes;
mod traverse_grid;
mod view;
mod visits;
mod whitted;

pub use counting_kernel::CountingKernel;
pub use hit::{Batch, Hit, RayKind, RayTracer};
pub use kernel_choice::KernelChoice;
pub use objects_on_ray::objects_on_ray;
pub use pending::PendingNode;
pub use picture::{Picture, TILE, Tile, srgb8, tiles};
pub use precision::{ChosenPrecision, NotInF32, fits_f32, objects_fit_f32};
pub use precision_choice::PrecisionChoice;
pub use probe::{BoxTest, Children, Fate, PixelTallies, Probe, RayCounts, RayMaxima, Tally};
pub use query::{any_hit, closest_hit, closest_hit_brute_force};
pub use record::{
    BoxesStep, CulledStep, InnerStep, LeafOutcome, LeafStep, PixelRecord, RayPath, RecordedRay,
    Step, TestStep, record_pixel, record_pixel_within, record_ray,
};
pub use render::{
    CountedRender, CountedTile, TimedRender, pixel_times, preview, render_counted, render_timed,
    thread_pool,
};
pub use render_error::RenderError;
pub use scalar_kernel::ScalarKernel;
pub use settings::RenderSettings;
pub use simd::{InstructionSet, SimdKernel, SimdMode};
pub use stack::Scratch;
pub use timed_batches::TimedBatches;
pub use timed_kernel::TimedKernel;
#[cfg(test)]
pub(crate) use traversal_ray::{PlaneCrossing, TraversalRay, TraversalRayF64};
pub use traverse::LeafVisitor;
#[cfg(test)]
pub(crate) use traverse::traverse;
pub use visits::{Visits, count_visits};
pub use whitted::{Shading, trace_samples};
