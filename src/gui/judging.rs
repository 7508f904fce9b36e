//! The judge in the background: once a picture is finished, sampled rays of it are asked of the tree
//! and of every object, on one thread, until the worker has something to do.

use super::state::{Current, State};
use crate::measure::{Verification, verify_sample};
use crate::progress::Progress;
use crate::trace::thread_pool;
use std::sync::{Arc, Mutex, PoisonError};

/// Rays of every kind that are looked at, in a scene of few objects.
const RAYS: usize = 2000;

/// Intersection tests that a whole run may take, about; scenes of many objects get fewer rays.
const TESTS: usize = 400_000_000;

/// What the judge has found of one picture.
#[derive(Default)]
pub struct Judging {
    /// Number of the picture.
    number: Option<u64>,
    running: Option<Running>,
    /// Whether the user does not want it.
    pub stopped: bool,
    found: Arc<Mutex<Found>>,
}

/// What is known so far.
#[derive(Clone, Default)]
pub struct Found {
    pub result: Verification,
    /// Whether all sampled rays were looked at.
    pub complete: bool,
}

/// The thread's ticket: dropping it ends the thread's work.
struct Running(Progress);

impl Drop for Running {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

impl Judging {
    /// What was found of the current picture.
    pub fn found(&self) -> Found {
        self.found
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .clone()
    }

    /// How much of the sample has been looked at, 0 to 1; `None` while nothing is.
    pub fn progress(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.0.fraction())
    }

    fn forget(&mut self) {
        self.running = None;
        self.found = Arc::default();
    }
}

impl State {
    /// Lets the judge begin where it may, and stops it where it may not.
    /// `timing` says that times are being taken, which must not suffer.
    pub fn judge_rays(&mut self, timing: bool, ctx: &egui::Context) {
        let number = self.current.as_ref().map(|current| current.number);
        // The worker's times must not suffer, nor those of pixels or of a long measurement.
        let rests = self.work.is_none() && !timing && self.measuring().is_none();
        let judging = &mut self.judging;
        if judging.number != number {
            judging.number = number;
            judging.forget();
        }
        let complete = judging.found().complete;
        if complete {
            judging.running = None;
        }
        match self
            .current
            .as_ref()
            .filter(|current| current.done && rests)
        {
            Some(current) if !judging.stopped && !complete => {
                if judging.running.is_none() {
                    judging.forget();
                    judging.running = Some(start(current, &judging.found, ctx));
                }
            }
            _ => judging.running = None,
        }
    }
}

fn start(current: &Current, found: &Arc<Mutex<Found>>, ctx: &egui::Context) -> Running {
    let progress = Progress::new();
    let shown = &current.shown;
    let (scene, tree, render) = (
        Arc::clone(&shown.scene),
        Arc::clone(&shown.tree),
        shown.setup.render,
    );
    let (inside, ctx, found) = (progress.clone(), ctx.clone(), Arc::clone(found));
    let affordable = TESTS / 4 / scene.objects().len().max(1);
    let tell = move |result: &Verification, complete| {
        *found.lock().unwrap_or_else(PoisonError::into_inner) = Found {
            result: result.clone(),
            complete,
        };
        ctx.request_repaint_after_secs(0.2);
    };
    std::thread::spawn(move || {
        let result = thread_pool(1).and_then(|pool| {
            let per_kind = affordable.clamp(50, RAYS);
            let so_far = |result: &Verification| tell(result, false);
            verify_sample(&scene, &tree, &render, per_kind, &pool, &inside, so_far)
        });
        // Without a result it was told to stop.
        if let Ok(result) = result {
            tell(&result, true);
        }
    });
    Running(progress)
}
