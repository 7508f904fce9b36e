//! What has arrived from a job and was not received yet.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How a job ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End<O> {
    Done(O),
    Cancelled,
    /// A newer job took the slot.
    Replaced,
    /// Why it could not be done.
    Failed(String),
}

/// What arrived from a job since the last look.
#[derive(Debug)]
pub struct News<P, O> {
    /// In the order in which they were sent.
    pub partials: Vec<P>,
    /// Present once, when the job has ended. Nothing follows it.
    pub end: Option<End<O>>,
}

pub(super) struct Inbox<P, O> {
    state: Mutex<State<P, O>>,
    closed: Condvar,
}

struct State<P, O> {
    partials: Vec<P>,
    end: Option<End<O>>,
    closed: bool,
}

impl<P, O> Inbox<P, O> {
    pub fn new() -> Self {
        Inbox {
            state: Mutex::new(State {
                partials: Vec::new(),
                end: None,
                closed: false,
            }),
            closed: Condvar::new(),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State<P, O>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds a partial result; ignored once the job has ended.
    pub fn send(&self, partial: P) {
        let mut state = self.lock();
        if !state.closed {
            state.partials.push(partial);
        }
    }

    /// Ends the job; only the first end counts. What a replaced job has sent is discarded.
    pub fn close(&self, end: End<O>) {
        let mut state = self.lock();
        if state.closed {
            return;
        }
        if matches!(end, End::Replaced) {
            state.partials.clear();
        }
        state.end = Some(end);
        state.closed = true;
        self.closed.notify_all();
    }

    /// Waits until the job has ended, at most this long. Returns whether it has.
    pub fn wait(&self, patience: Duration) -> bool {
        let waited = self
            .closed
            .wait_timeout_while(self.lock(), patience, |state| !state.closed);
        waited.unwrap_or_else(PoisonError::into_inner).0.closed
    }

    pub fn is_closed(&self) -> bool {
        self.lock().closed
    }

    pub fn receive(&self) -> News<P, O> {
        let mut state = self.lock();
        News {
            partials: std::mem::take(&mut state.partials),
            end: state.end.take(),
        }
    }
}
