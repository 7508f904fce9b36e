//! The list of all jobs, and who runs next. All that is known of a job is in its one entry, which is
//! removed when the job's thread ends.

use super::inbox::End;
use super::slot::{Priority, Slot};
use crate::progress::Progress;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// A live job, for lists.
#[derive(Clone, Debug, PartialEq)]
pub struct JobStatus {
    pub slot: Slot,
    pub priority: Priority,
    /// What it does now; empty before its first stage.
    pub stage: String,
    /// How much of the stage is done, 0 to 1.
    pub fraction: f64,
    pub standing: Standing,
    /// Whether it was paused; it stands still after the unit that runs.
    pub is_paused: bool,
}

/// Whether a job runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    Running,
    /// Another job goes first.
    Waiting,
    /// Until it is resumed.
    Paused,
}

/// Why a job ends before it is done.
#[derive(Clone, Copy)]
pub(super) enum Early {
    Cancelled,
    Replaced,
}

impl Early {
    pub fn end<O>(self) -> End<O> {
        match self {
            Early::Cancelled => End::Cancelled,
            Early::Replaced => End::Replaced,
        }
    }
}

/// What a new job brings.
pub(super) struct Entry {
    pub slot: Slot,
    pub priority: Priority,
    /// Tells whoever waits for the job that it has ended.
    pub close: Box<dyn Fn(Early) + Send>,
}

/// A job until its thread ends.
struct Known {
    slot: Slot,
    priority: Priority,
    close: Box<dyn Fn(Early) + Send>,
    /// Whether it still counts. A job that was cancelled or replaced does not, but has an entry until
    /// its thread ends.
    is_live: bool,
    is_paused: bool,
    place: Place,
    stage: String,
    /// The stretch of the stage that the progress of a unit fills.
    span: [f64; 2],
    /// Of the unit that runs or ran last.
    progress: Progress,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Between,
    /// Waits for its next unit.
    Waiting {
        timed: bool,
    },
    InUnit {
        timed: bool,
    },
}

impl Known {
    /// Whether others have to wait for it.
    fn counts(&self) -> bool {
        self.is_live && !self.is_paused && self.priority.takes_turns()
    }

    fn is_in_unit(&self) -> bool {
        matches!(self.place, Place::InUnit { .. })
    }

    fn status(&self) -> JobStatus {
        let [from, to] = self.span;
        let waits = matches!(self.place, Place::Waiting { .. });
        JobStatus {
            slot: self.slot,
            priority: self.priority,
            stage: self.stage.clone(),
            fraction: from + self.progress.fraction() * (to - from),
            standing: match (waits, self.is_paused) {
                (true, true) => Standing::Paused,
                (true, false) => Standing::Waiting,
                (false, _) => Standing::Running,
            },
            is_paused: self.is_paused,
        }
    }

    fn end(&mut self, early: Early) {
        if self.is_live {
            self.is_live = false;
            self.progress.cancel();
            (self.close)(early);
        }
    }
}

type Wake = Arc<dyn Fn() + Send + Sync>;

pub(super) struct Board {
    state: Mutex<State>,
    /// Whenever a waiting unit may be able to begin.
    changed: Condvar,
    /// Whenever a job begins to wait, or ends.
    settled: Condvar,
    wake: Mutex<Option<Wake>>,
}

#[derive(Default)]
struct State {
    /// By number, in the order in which they were started.
    jobs: BTreeMap<u64, Known>,
    last_number: u64,
    is_closed: bool,
    threads: Vec<JoinHandle<()>>,
}

impl State {
    /// Whether a job may begin its next unit.
    fn may_begin(&self, number: u64, timed: bool) -> bool {
        let Some(job) = self.jobs.get(&number) else {
            return false;
        };
        if !job.priority.takes_turns() {
            return true;
        }
        let mut others = self
            .jobs
            .iter()
            .filter(|(other, known)| **other != number && known.priority.takes_turns());
        !job.is_paused
            && others.all(|(&other_number, other)| {
                let disturbs = match other.place {
                    Place::InUnit { timed: is_timed } => {
                        timed || is_timed || other.slot == job.slot
                    }
                    Place::Between | Place::Waiting { .. } => false,
                };
                let is_before = other_number < number
                    && (timed || other.place == Place::Waiting { timed: true });
                let goes_first =
                    other.priority > job.priority || (other.priority == job.priority && is_before);
                !(disturbs || other.counts() && goes_first)
            })
    }

    /// Interrupts the units of all jobs that have to wait for others.
    fn interrupt(&self) {
        let first = self.jobs.values().filter(|job| job.counts());
        let Some(highest) = first.map(|job| job.priority).max() else {
            return;
        };
        for job in self.jobs.values() {
            if job.is_in_unit() && job.priority < highest {
                job.progress.cancel();
            }
        }
    }

    /// Whether nothing happens any more until somebody starts, resumes or cancels a job.
    fn is_settled(&self) -> bool {
        self.jobs.iter().all(|(&number, job)| match job.place {
            Place::Waiting { timed } => job.is_live && !self.may_begin(number, timed),
            Place::Between | Place::InUnit { .. } => false,
        })
    }
}

