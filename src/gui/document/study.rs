//! A long measurement that the user started: its job, and what it has found so far.

use crate::jobs::{End, Handle, Job, JobStatus, News};
use std::sync::Arc;

/// The study that was started last, with what is known of it; nothing before the first. What was
/// found stays when the study is cancelled.
pub struct Study<J: Job, F> {
    running: Option<Handle<J>>,
    found: Option<Arc<F>>,
    end: Option<End<()>>,
}

impl<J: Job, F> Default for Study<J, F> {
    fn default() -> Self {
        Study {
            running: None,
            found: None,
            end: None,
        }
    }
}

impl<J: Job, F: Clone> Study<J, F> {
    /// Follows a study that was started, in place of the one before; `found` is what is known at
    /// first.
    pub fn follow(&mut self, handle: Handle<J>, found: F) {
        self.running = Some(handle);
        self.found = Some(Arc::new(found));
        self.end = None;
    }

    /// Adds what has arrived to what is known. Returns the output when the study is done.
    pub fn receive(&mut self, mut add: impl FnMut(&mut F, J::Partial)) -> Option<J::Output> {
        let News { partials, end } = self.running.as_ref()?.receive();
        if let Some(found) = &mut self.found
            && !partials.is_empty()
        {
            let found = Arc::make_mut(found);
            for partial in partials {
                add(found, partial);
            }
        }
        let (end, output) = match end? {
            End::Done(output) => (End::Done(()), Some(output)),
            End::Cancelled => (End::Cancelled, None),
            End::Replaced => (End::Replaced, None),
            End::Failed(why) => (End::Failed(why), None),
        };
        self.end = Some(end);
        self.running = None;
        output
    }

    /// What is known of the last study.
    pub fn found(&self) -> Option<&Arc<F>> {
        self.found.as_ref()
    }

    /// Changes what is known of the last study.
    pub fn found_mut(&mut self) -> Option<&mut F> {
        self.found.as_mut().map(Arc::make_mut)
    }

    /// How the last study ended; `None` while it runs, and before the first.
    pub fn end(&self) -> Option<&End<()>> {
        self.end.as_ref()
    }

    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Progress and standing of the study; `None` while none runs.
    pub fn status(&self) -> Option<JobStatus> {
        self.running.as_ref()?.status()
    }

    /// Ends the study; what is known of it stays.
    pub fn cancel(&mut self) {
        if let Some(handle) = &self.running {
            handle.cancel();
        }
    }
}
