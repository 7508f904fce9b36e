//! Exact arithmetic, which decides why two answers about a ray differ.
//!
//! Every coordinate is a fraction. A ray hits triangles and polygons at a rational distance. It
//! hits spheres, cylinders and cones at a root of a quadratic equation with rational coefficients;
//! such roots can be compared exactly, too. So nothing is rounded, and distinct points of a ray
//! stay distinct.
//!
//! The same arithmetic on intervals ([`span`]) decides what is possible if all coordinates were
//! first rounded by at most a [`Tolerance`].

mod case;
mod chord;
mod crossing;
mod flat;
mod meeting;
mod quadric;
mod span;
mod surface;
mod tolerance;
mod verdict;

pub use case::{Answerer, Case, CaseError};
pub(super) use crossing::Line;
pub(super) use meeting::{Meeting, enlarged};
pub(super) use surface::Surface;
pub use tolerance::Tolerance;
pub use verdict::{Answer, Standing, Tally, Verdict, examine, examine_with, scale_of, settle};
