//! Finds the best tree for a scene: measures every build method with many settings on a small version of the user's
//! picture, and ranks them.
//!
//! The search is a successive halving. A *rung* is one of its steps; after each, [`rounds_after`] tells how often the
//! candidates that are left have been timed:
//!
//! 1. Every method is timed once with its defaults, then every method with its other settings
//!    ([`variations`](super::variations)): depths and leaf sizes, widths and leaves of hierarchies, densities of grids.
//!    The methods take turns, beginning with the one that was fastest. When two thirds of the budget are spent, no more
//!    are tried.
//! 2. The better half is timed once more, the better half of these twice more, and so on, until one or two are left or
//!    the budget is spent. A candidate that cannot be told apart from the best stays.
//!
//! Every round times every candidate that is left once, so that a machine that slows down or warms up affects all
//! candidates alike. All candidates share the scene, the camera, the kernel, the threads and all other settings. A time
//! is `T_TR`, the CPU time of a picture with one sample per pixel; an untimed picture before it brings the tree into the
//! caches. Only the defaults of methods and what is timed more than once are counted.
//!
//! If the number of rays is known that will be traced, candidates are ranked by the time of building once and
//! tracing these rays. Trees that need more memory than allowed are left out before they are timed.
//!
//! Reports state the last rung of every candidate, from 0. (It replaces `phase`, of a search that refined only the depth
//! and leaf size of the best two methods.) Candidates of one method differ in `constants`, too.
//!
//! [`Tuning`] does the work turn by turn, [`rank`] and [`best`] judge what is measured so far.

mod candidates;
mod goal;
mod halving;
mod ranking;
mod row;
mod search;
mod tuning;

pub use candidates::{NAIVE_LIMIT, is_tried};
pub use goal::Goal;
pub use halving::{RUNGS, rounds_after};
pub use ranking::{MOST_SLOWDOWN, Rank, Score, Spread, best, rank};
pub use row::Row;
pub use search::{LeftOut, Search, Tuned};
pub use tuning::{Tuning, Turn, Upcoming};
