//! A pass over a picture's rays, made in the background on demand, while the worker rests.

use super::state::Current;
use crate::progress::Progress;
use crate::trace::RenderError;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// What comes of a pass over one picture; forgotten with the picture.
pub struct PicturePass<T> {
    /// Number of the picture that the pass is for.
    number: Option<u64>,
    pass: Pass<T>,
}

enum Pass<T> {
    /// Begins as soon as it can.
    Due,
    Running(Running<T>),
    Done(Arc<T>),
    /// Not made, and why.
    Ended(String),
}

struct Running<T> {
    progress: Progress,
    receiver: Receiver<Result<T, RenderError>>,
}

impl<T> Drop for Running<T> {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

/// How a pass stands.
#[derive(Clone, Debug, PartialEq)]
pub enum Standing {
    /// It begins when the picture is finished.
    Waiting,
    /// How much is done, 0 to 1.
    Running(f64),
    Done,
    Ended(String),
}

impl<T> Default for PicturePass<T> {
    fn default() -> Self {
        PicturePass {
            number: None,
            pass: Pass::Due,
        }
    }
}

impl<T: Send + 'static> PicturePass<T> {
    /// What came of the pass over this picture. Begins the pass if the picture is finished
    /// and the worker is `resting`.
    pub fn get(
        &mut self,
        current: &Current,
        resting: bool,
        ctx: &egui::Context,
        make: impl FnOnce(&Progress) -> Result<T, RenderError> + Send + 'static,
    ) -> Option<Arc<T>> {
        self.follow(current);
        if let Pass::Running(running) = &self.pass {
            self.pass = match running.receiver.try_recv() {
                Ok(Ok(value)) => Pass::Done(Arc::new(value)),
                Ok(Err(error)) => Pass::Ended(error.to_string()),
                Err(TryRecvError::Disconnected) => Pass::Ended("the pass broke off".to_owned()),
                Err(TryRecvError::Empty) => {
                    ctx.request_repaint_after_secs(0.1);
                    return None;
                }
            };
        }
        match &self.pass {
            Pass::Done(value) => Some(Arc::clone(value)),
            Pass::Due if resting && current.done => {
                let progress = Progress::new();
                let (sender, receiver) = channel();
                let (inside, awake) = (progress.clone(), ctx.clone());
                std::thread::spawn(move || {
                    // If nobody waits any more, the result is not needed.
                    let _ = sender.send(make(&inside));
                    awake.request_repaint();
                });
                self.pass = Pass::Running(Running { progress, receiver });
                ctx.request_repaint_after_secs(0.1);
                None
            }
            _ => None,
        }
    }

    /// Forgets a pass over another picture; says whether the picture is another.
    pub fn follow(&mut self, current: &Current) -> bool {
        let another = self.number != Some(current.number);
        if another {
            self.number = Some(current.number);
            self.pass = Pass::Due;
        }
        another
    }

    pub fn is_running(&self) -> bool {
        matches!(self.pass, Pass::Running(_))
    }

    /// What came of the pass, if it is done.
    pub fn ready(&self) -> Option<Arc<T>> {
        match &self.pass {
            Pass::Done(value) => Some(Arc::clone(value)),
            _ => None,
        }
    }

    /// Gives up a pass that runs, for the worker's times would suffer from it; it begins anew when
    /// asked for again.
    pub fn give_way(&mut self) {
        if self.is_running() {
            self.pass = Pass::Due;
        }
    }

    /// Stops a pass that runs until [`PicturePass::again`].
    pub fn cancel(&mut self) {
        if self.is_running() {
            self.pass = Pass::Ended("cancelled".to_owned());
        }
    }

    /// Makes a pass due that was not made.
    pub fn again(&mut self) {
        if matches!(self.pass, Pass::Ended(_)) {
            self.pass = Pass::Due;
        }
    }

    pub fn standing(&self) -> Standing {
        match &self.pass {
            Pass::Due => Standing::Waiting,
            Pass::Running(running) => Standing::Running(running.progress.fraction()),
            Pass::Done(_) => Standing::Done,
            Pass::Ended(why) => Standing::Ended(why.clone()),
        }
    }
}
