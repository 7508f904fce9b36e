//! Verification in the background: once a picture is finished, sampled rays of it are checked while
//! nothing else runs.

use super::state::State;
use crate::jobs::{End, Handle, News, Verify};
use crate::measure::Verification;
use std::sync::Arc;

/// What verification has found of one picture.
#[derive(Default)]
pub struct Judging {
    /// Number of the picture.
    number: Option<u64>,
    running: Option<Handle<Verify>>,
    /// Whether the user does not want it.
    pub stopped: bool,
    pub result: Verification,
    /// Whether all sampled rays were checked.
    pub complete: bool,
    /// Whether it could not be done.
    failed: bool,
}

impl Judging {
    /// How much of the sample has been checked, 0 to 1; `None` while it has not begun.
    pub fn progress(&self) -> Option<f64> {
        let checked = self.result.rays.iter().any(|rays| *rays > 0);
        let status = self.running.as_ref().filter(|_| checked)?.status()?;
        Some(status.fraction)
    }

    pub(super) fn receive(&mut self) {
        let Some(handle) = &self.running else {
            return;
        };
        let News { mut partials, end } = handle.receive();
        if let Some(result) = partials.pop() {
            self.result = result;
        }
        if let Some(end) = end {
            self.running = None;
            match end {
                End::Done(result) => {
                    self.result = result;
                    self.complete = true;
                }
                End::Failed(_) => self.failed = true,
                End::Cancelled => self.stopped = true,
                End::Replaced => {}
            }
        }
    }
}

impl State {
    /// Starts verification of a finished picture, and ends that of another.
    pub fn judge_rays(&mut self) {
        let number = self.current.as_ref().map(|current| current.number);
        let judging = &mut self.judging;
        if judging.number != number {
            *judging = Judging {
                number,
                stopped: judging.stopped,
                ..Judging::default()
            };
        }
        if judging.stopped {
            judging.running = None;
        } else if let Some(current) = self.current.as_ref().filter(|current| current.done)
            && judging.running.is_none()
            && !(judging.complete || judging.failed)
        {
            let shown = &current.shown;
            judging.result = Verification::default();
            judging.running = Some(self.jobs.start(Verify {
                scene: Arc::clone(&shown.scene),
                tree: Arc::clone(&shown.tree),
                render: shown.setup.render,
            }));
        }
    }
}
