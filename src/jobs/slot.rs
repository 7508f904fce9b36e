//! Where a job stands among the others.

use std::sync::atomic::{AtomicU64, Ordering};

/// What a job is about. A newer job in the same slot replaces the older one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Slot {
    name: &'static str,
    number: u64,
}

impl Slot {
    /// The only slot of this name.
    pub const fn named(name: &'static str) -> Slot {
        Slot { name, number: 0 }
    }

    /// One of several slots of this name.
    pub const fn numbered(name: &'static str, number: u64) -> Slot {
        Slot { name, number }
    }

    /// A new slot of this name. No other job takes it, so that nothing replaces its job.
    pub fn unique(name: &'static str) -> Slot {
        static NEXT: AtomicU64 = AtomicU64::new(1 << 32);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        Slot { name, number }
    }

    /// What the job is called in lists.
    pub const fn name(self) -> &'static str {
        self.name
    }
}

/// Which jobs run first, in ascending order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Priority {
    /// Work that the program does unasked while nothing else runs.
    Idle,
    /// Details of a picture that a pane shows; they wait for the end of studies.
    Detail,
    /// A long measurement that the user has started.
    Study,
    /// What a pane needs to show the current picture.
    Pane,
    /// What the user waits for.
    Now,
    /// A value that takes a moment and that the window needs at once. Runs beside everything, even
    /// beside a timed unit.
    Light,
    /// A question to a person. As [`Priority::Light`], but the scheduler does not wait for its end
    /// when it is dropped.
    Dialog,
}

impl Priority {
    /// Whether the job takes turns with others. One that does not runs beside everything.
    pub const fn takes_turns(self) -> bool {
        !matches!(self, Priority::Light | Priority::Dialog)
    }
}
