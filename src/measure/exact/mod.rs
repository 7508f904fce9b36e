//! Exact verification: adversarial rays, decided by rational arithmetic without any filter, against
//! testing every object and against every structure and kernel.
//!
//! A hit is right if object and distance are, bit for bit: the exact distance lies in the ray's interval, no
//! object is exactly nearer, none at exactly the same distance has a lower number, and the distance is
//! the exact one rounded to the nearest number. In `f32` this holds for the objects and the ray as rounded to
//! `f32` in the unit frame. Nothing is shared with the kernels except that rounding.

mod check;
mod kernel;
#[cfg(test)]
mod mutants;
mod oracle;
mod rays;

pub use check::{ExactCheck, ExactError, ExactFault, ExactFaults, check_exactly};
pub use kernel::ExactKernel;
pub use oracle::Oracle;
pub use rays::{ExactRays, RaySource};
