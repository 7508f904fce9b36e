//! Which measure predicts the time of tracing rays?
//!
//! Over a hundred structures of a scene ([`structures`](super::structures)) are traced with sets of primary, shadow,
//! reflected and random rays ([`RaySet`]) by every kernel ([`Observing`]). Then every measure of the structure and of
//! the rays in it, and equation (1), is judged by how much of the times it explains, and by its errors on structures
//! that its fit has not seen ([`judge`]).
//!
//! A time is the CPU time of tracing a set of rays on one thread, without making and shading them; the median of
//! rounds. A measure predicts it by a power law: the logarithm of the time is a line over that of the measure.

mod judge;
mod observe;
mod outcome;
mod predictor;
mod rays;
mod statistics;

pub use judge::{Errors, Judged, Misfit, Score, judge};
pub use observe::{LeftOut, Observation, Observing, Plan, SetObservation};
pub use outcome::{Outcome, over_scenes};
pub use predictor::{Fitted, Predictor, Sample};
pub use rays::{RayOrigin, RaySet};
pub use statistics::{Estimate, estimate, median};

use crate::trace::KernelChoice;

/// The scenes of the whole study: the paper's, and two of other kinds.
pub const SCENES: [&str; 8] = [
    "balls", "rings", "tetra", "fluid", "m-fluid", "room", "lattice", "terrain",
];

/// The kernels of the whole study.
pub const KERNELS: [KernelChoice; 3] = [
    KernelChoice::Scalar,
    KernelChoice::Stream,
    KernelChoice::Packets,
];
