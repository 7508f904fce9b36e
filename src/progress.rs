//! Progress and cancellation of long tasks.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The progress of a task, shared between the threads that do it and the one that waits for it.
/// Clones share the same state.
#[derive(Clone, Debug)]
pub struct Progress {
    state: Arc<State>,
    /// The interval of the whole task that [`Progress::set`] covers.
    span: [f64; 2],
}

impl Default for Progress {
    fn default() -> Self {
        Progress {
            state: Arc::default(),
            span: [0.0, 1.0],
        }
    }
}

#[derive(Debug, Default)]
struct State {
    cancelled: AtomicBool,
    fraction_bits: AtomicU64,
}

/// The task was cancelled before it was complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

impl Progress {
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the progress of a part of the task, which covers the fractions `from` to `to` of
    /// this one.
    pub fn part(&self, from: f64, to: f64) -> Progress {
        let [start, end] = self.span;
        let place = |fraction: f64| start + fraction * (end - start);
        Progress {
            state: Arc::clone(&self.state),
            span: [place(from), place(to)],
        }
    }

    /// Requests that the task stops at its next check.
    pub fn cancel(&self) {
        self.state.cancelled.store(true, Ordering::Relaxed);
    }

    pub fn is_cancelled(&self) -> bool {
        self.state.cancelled.load(Ordering::Relaxed)
    }

    /// Returns an error if the task was cancelled; for use with `?` in loops.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// Sets the completed fraction of the task, or of its part, from 0 to 1.
    pub fn set(&self, fraction: f64) {
        let [start, end] = self.span;
        let whole = start + fraction.clamp(0.0, 1.0) * (end - start);
        self.state
            .fraction_bits
            .store(whole.to_bits(), Ordering::Relaxed);
    }

    /// Returns the completed fraction of the whole task, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        f64::from_bits(self.state.fraction_bits.load(Ordering::Relaxed))
    }
}