impl Board {
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Board {
            state: Mutex::default(),
            changed: Condvar::new(),
            settled: Condvar::new(),
            wake: Mutex::new(Some(Arc::new(wake))),
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn notify(&self) {
        self.changed.notify_all();
        self.settled.notify_all();
    }

    /// Tells the window that there is news.
    pub fn wake(&self) {
        let wake = self.wake.lock().unwrap_or_else(PoisonError::into_inner);
        let wake = wake.clone();
        if let Some(wake) = wake {
            wake();
        }
    }

    /// Adds a job in place of the one in its slot, and starts its thread if it has one. Returns the
    /// job's number; `None` once the scheduler is gone.
    ///
    /// # Errors
    /// The system provides no thread.
    pub fn add(
        &self,
        entry: Entry,
        thread: impl FnOnce(u64) -> std::io::Result<Option<JoinHandle<()>>>,
    ) -> std::io::Result<Option<u64>> {
        let mut state = self.lock();
        if state.is_closed {
            return Ok(None);
        }
        for job in state.jobs.values_mut() {
            if job.slot == entry.slot {
                job.end(Early::Replaced);
            }
        }
        state.last_number += 1;
        let number = state.last_number;
        let known = Known {
            slot: entry.slot,
            priority: entry.priority,
            close: entry.close,
            is_live: true,
            is_paused: false,
            place: Place::Between,
            stage: String::new(),
            span: [0.0, 1.0],
            progress: Progress::new(),
        };
        state.jobs.insert(number, known);
        // The new thread waits for the lock.
        match thread(number) {
            Ok(thread) => {
                state.threads.retain(|thread| !thread.is_finished());
                if entry.priority != Priority::Dialog {
                    state.threads.extend(thread);
                }
                state.interrupt();
                self.notify();
                Ok(Some(number))
            }
            Err(error) => {
                state.jobs.remove(&number);
                self.notify();
                Err(error)
            }
        }
    }

    /// Removes a job whose thread ends; `deliver` sends its result.
    pub fn remove(&self, number: u64, deliver: impl FnOnce()) {
        {
            let mut state = self.lock();
            deliver();
            state.jobs.remove(&number);
            self.notify();
        }
        self.wake();
    }

    /// Waits until the job may begin a unit. Returns the unit's progress; `None` if the job was
    /// cancelled or replaced.
    pub fn begin_unit(&self, number: u64, timed: bool) -> Option<Progress> {
        let mut state = self.lock();
        state.jobs.get_mut(&number)?.place = Place::Waiting { timed };
        self.settled.notify_all();
        loop {
            let may_begin = state.may_begin(number, timed);
            let job = state.jobs.get_mut(&number)?;
            if !job.is_live {
                job.place = Place::Between;
                return None;
            }
            if may_begin {
                job.place = Place::InUnit { timed };
                job.progress = Progress::new();
                return Some(job.progress.clone());
            }
            state = self
                .changed
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    pub fn end_unit(&self, number: u64) {
        if let Some(job) = self.lock().jobs.get_mut(&number) {
            job.place = Place::Between;
        }
        self.notify();
    }

    /// Begins a stage: its fraction is 0.
    pub fn set_stage(&self, number: u64, stage: String) {
        if let Some(job) = self.lock().jobs.get_mut(&number) {
            job.stage = stage;
            job.span = [0.0, 1.0];
            job.progress.set(0.0);
        }
        self.wake();
    }

    /// Which stretch of the stage the next units fill.
    pub fn set_span(&self, number: u64, span: [f64; 2]) {
        if let Some(job) = self.lock().jobs.get_mut(&number) {
            job.span = span;
            job.progress.set(0.0);
        }
    }

    pub fn is_live(&self, number: u64) -> bool {
        self.lock().jobs.get(&number).is_some_and(|job| job.is_live)
    }

    pub fn status(&self, number: u64) -> Option<JobStatus> {
        let state = self.lock();
        let job = state.jobs.get(&number).filter(|job| job.is_live)?;
        Some(job.status())
    }

    /// All live jobs, in the order in which they were started.
    pub fn jobs(&self) -> Vec<JobStatus> {
        let state = self.lock();
        let live = state.jobs.values().filter(|job| job.is_live);
        live.map(Known::status).collect()
    }

    /// Jobs whose threads have not ended, cancelled ones included.
    pub fn threads(&self) -> usize {
        self.lock().jobs.len()
    }

    pub fn cancel(&self, number: u64) {
        if let Some(job) = self.lock().jobs.get_mut(&number) {
            job.end(Early::Cancelled);
        }
        self.notify();
    }

    /// Cancels all live jobs that fit.
    pub fn cancel_where(&self, fits: impl Fn(&JobStatus) -> bool) {
        for job in self.lock().jobs.values_mut() {
            if fits(&job.status()) {
                job.end(Early::Cancelled);
            }
        }
        self.notify();
    }

    /// Pauses or resumes the job in a slot.
    pub fn set_paused(&self, slot: Slot, paused: bool) {
        let mut state = self.lock();
        for job in state.jobs.values_mut().filter(|job| job.slot == slot) {
            job.is_paused = paused;
        }
        state.interrupt();
        self.notify();
    }

    /// Waits until nothing happens any more. Returns whether no job is left; if not, those that are
    /// left are paused, or wait for a paused one.
    pub fn wait(&self) -> bool {
        let mut state = self.lock();
        loop {
            if state.jobs.is_empty() {
                return true;
            }
            if state.is_settled() {
                return false;
            }
            state = self
                .settled
                .wait(state)
                .unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Cancels all jobs and waits for the end of their threads, except for dialogs.
    pub fn close(&self) {
        let threads = {
            let mut state = self.lock();
            state.is_closed = true;
            for job in state.jobs.values_mut() {
                job.end(Early::Cancelled);
            }
            self.notify();
            std::mem::take(&mut state.threads)
        };
        *self.wake.lock().unwrap_or_else(PoisonError::into_inner) = None;
        for thread in threads {
            // A panic in a job was reported as its end.
            let _ = thread.join();
        }
    }
}
