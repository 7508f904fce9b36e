//! A job about one picture, started when a pane needs its result.

use super::result::Current;
use crate::jobs::{End, Handle, Job, Scheduler, Standing};
use std::sync::Arc;

/// The job about one picture, and its result; forgotten with the picture.
pub struct PictureJob<J: Job> {
    /// Number of the picture that the job is about.
    number: Option<u64>,
    at: At<J>,
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
            number: None,
            at: At::Due,
        }
    }
}

impl<J: Job> PictureJob<J> {
    /// The result for this picture. Starts the job if the picture is finished.
    pub fn get(
        &mut self,
        current: &Current,
        jobs: &Scheduler,
        make: impl FnOnce() -> J,
    ) -> Option<Arc<J::Output>> {
        self.follow(current);
        if let At::Running(handle) = &self.at
            && let Some(end) = handle.receive().end
        {
            self.at = match end {
                End::Done(output) => At::Done(Arc::new(output)),
                End::Failed(why) => At::Ended(why),
                End::Cancelled => At::Ended("cancelled".to_owned()),
                // Another pane asked for the same of another picture.
                End::Replaced => At::Due,
            };
        }
        match &self.at {
            At::Done(output) => Some(Arc::clone(output)),
            At::Due if current.done => {
                self.at = At::Running(jobs.start(make()));
                None
            }
            _ => None,
        }
    }

    /// Forgets a job about another picture. Returns whether the picture is another.
    pub fn follow(&mut self, current: &Current) -> bool {
        let another = self.number != Some(current.number);
        if another {
            self.number = Some(current.number);
            self.at = At::Due;
        }
        another
    }

    pub fn is_running(&self) -> bool {
        matches!(self.at, At::Running(_))
    }

    /// The result, if it is there.
    pub fn ready(&self) -> Option<Arc<J::Output>> {
        match &self.at {
            At::Done(output) => Some(Arc::clone(output)),
            _ => None,
        }
    }

    /// Cancels a job that nothing needs any more; it starts anew when it is needed again.
    pub fn drop_unneeded(&mut self) {
        if self.is_running() {
            self.at = At::Due;
        }
    }

    /// Cancels a running job until [`PictureJob::again`].
    pub fn cancel(&mut self) {
        if self.is_running() {
            self.at = At::Ended("cancelled".to_owned());
        }
    }

    /// Lets a job start again that was not done.
    pub fn again(&mut self) {
        if matches!(self.at, At::Ended(_)) {
            self.at = At::Due;
        }
    }

    pub fn progress(&self) -> Progress {
        match &self.at {
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
