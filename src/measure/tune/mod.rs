//! Finds the best tree for a scene: measures every build method on a small version of the user's
//! picture, ranks them, and refines depth and leaf size of the best two.
//!
//! The search has two phases of [`ROUNDS`] rounds. Each round times every candidate of the phase
//! once, so that a machine that slows down or warms up affects all candidates alike.
//!
//! 1. All methods with automatic depth, leaf size 1, and the default values of their own settings.
//! 2. The best two methods with depths around the automatic one and several leaf sizes. The two
//!    candidates of the first phase are among these and are timed again.
//!
//! All candidates share the scene, the camera, the kernel, the threads and all other settings. A
//! time is `T_TR`, the CPU time of a picture with one sample per pixel; an untimed picture before it
//! brings the tree into the caches. The first time of a candidate comes with its counts.
//!
//! If the number of rays is known that will be traced, candidates are ranked by the time of building once and
//! tracing these rays. Trees that need more memory than allowed are left out before they are timed.
//!
//! [`Tuning`] does the work turn by turn, [`rank`] and [`best`] judge what is measured so far.

mod candidates;
mod goal;
mod phase;
mod ranking;
mod row;
mod search;
mod tuning;

pub use candidates::{NAIVE_LIMIT, is_tried};
pub use goal::Goal;
pub use phase::Phase;
pub use ranking::{MOST_SLOWDOWN, Rank, Score, Spread, best, rank};
pub use row::Row;
pub use search::{LeftOut, Search, Tuned};
pub use tuning::{ROUNDS, Tuning, Turn, Upcoming};
