//! Work in the background: the [`Job`] trait and the one [`Scheduler`] that runs all jobs.
//!
//! A job takes a [`Slot`]; a newer job in the same slot replaces the older one. Its work consists of
//! units ([`Context::unit`], [`Context::timed`]). Between units the scheduler decides who runs next:
//!
//! - A job waits while a job of higher [`Priority`] is live. A unit that is running when such a job
//!   starts is interrupted, and repeated later from its beginning.
//! - A timed unit runs alone: it begins when no other unit runs, and no other unit begins before it
//!   ends. A time is never measured beside other work, and never across an interruption.
//! - Jobs of equal priority share the machine, except that timed units run in the order in which
//!   their jobs were started.
//!
//! Whoever starts a job holds its [`Handle`]: it receives partial results and how the job ended, and
//! cancels the job when dropped. Nothing arrives from a job that was replaced. Progress and stage
//! belong to the live job, so that the list of jobs never shows one that is gone.
//!
//! The modules import from each other in this order: `slot`, `inbox`, `board`, `context`, `job`,
//! `scheduler`; then one file per job.

mod accuracy;
mod board;
mod build;
mod cache;
mod context;
mod export;
mod inbox;
mod job;
mod load;
mod measures;
mod paper;
mod picture;
mod picture_terms;
mod pixel_counts;
mod pixel_times;
mod scheduler;
mod slot;
mod sweep;
mod time_model;
mod tune;
mod verification;
mod visits;

pub use accuracy::{Measured, StudyAccuracy};
pub use board::{JobStatus, Standing};
pub use build::Build;
pub use cache::{Built, Cache};
pub use context::{Context, JobError};
pub use export::{Export, MakeBytes};
pub use inbox::{End, News};
pub use job::{Job, Run};
pub use load::Load;
pub use measures::StudyMeasures;
pub use paper::RepeatPaper;
pub use picture::{RenderPicture, Shown, Stage, Update};
pub use picture_terms::CountTerms;
pub use pixel_counts::{CountPixels, CountedPixels};
pub use pixel_times::TimePixels;
pub use scheduler::{Handle, Scheduler, Starter};
pub use slot::{Priority, Slot};
pub use sweep::Sweep;
pub use time_model::{FitTimeModel, Timed};
pub use tune::{FindBestTree, Tried};
pub use verification::Verify;
pub use visits::{CountVisits, PictureVisits};
