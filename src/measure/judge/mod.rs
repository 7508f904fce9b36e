//! The judge: where two answers about a ray differ, exact arithmetic says why.
//!
//! Every coordinate is a fraction. Triangles and polygons are met where a fraction says; spheres,
//! cylinders and cones at a root of a quadratic equation with rational coefficients, and such roots
//! compare exactly, too. So nothing is rounded and no two places on a ray are confused.
//!
//! The same arithmetic on intervals ([`span`]) says what is left open if all numbers were rounded
//! first, by no more than a [`Tolerance`].

mod case;
mod crossing;
mod flat;
mod object;
mod quadric;
mod root;
mod span;
mod tolerance;
mod verdict;

pub use case::{Case, CaseError};
pub use tolerance::Tolerance;
pub use verdict::{Answer, Standing, Tally, Verdict, examine, scale_of, settle};
