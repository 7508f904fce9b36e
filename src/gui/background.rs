//! Work that would hold the window up, done on a thread: at most one at a time, the latest wanted
//! next.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::time::Duration;

/// A value that follows a key, worked out in the background.
pub struct Latest<K, T> {
    ready: Option<(K, Arc<T>)>,
    running: Option<(K, Receiver<T>)>,
}

impl<K, T> Default for Latest<K, T> {
    fn default() -> Self {
        Latest {
            ready: None,
            running: None,
        }
    }
}

impl<K: Clone + PartialEq, T: Send + 'static> Latest<K, T> {
    /// The value for this key, if it is there. If not, and nothing else is being worked out,
    /// `make` starts on a thread; the window is drawn again when it is done.
    pub fn get(
        &mut self,
        key: &K,
        ctx: &egui::Context,
        make: impl FnOnce() -> T + Send + 'static,
    ) -> Option<Arc<T>> {
        if let Some((key, receiver)) = &self.running {
            match receiver.try_recv() {
                Ok(value) => {
                    self.ready = Some((key.clone(), Arc::new(value)));
                    self.running = None;
                }
                Err(TryRecvError::Disconnected) => self.running = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        if let Some((ready, value)) = &self.ready
            && ready == key
        {
            return Some(Arc::clone(value));
        }
        if self.running.is_none() {
            let (sender, receiver) = channel();
            let ctx = ctx.clone();
            std::thread::spawn(move || {
                // If nobody waits any more, the value is not needed.
                let _ = sender.send(make());
                ctx.request_repaint();
            });
            self.running = Some((key.clone(), receiver));
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
        let there = self.get(key, ctx, make);
        if let (None, false, Some((running, receiver))) = (&there, was_running, &self.running)
            && running == key
            && let Ok(value) = receiver.recv_timeout(patience)
        {
            self.running = None;
            return Some(self.put(key.clone(), value));
        }
        there
    }

    /// Puts a value there at once, where working it out takes no time worth a thread.
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

/// One piece of work on a thread of its own, whose result is taken once.
pub struct Task<T>(Receiver<T>);

impl<T: Send + 'static> Task<T> {
    /// Starts the work; the window is drawn again when it is done.
    pub fn start(ctx: &egui::Context, work: impl FnOnce() -> T + Send + 'static) -> Self {
        let (sender, receiver) = channel();
        let ctx = ctx.clone();
        std::thread::spawn(move || {
            // If nobody waits any more, the result is not needed.
            let _ = sender.send(work());
            ctx.request_repaint();
        });
        Task(receiver)
    }

    /// Work that is done elsewhere: its result is sent.
    pub fn promise() -> (Sender<T>, Self) {
        let (sender, receiver) = channel();
        (sender, Task(receiver))
    }

    /// The result, once it is there. The inner `None` says that the work ended without one.
    pub fn take(&self) -> Option<Option<T>> {
        match self.0.try_recv() {
            Ok(result) => Some(Some(result)),
            Err(TryRecvError::Disconnected) => Some(None),
            Err(TryRecvError::Empty) => None,
        }
    }
}
