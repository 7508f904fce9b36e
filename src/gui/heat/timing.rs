//! The time of every pixel, taken in the background on demand, while the worker rests.

use super::look::Values;
use crate::gui::state::{Current, State};
use crate::measure::heat::{Heatmap, PixelCounts, RayFilter};
use crate::progress::Progress;
use crate::trace::{RenderError, pixel_times, thread_pool};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// The pass over one picture.
#[derive(Default)]
pub struct Timing {
    /// Number of the picture that the pass is for.
    number: Option<u64>,
    pass: Pass,
}

#[derive(Default)]
enum Pass {
    /// Begins as soon as it can.
    #[default]
    Due,
    Running(Running),
    Taken(Arc<Values>),
    /// Not taken, and why.
    Ended(String),
}

struct Running {
    progress: Progress,
    receiver: Receiver<Result<Values, RenderError>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.progress.cancel();
    }
}

/// How the pass stands.
pub enum Standing {
    Waiting,
    /// How much is done, 0 to 1.
    Running(f64),
    Ended(String),
}

impl Timing {
    /// The times of a picture's pixels; begins to take them if the worker rests.
    pub fn get(
        &mut self,
        heatmap: &'static Heatmap,
        current: &Current,
        state: &State,
        ctx: &egui::Context,
    ) -> Option<Arc<Values>> {
        self.make_way(Some(current), state);
        if let Pass::Running(running) = &self.pass {
            self.pass = match running.receiver.try_recv() {
                Ok(Ok(values)) => Pass::Taken(Arc::new(values)),
                Ok(Err(error)) => Pass::Ended(error.to_string()),
                Err(TryRecvError::Disconnected) => Pass::Ended("the pass broke off".to_owned()),
                Err(TryRecvError::Empty) => {
                    ctx.request_repaint_after_secs(0.1);
                    return None;
                }
            };
        }
        match &self.pass {
            Pass::Taken(values) => Some(Arc::clone(values)),
            Pass::Due if may_run(current, state) => {
                self.number = Some(current.number);
                self.pass = Pass::Running(start(heatmap, current, ctx));
                ctx.request_repaint_after_secs(0.1);
                None
            }
            _ => None,
        }
    }

    /// Gives up a pass that the worker's own times would suffer from, and one over a picture that
    /// is gone.
    pub fn make_way(&mut self, current: Option<&Current>, state: &State) {
        let number = current.map(|current| current.number);
        if self.number != number {
            self.number = number;
            self.pass = Pass::Due;
        }
        if !current.is_some_and(|current| may_run(current, state)) {
            self.give_up();
        }
    }

    /// Gives up a pass that runs; it begins anew when asked for again.
    pub fn give_up(&mut self) {
        if self.is_running() {
            self.pass = Pass::Due;
        }
    }

    /// Stops the pass until [`Timing::again`].
    pub fn cancel(&mut self) {
        self.pass = Pass::Ended("cancelled".to_owned());
    }

    pub fn again(&mut self) {
        self.pass = Pass::Due;
    }

    pub fn is_taken(&self) -> bool {
        matches!(self.pass, Pass::Taken(_))
    }

    pub fn is_running(&self) -> bool {
        matches!(self.pass, Pass::Running(_))
    }

    pub fn standing(&self) -> Standing {
        match &self.pass {
            Pass::Due | Pass::Taken(_) => Standing::Waiting,
            Pass::Running(running) => Standing::Running(running.progress.fraction()),
            Pass::Ended(why) => Standing::Ended(why.clone()),
        }
    }
}

/// Whether there is a finished picture, the worker has nothing to do and no trade takes times.
fn may_run(current: &Current, state: &State) -> bool {
    state.work.is_none() && current.done && !state.trading.is_running()
}

fn start(heatmap: &'static Heatmap, current: &Current, ctx: &egui::Context) -> Running {
    let progress = Progress::new();
    let (sender, receiver) = channel();
    let shown = &current.shown;
    let (scene, tree) = (Arc::clone(&shown.scene), Arc::clone(&shown.tree));
    let (render, ctx, inside) = (shown.render, ctx.clone(), progress.clone());
    std::thread::spawn(move || {
        let times = thread_pool(render.threads)
            .and_then(|pool| pixel_times(&scene, &tree, &render, &pool, &inside));
        let values = times.map(|seconds| {
            let mut counts = PixelCounts::new(render.width, render.height);
            counts.seconds = Some(seconds);
            Values::of(heatmap, &counts, RayFilter::All)
        });
        // If nobody waits any more, the times are not needed.
        let _ = sender.send(values);
        ctx.request_repaint();
    });
    Running { progress, receiver }
}
