//! Verification in the background: once a picture is finished, sampled rays of it are checked while
//! nothing else runs.

use crate::gui::document::Document;
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

    pub fn receive(&mut self) {
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

impl Judging {
    /// Starts verification of a finished picture, and ends that of another.
    pub fn follow(&mut self, doc: &Document) {
        let number = doc.current.as_ref().map(|current| current.number);
        if self.number != number {
            *self = Judging {
                number,
                stopped: self.stopped,
                ..Judging::default()
            };
        }
        if self.stopped {
            self.running = None;
        } else if let Some(current) = doc.current.as_ref().filter(|current| current.done)
            && self.running.is_none()
            && !(self.complete || self.failed)
        {
            let shown = &current.shown;
            self.result = Verification::default();
            self.running = Some(doc.jobs.start(Verify {
                scene: Arc::clone(&shown.scene),
                tree: Arc::clone(&shown.tree),
                render: shown.setup.render,
            }));
        }
    }
}
