//! The time model of the paper's equation (1): the time of an intersection test that hits, of one
//! that misses, and of a traversed node. The times are measured by regression over a set of trees,
//! and directly by repeating the operations in place.
//!
//! T_TR = (T_T + T_P) · N_NODES + T_B · N_BT + T_I · hits + T_IUN · misses + const, with T_I and T_IUN for
//! each kind of primitive. The paper has no term T_B: its trees have no boxes. `T_T` and `T_P` only occur as a sum, so no regression can separate them.

mod equation;
mod fit;
mod in_place;
mod observe;
mod picture;
mod trees;

pub use equation::{Equation, Term};
pub use fit::{Coefficient, Fit, FitError, fit};
pub use in_place::{InPlace, time_in_place};
pub use observe::{Observation, Terms, observe};
pub use picture::{Part, PictureTerms, RayTerms, Region, TermTimes};
pub use trees::{fastest, parted, trees};
