//! Starts jobs and ends them.

use super::board::{Board, Entry, JobStatus};
use super::context::Context;
use super::inbox::{End, Inbox, News};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::progress::Progress;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Duration;

/// Runs all jobs, each on a thread of its own. Dropping it cancels all jobs and waits for the end of
/// their threads.
pub struct Scheduler {
    starter: Starter,
}

impl Scheduler {
    /// A scheduler without jobs. It calls `wake`, from any thread, whenever a job has news.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        let board = Arc::new(Board::new(wake));
        Scheduler {
            starter: Starter { board },
        }
    }

    fn board(&self) -> &Board {
        &self.starter.board
    }

    /// What starts jobs from elsewhere.
    pub fn starter(&self) -> Starter {
        self.starter.clone()
    }

    /// Starts a job in place of the one in its slot.
    pub fn start<J: Job>(&self, job: J) -> Handle<J> {
        self.starter.start(job)
    }

    /// All live jobs, in the order in which they were started.
    pub fn jobs(&self) -> Vec<JobStatus> {
        self.board().jobs()
    }

    /// Jobs whose threads have not ended yet. A job that was cancelled is not live any more, but its
    /// thread may need a moment.
    pub fn threads(&self) -> usize {
        self.board().threads()
    }

    /// Cancels all live jobs that fit.
    pub fn cancel_where(&self, fits: impl Fn(&JobStatus) -> bool) {
        self.board().cancel_where(fits);
    }

    /// Pauses the job in a slot: it begins no other unit until it is resumed.
    pub fn pause(&self, slot: Slot) {
        self.board().set_paused(slot, true);
    }

    pub fn resume(&self, slot: Slot) {
        self.board().set_paused(slot, false);
    }

    /// Waits until nothing happens any more. Returns whether no job is left; if not, those that are
    /// left are paused, or wait for a paused one.
    pub fn wait(&self) -> bool {
        self.board().wait()
    }

    /// Does work on the thread of the caller as a job, which other jobs take into account and which
    /// is listed with them. It is one unit, which nothing interrupts.
    pub fn run_here<R>(
        &self,
        slot: Slot,
        stage: &str,
        timed: bool,
        work: impl FnOnce(&Progress) -> R,
    ) -> R {
        let board = &self.starter.board;
        let entry = Entry {
            slot,
            priority: Priority::Now,
            close: Box::new(|_| ()),
        };
        let added = board.add(entry, |_| Ok(None));
        let Ok(Some(number)) = added else {
            // Only a closed scheduler does not add it, and only its owner closes it.
            return work(&Progress::new());
        };
        let _removed = Removed { board, number };
        let context = Context::<()>::new(Arc::clone(board), number, drop);
        context.stage(stage);
        let unit = context.begin(timed);
        match &unit {
            Some(unit) => work(&unit.progress),
            None => {
                let cancelled = Progress::new();
                cancelled.cancel();
                work(&cancelled)
            }
        }
    }
}

/// Removes a job that runs on the thread of the caller, even where its work panics.
struct Removed<'a> {
    board: &'a Board,
    number: u64,
}

impl Drop for Removed<'_> {
    fn drop(&mut self) {
        self.board.remove(self.number, || ());
    }
}

impl Drop for Scheduler {
    fn drop(&mut self) {
        self.starter.board.close();
    }
}

/// Starts jobs of a [`Scheduler`]. After the scheduler is dropped, jobs are cancelled at once.
#[derive(Clone)]
pub struct Starter {
    board: Arc<Board>,
}

impl Starter {
    /// Starts a job in place of the one in its slot.
    pub fn start<J: Job>(&self, job: J) -> Handle<J> {
        let inbox = Arc::new(Inbox::new());
        let (board, to_close) = (&self.board, Arc::clone(&inbox));
        let (slot, priority) = job.place();
        let entry = Entry {
            slot,
            priority,
            close: Box::new(move |early| to_close.close(early.end())),
        };
        let thread = |number| {
            let (board, inbox) = (Arc::clone(board), Arc::clone(&inbox));
            std::thread::Builder::new()
                .name(slot.name().to_owned())
                .spawn(move || run(job, &board, number, &inbox))
                .map(Some)
        };
        let number = match board.add(entry, thread) {
            Ok(Some(number)) => number,
            Ok(None) => {
                inbox.close(End::Cancelled);
                0
            }
            Err(error) => {
                inbox.close(End::Failed(format!("no thread could be started: {error}")));
                0
            }
        };
        Handle {
            board: Arc::clone(board),
            number,
            inbox,
        }
    }
}

fn run<J: Job>(job: J, board: &Arc<Board>, number: u64, inbox: &Arc<Inbox<J::Partial, J::Output>>) {
    let to_send = Arc::clone(inbox);
    let context = Context::new(Arc::clone(board), number, move |partial| {
        to_send.send(partial);
    });
    let end = match catch_unwind(AssertUnwindSafe(|| job.run(&context))) {
        Ok(Ok(output)) => End::Done(output),
        Ok(Err(error)) => End::Failed(error.reason().to_owned()),
        Err(panic) => End::Failed(format!("internal error: {}", panic_text(&*panic))),
    };
    board.remove(number, || inbox.close(end));
}

fn panic_text(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("for an unknown reason")
}

/// A job that was started. Dropping it cancels the job.
pub struct Handle<J: Job> {
    board: Arc<Board>,
    number: u64,
    inbox: Arc<Inbox<J::Partial, J::Output>>,
}

impl<J: Job> Handle<J> {
    /// What arrived since the last call.
    pub fn receive(&self) -> News<J::Partial, J::Output> {
        self.inbox.receive()
    }

    /// Waits until it has ended, at most this long. Returns whether it has.
    pub fn wait(&self, patience: Duration) -> bool {
        self.inbox.wait(patience)
    }

    /// Whether it has not ended.
    pub fn is_live(&self) -> bool {
        !self.inbox.is_closed()
    }

    /// Stage, fraction and standing; `None` once it has ended.
    pub fn status(&self) -> Option<JobStatus> {
        self.board.status(self.number)
    }

    /// Ends the job. What it has sent can still be received.
    pub fn cancel(&self) {
        self.board.cancel(self.number);
    }
}

impl<J: Job> Drop for Handle<J> {
    fn drop(&mut self) {
        self.cancel();
    }
}
