//! Everything that is measured: every parameter of the paper's Tables 1 to 3, the septet Δ and the
//! triplet Λ, and the studies based on them.

pub mod accuracy;
pub mod answers;
mod comparison;
mod counter;
pub mod exact;
mod facts;
pub mod heat;
pub mod judge;
mod measurement;
pub mod model;
mod overlap;
pub mod paper;
mod processor;
mod random;
pub mod stability;
mod structures;
pub mod study;
pub mod sweep;
pub mod tune;
mod verify;

pub use comparison::{BreakEven, Change, Comparison, Unequal, change, differing_pixels, unequal};
pub use counter::{
    ACROSS_STRUCTURES, COUNTERS, Class, Counter, DELTA, LAMBDA, Parameter, RayFigure, Table, Unit,
    parameter, parameters, ray_figures,
};
pub use facts::{SceneFacts, TreeFacts};
pub use measurement::{MeasureError, Measured, Measurement, Times, measure, measure_pixels};
pub use processor::processor;
pub use structures::{structures, variations};
pub use verify::{
    Answers, RaySample, Verification, answer, ask, compare, sample_rays, unsplit, verify_sample,
};
