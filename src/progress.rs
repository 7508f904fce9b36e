//! How a long task says how far it is, and how it is told to stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Shared between the one that waits for a task and the threads that do it. Cloning shares it.
#[derive(Clone, Debug)]
pub struct Progress {
    state: Arc<State>,
    /// The stretch of the whole that [`Progress::set`] fills.
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

/// The task was told to stop before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

impl Progress {
    pub fn new() -> Self {
        Self::default()
    }

    /// The same progress for a part of the task, which fills the fractions `from` to `to` of this one.
    pub fn part(&self, from: f64, to: f64) -> Progress {
        let [start, end] = self.span;
        let place = |fraction: f64| start + fraction * (end - start);
        Progress {
            state: Arc::clone(&self.state),
            span: [place(from), place(to)],
        }
    }

    /// Asks the task to stop at its next look.
    pub fn cancel(&self) {
        self.state.cancelled.store(true, Ordering::Relaxed);
    }

    pub fn is_cancelled(&self) -> bool {
        self.state.cancelled.load(Ordering::Relaxed)
    }

    /// `Err` once the task was asked to stop: for use with `?` inside loops.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() {
            Err(Cancelled)
        } else {
            Ok(())
        }
    }

    /// Says how much is done of it, or of its part, 0 to 1.
    pub fn set(&self, fraction: f64) {
        let [start, end] = self.span;
        let whole = start + fraction.clamp(0.0, 1.0) * (end - start);
        self.state
            .fraction_bits
            .store(whole.to_bits(), Ordering::Relaxed);
    }

    /// How much of the whole is done, 0 to 1.
    pub fn fraction(&self) -> f64 {
        f64::from_bits(self.state.fraction_bits.load(Ordering::Relaxed))
    }
}
