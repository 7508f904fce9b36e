//! A job about one picture, started when a pane needs its result.

use super::result::Current;
use crate::jobs::{End, Handle, Job, Scheduler, Standing};
use std::cell::{Cell, RefCell};
use std::sync::Arc;

/// The job about one picture, and its result; forgotten with the picture. Asking for the result starts
/// the job, which changes nothing that anyone sees: hence the cells.
pub struct PictureJob<J: Job> {
    /// Number of the picture that the job is about.
    number: Cell<Option<u64>>,
    at: RefCell<At<J>>,
}

enum At<J: Job> {
    /// Starts when it is needed.
    Due,
    Running(Handle<J>),
    Done(Arc<J::Output>),
    /// Not done, and why.
    Ended(String),
}

/// How such a job stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// It has not begun.
    Waiting,
    /// How much is done, 0 to 1.
    Running(f64),
    Done,
    Ended(String),
}

impl<J: Job> Default for PictureJob<J> {
    fn default() -> Self {
        PictureJob {
            number: Cell::default(),
            at: RefCell::new(At::Due),
        }
    }
}

impl<J: Job> PictureJob<J> {
    /// The result for this picture. Starts the job if the picture is finished.
    pub fn get(
        &self,
        current: &Current,
        jobs: &Scheduler,
        make: impl FnOnce() -> J,
    ) -> Option<Arc<J::Output>> {
        self.follow(current);
        let mut at = self.at.borrow_mut();
        if let At::Running(handle) = &*at
            && let Some(end) = handle.receive().end
        {
            *at = match end {
                End::Done(output) => At::Done(Arc::new(output)),
                End::Failed(why) => At::Ended(why),
                End::Cancelled => At::Ended("cancelled".to_owned()),
                // Another pane asked for the same of another picture.
                End::Replaced => At::Due,
            };
        }
        match &*at {
            At::Done(output) => Some(Arc::clone(output)),
            At::Due if current.done => {
                *at = At::Running(jobs.start(make()));
                None
            }
            _ => None,
        }
    }

    /// Forgets a job about a different picture. Returns whether the picture is different.
    pub fn follow(&self, current: &Current) -> bool {
        let different = self.number.replace(Some(current.number)) != Some(current.number);
        if different {
            self.at.replace(At::Due);
        }
        different
    }

    pub fn is_running(&self) -> bool {
        matches!(*self.at.borrow(), At::Running(_))
    }

    /// The result, if it is there.
    pub fn ready(&self) -> Option<Arc<J::Output>> {
        match &*self.at.borrow() {
            At::Done(output) => Some(Arc::clone(output)),
            _ => None,
        }
    }

    /// Cancels a job that nothing needs any more; it starts anew when it is needed again.
    pub fn drop_unneeded(&mut self) {
        if self.is_running() {
            self.at.replace(At::Due);
        }
    }

    /// Cancels a running job until [`PictureJob::again`].
    pub fn cancel(&mut self) {
        if self.is_running() {
            self.at.replace(At::Ended("cancelled".to_owned()));
        }
    }

    /// Lets a job start again that was not done.
    pub fn again(&mut self) {
        if matches!(*self.at.get_mut(), At::Ended(_)) {
            self.at.replace(At::Due);
        }
    }

    /// Cancels a running job, or lets one start again that was not done.
    pub fn cancel_or_restart(&mut self) {
        if self.is_running() {
            self.cancel();
        } else {
            self.again();
        }
    }

    pub fn progress(&self) -> Progress {
        match &*self.at.borrow() {
            At::Due => Progress::Waiting,
            At::Running(handle) => match handle.status() {
                Some(status) if status.standing == Standing::Running => {
                    Progress::Running(status.fraction)
                }
                _ => Progress::Waiting,
            },
            At::Done(_) => Progress::Done,
            At::Ended(why) => Progress::Ended(why.clone()),
        }
    }
}
