//! What a job is.

use super::context::{Context, JobError};
use super::slot::{Priority, Slot};

/// Work in the background.
pub trait Job: Send + 'static {
    /// What it sends before it is done.
    type Partial: Send + 'static;
    /// What it sends when it is done.
    type Output: Send + 'static;

    /// Returns which job it replaces, and which jobs it goes before.
    fn place(&self) -> (Slot, Priority);

    /// Does the work: everything that takes long in units of `context`, everything whose time is
    /// measured in timed units.
    ///
    /// # Errors
    /// Why the work failed; or the error of a unit, if the job was cancelled.
    fn run(self, context: &Context<Self::Partial>) -> Result<Self::Output, JobError>;
}

type Work<T> = Box<dyn FnOnce(&Context<()>) -> Result<T, JobError> + Send>;

/// A job made of a function, for work that has no partial results.
pub struct Run<T> {
    slot: Slot,
    priority: Priority,
    work: Work<T>,
}

impl<T> Run<T> {
    pub fn new(
        slot: Slot,
        priority: Priority,
        work: impl FnOnce(&Context<()>) -> Result<T, JobError> + Send + 'static,
    ) -> Self {
        Run {
            slot,
            priority,
            work: Box::new(work),
        }
    }
}

impl<T: Send + 'static> Job for Run<T> {
    type Partial = ();
    type Output = T;

    fn place(&self) -> (Slot, Priority) {
        (self.slot, self.priority)
    }

    fn run(self, context: &Context<()>) -> Result<T, JobError> {
        (self.work)(context)
    }
}
