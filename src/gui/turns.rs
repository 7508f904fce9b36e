//! Long work in the background, turn by turn, and only while the worker rests, so that neither's times
//! suffer. A turn that the worker interrupts is taken again. What was found so far stays when the work
//! is cancelled.

use crate::progress::Progress;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Work on its way or ended, with what was found; nothing before the first. Dropping it ends the
/// thread's work.
pub struct Turns<T> {
    run: Option<Run<T>>,
}

impl<T> Default for Turns<T> {
    fn default() -> Self {
        Turns { run: None }
    }
}

/// How work ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    Complete,
    Cancelled,
    Failed(String),
}

/// What is known of the work.
#[derive(Clone)]
struct Known<T> {
    found: Arc<T>,
    /// `None` while it goes on.
    end: Option<End>,
}

struct Run<T> {
    gate: Arc<Gate>,
    known: Arc<Mutex<Known<T>>>,
}

impl<T> Drop for Run<T> {
    fn drop(&mut self) {
        self.gate.cancel();
    }
}

/// Lets turns begin, or not.
#[derive(Default)]
struct Gate {
    state: Mutex<GateState>,
    changed: Condvar,
}

#[derive(Default)]
struct GateState {
    open: bool,
    cancelled: bool,
    /// Of the turn that is being taken.
    turn: Progress,
}

impl Gate {
    fn lock(&self) -> MutexGuard<'_, GateState> {
        lock(&self.state)
    }

    /// Opens or closes it; closing interrupts the turn that is being taken.
    fn set(&self, open: bool) {
        let mut state = self.lock();
        if state.open != open {
            state.open = open;
            if !open {
                state.turn.cancel();
            }
            self.changed.notify_all();
        }
    }

    fn cancel(&self) {
        let mut state = self.lock();
        state.cancelled = true;
        state.turn.cancel();
        self.changed.notify_all();
    }

    /// Waits until a turn may be taken, and gives its progress; `None` once all is cancelled.
    fn pass(&self) -> Option<Progress> {
        let mut state = self.lock();
        while !state.open && !state.cancelled {
            state = self
                .changed
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
        state.turn = Progress::new();
        (!state.cancelled).then(|| state.turn.clone())
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<T: Clone + Send + Sync + 'static> Turns<T> {
    /// Begins work on a thread, in the place of the work before; `found` is what is known at first.
    pub fn begin(
        &mut self,
        found: T,
        ctx: &egui::Context,
        work: impl FnOnce(&Doing<T>) -> Result<(), Stop> + Send + 'static,
    ) {
        let known = Known {
            found: Arc::new(found),
            end: None,
        };
        let run = Run {
            gate: Arc::default(),
            known: Arc::new(Mutex::new(known)),
        };
        let doing = Doing {
            gate: Arc::clone(&run.gate),
            known: Arc::clone(&run.known),
            ctx: ctx.clone(),
        };
        std::thread::spawn(move || {
            let end = match work(&doing) {
                Ok(()) => End::Complete,
                Err(_) if doing.gate.lock().cancelled => End::Cancelled,
                Err(Stop(why)) => End::Failed(why),
            };
            lock(&doing.known).end = Some(end);
            doing.ctx.request_repaint();
        });
        self.run = Some(run);
    }

    /// What is known of the last work; `None` before the first.
    pub fn found(&self) -> Option<Arc<T>> {
        let run = self.run.as_ref()?;
        Some(Arc::clone(&lock(&run.known).found))
    }

    /// How the last work ended; `None` while it goes on, and before the first.
    pub fn end(&self) -> Option<End> {
        lock(&self.run.as_ref()?.known).end.clone()
    }

    pub fn is_running(&self) -> bool {
        self.run.is_some() && self.end().is_none()
    }

    /// How much of the turn that is being taken is done, 0 to 1, and whether it waits for the worker;
    /// `None` while nothing is worked on.
    pub fn turn(&self) -> Option<(f64, bool)> {
        let run = self.run.as_ref().filter(|_| self.is_running())?;
        let gate = run.gate.lock();
        Some((gate.turn.fraction(), !gate.open))
    }

    /// Ends the work; what is known of it stays.
    pub fn cancel(&self) {
        if let Some(run) = &self.run {
            run.gate.cancel();
        }
    }

    /// Lets the work go on where nothing else is done, that is where all `rests`, and interrupts it
    /// where not; gives whether all rests with it, too.
    pub fn make_way(&self, rests: bool) -> bool {
        if let Some(run) = &self.run {
            run.gate.set(rests);
        }
        rests && !self.is_running()
    }
}

/// Why work ended before it was done.
pub struct Stop(String);

impl<E: std::fmt::Display> From<E> for Stop {
    fn from(error: E) -> Self {
        Stop(error.to_string())
    }
}

/// What the thread of some work holds.
pub struct Doing<T> {
    gate: Arc<Gate>,
    known: Arc<Mutex<Known<T>>>,
    ctx: egui::Context,
}

impl<T: Clone> Doing<T> {
    /// Takes a turn as soon as it may be taken; once more if it was interrupted.
    ///
    /// # Errors
    /// The work was cancelled, or the turn failed.
    pub fn turn<R, E: std::fmt::Display>(
        &self,
        mut take: impl FnMut(&Progress) -> Result<R, E>,
    ) -> Result<R, Stop> {
        loop {
            let Some(progress) = self.gate.pass() else {
                return Err(Stop("cancelled".to_owned()));
            };
            match take(&progress) {
                // The worker came in between.
                Err(_) if progress.is_cancelled() => continue,
                result => return Ok(result?),
            }
        }
    }

    /// Adds to what is known.
    pub fn tell(&self, news: impl FnOnce(&mut T)) {
        news(Arc::make_mut(&mut lock(&self.known).found));
        self.ctx.request_repaint();
    }
}
