//! What a job sees of the scheduler.

use super::board::Board;
use crate::progress::Progress;
use std::sync::Arc;

/// Why a job failed, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JobError(String);

impl JobError {
    pub fn new(reason: impl Into<String>) -> Self {
        JobError(reason.into())
    }

    pub fn reason(&self) -> &str {
        &self.0
    }

    /// Of a job that was cancelled or replaced. Nobody reads it: the job's end is known already.
    fn cancelled() -> Self {
        JobError::new("cancelled")
    }
}

impl<E: std::error::Error> From<E> for JobError {
    fn from(error: E) -> Self {
        JobError(error.to_string())
    }
}

/// The scheduler as a running job sees it. `P` are the job's partial results.
pub struct Context<P> {
    board: Arc<Board>,
    number: u64,
    send: Arc<dyn Fn(P) + Send + Sync>,
}

impl<P: 'static> Context<P> {
    pub(super) fn new(
        board: Arc<Board>,
        number: u64,
        send: impl Fn(P) + Send + Sync + 'static,
    ) -> Self {
        Context {
            board,
            number,
            send: Arc::new(send),
        }
    }

    /// The same job's context for a part of it that has other partial results.
    pub fn map<Q: 'static>(&self, map: impl Fn(Q) -> P + Send + Sync + 'static) -> Context<Q> {
        let send = Arc::clone(&self.send);
        Context::new(Arc::clone(&self.board), self.number, move |partial| {
            send(map(partial));
        })
    }

    /// The same job's context for a part of it whose partial results nobody needs.
    pub fn silent<Q: 'static>(&self) -> Context<Q> {
        Context::new(Arc::clone(&self.board), self.number, drop)
    }

    /// Begins a stage, described in a few words for people. Its fraction is 0.
    pub fn stage(&self, text: impl Into<String>) {
        self.board.set_stage(self.number, text.into());
    }

    /// Says that the next units are number `done` of `all` equal parts of the stage.
    pub fn part(&self, done: usize, all: usize) {
        let share = |parts: usize| parts as f64 / all.max(1) as f64;
        self.board
            .set_span(self.number, [share(done), share(done + 1)]);
    }

    /// Sends a partial result. It is dropped if the job was cancelled or replaced.
    pub fn send(&self, partial: P) {
        (self.send)(partial);
        self.board.wake();
    }

    /// Returns an error once the job was cancelled or replaced. For work outside of units.
    ///
    /// # Errors
    /// The job was cancelled or replaced.
    pub fn check(&self) -> Result<(), JobError> {
        if self.board.is_live(self.number) {
            Ok(())
        } else {
            Err(JobError::cancelled())
        }
    }

    /// Does one unit of work, beside other jobs of the same priority. If a job of higher priority
    /// interrupts it, it is repeated.
    ///
    /// # Errors
    /// The job was cancelled or replaced, or the work failed.
    pub fn unit<R, E: Into<JobError>>(
        &self,
        work: impl FnMut(&Progress) -> Result<R, E>,
    ) -> Result<R, JobError> {
        self.repeat(false, work)
    }

    /// As [`Context::unit`], but alone: no unit of another job runs meanwhile.
    ///
    /// # Errors
    /// As [`Context::unit`].
    pub fn timed<R, E: Into<JobError>>(
        &self,
        work: impl FnMut(&Progress) -> Result<R, E>,
    ) -> Result<R, JobError> {
        self.repeat(true, work)
    }

    fn repeat<R, E: Into<JobError>>(
        &self,
        timed: bool,
        mut work: impl FnMut(&Progress) -> Result<R, E>,
    ) -> Result<R, JobError> {
        loop {
            let unit = self.begin(timed).ok_or_else(JobError::cancelled)?;
            match work(&unit.progress) {
                Err(_) if unit.progress.is_cancelled() => {}
                result => return result.map_err(Into::into),
            }
        }
    }

    /// Begins a unit that ends when the guard is dropped; `None` if the job was cancelled or
    /// replaced.
    pub(super) fn begin(&self, timed: bool) -> Option<Unit<'_>> {
        let progress = self.board.begin_unit(self.number, timed)?;
        Some(Unit {
            board: &self.board,
            number: self.number,
            progress,
        })
    }
}

/// A unit on its way. It ends even where its work panics.
pub(super) struct Unit<'a> {
    board: &'a Board,
    number: u64,
    pub progress: Progress,
}

impl Drop for Unit<'_> {
    fn drop(&mut self) {
        self.board.end_unit(self.number);
    }
}
