//! Small jobs of widgets: values that follow a key, dialogs, files that are read. They run beside
//! everything else.

use crate::jobs::{End, Handle, Priority, Run, Scheduler, Slot, Starter};
use std::sync::Arc;
use std::time::Duration;

/// A scheduler that draws the window again whenever there is news. Widgets find it through the
/// context.
pub fn scheduler(ctx: &egui::Context) -> Scheduler {
    let window = ctx.clone();
    let scheduler = Scheduler::new(move || window.request_repaint());
    ctx.data_mut(|data| data.insert_temp(egui::Id::NULL, scheduler.starter()));
    scheduler
}

fn starter(ctx: &egui::Context) -> Starter {
    ctx.data(|data| data.get_temp(egui::Id::NULL))
        .expect("the window has a scheduler")
}

/// A piece of work whose result is taken once.
pub type Task<T> = Handle<Run<T>>;

/// Starts a short piece of work.
pub fn task<T: Send + 'static>(
    ctx: &egui::Context,
    work: impl FnOnce() -> T + Send + 'static,
) -> Task<T> {
    start(ctx, Priority::Light, work)
}

/// Starts a dialog, which waits for a person.
pub fn dialog<T: Send + 'static>(
    ctx: &egui::Context,
    work: impl FnOnce() -> T + Send + 'static,
) -> Task<T> {
    start(ctx, Priority::Dialog, work)
}

fn start<T: Send + 'static>(
    ctx: &egui::Context,
    priority: Priority,
    work: impl FnOnce() -> T + Send + 'static,
) -> Task<T> {
    starter(ctx).start(Run::new(Slot::unique("task"), priority, |_| Ok(work())))
}

/// The result of a task, once it has ended. The inner `None` says that it ended without one.
pub fn take<T: Send + 'static>(task: &Task<T>) -> Option<Option<T>> {
    task.receive().end.map(|end| match end {
        End::Done(value) => Some(value),
        End::Cancelled | End::Replaced | End::Failed(_) => None,
    })
}

/// A value that follows a key, made by a task. At most one is made at a time, that of the latest key
/// next: a value that takes longer than its key lasts is shown at last.
pub struct Latest<K, T: Send + 'static> {
    ready: Option<(K, Arc<T>)>,
    running: Option<(K, Task<T>)>,
}

impl<K, T: Send + 'static> Default for Latest<K, T> {
    fn default() -> Self {
        Latest {
            ready: None,
            running: None,
        }
    }
}

impl<K: Clone + PartialEq, T: Send + 'static> Latest<K, T> {
    /// The value for this key, if it is there. If not, and no other value is being made, `make`
    /// starts; the window is drawn again when it is done.
    pub fn get(
        &mut self,
        key: &K,
        ctx: &egui::Context,
        make: impl FnOnce() -> T + Send + 'static,
    ) -> Option<Arc<T>> {
        self.receive();
        if let Some(ready) = self.ready(key) {
            return Some(ready);
        }
        if self.running.is_none() {
            self.running = Some((key.clone(), task(ctx, make)));
        }
        None
    }

    /// As [`Latest::get`], but waits a moment for what may be made quickly, once.
    pub fn get_soon(
        &mut self,
        key: &K,
        ctx: &egui::Context,
        patience: Duration,
        make: impl FnOnce() -> T + Send + 'static,
    ) -> Option<Arc<T>> {
        let was_running = self
            .running
            .as_ref()
            .is_some_and(|(running, _)| running == key);
        let value = self.get(key, ctx, make);
        if let (None, false, Some((running, task))) = (&value, was_running, &self.running)
            && running == key
            && task.wait(patience)
        {
            self.receive();
            return self.ready(key);
        }
        value
    }

    fn receive(&mut self) {
        if let Some((key, task)) = &self.running
            && let Some(value) = take(task)
        {
            if let Some(value) = value {
                self.ready = Some((key.clone(), Arc::new(value)));
            }
            self.running = None;
        }
    }

    /// Sets a value at once, where making it takes no time worth a task.
    pub fn put(&mut self, key: K, value: T) -> Arc<T> {
        let value = Arc::new(value);
        self.ready = Some((key, Arc::clone(&value)));
        value
    }

    /// The value for this key, if it is there already.
    pub fn ready(&self, key: &K) -> Option<Arc<T>> {
        let (ready, value) = self.ready.as_ref()?;
        (ready == key).then(|| Arc::clone(value))
    }
}
