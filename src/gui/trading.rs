//! The trade of time for accuracy in the background: turn by turn, and only while the worker rests, so
//! that neither's times suffer. A turn that the worker interrupts is taken again.

use super::state::State;
use crate::measure::trade::{self, Trade, choices, reference};
use crate::progress::Progress;
use crate::scene::{Cylinders, Scene, SceneRequest, load};
use crate::trace::RenderSettings;
use crate::worker::Request;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// The most bytes that the errors of all pixels of all choices may take; in a trade of larger pictures
/// they are not kept.
const MOST_BYTES: usize = 512 << 20;

/// The trade, the last one taken and how the next will be.
pub struct Trading {
    /// Samples a pixel of the next reference, at least 1.
    pub samples: u32,
    /// Rounds of the next trade, at least 1.
    pub rounds: u32,
    /// Which outcome was chosen.
    pub chosen: Option<usize>,
    /// How many trades were begun.
    begun: u64,
    run: Option<Run>,
}

impl Default for Trading {
    fn default() -> Self {
        Trading {
            samples: 8,
            rounds: 3,
            chosen: None,
            begun: 0,
            run: None,
        }
    }
}

/// What is known of a trade; it grows with every turn.
#[derive(Clone)]
pub struct Found {
    /// No other trade of the window has it.
    pub number: u64,
    /// What was on view when the trade began, with the camera that was used.
    pub of: Request,
    /// The outcomes so far, in the order of the choices.
    pub trade: Trade,
    /// By outcome, the error of every pixel of the reference, row by row; none where they would take
    /// too much memory.
    pub pixel_errors: Vec<Arc<Vec<f32>>>,
    /// Turns taken.
    pub taken: usize,
    /// Turns in all; 0 until the scene is there.
    pub turns: usize,
    /// How it ended; `None` while it goes on.
    pub end: Option<End>,
}

/// How a trade ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    Complete,
    Cancelled,
    Failed(String),
}

impl Found {
    /// Width and height of the reference; `None` until it was traced.
    pub fn size(&self) -> Option<[u32; 2]> {
        let first = self.trade.outcomes.first()?;
        let render = &first.choice.setting.render;
        Some([render.width, render.height])
    }
}

/// A trade on its thread; dropping it ends the thread's work.
struct Run {
    gate: Arc<Gate>,
    found: Arc<Mutex<Arc<Found>>>,
}

impl Drop for Run {
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

impl Trading {
    /// What is known of the last trade; `None` before the first.
    pub fn found(&self) -> Option<Arc<Found>> {
        let run = self.run.as_ref()?;
        Some(Arc::clone(&lock(&run.found)))
    }

    pub fn is_running(&self) -> bool {
        self.found().is_some_and(|found| found.end.is_none())
    }

    /// How much of the trade is done, 0 to 1, and whether it waits for the worker; `None` while none
    /// is being taken.
    pub fn progress(&self) -> Option<(f64, bool)> {
        let run = self.run.as_ref()?;
        let found = self.found().filter(|found| found.end.is_none())?;
        let gate = run.gate.lock();
        let taken = found.taken as f64 + gate.turn.fraction();
        Some((taken / found.turns.max(1) as f64, !gate.open))
    }

    /// Ends the trade; what is known of it stays.
    pub fn cancel(&self) {
        if let Some(run) = &self.run {
            run.gate.cancel();
        }
    }

    /// Lets the trade go on where the worker `rests`, and interrupts it where not.
    pub fn make_way(&self, rests: bool) {
        if let Some(run) = &self.run {
            run.gate.set(rests);
        }
    }
}

impl State {
    /// Whether a trade can be taken: of a finished picture with the settings that are wanted.
    pub fn may_trade(&self) -> bool {
        !self.trading.is_running()
            && self.work.is_none()
            && !self.is_previous()
            && self.current.as_ref().is_some_and(|current| current.done)
    }

    /// Begins the trade of the scene and settings on view, in the place of the one before.
    pub fn begin_trade(&mut self, ctx: &egui::Context) {
        let Some(current) = self.current.as_ref().filter(|_| self.may_trade()) else {
            return;
        };
        let shown = &current.shown;
        let trading = &mut self.trading;
        trading.begun += 1;
        trading.chosen = None;
        let of = Request {
            render: RenderSettings {
                samples: trading.samples.max(1),
                ..shown.render
            },
            ..shown.request.clone()
        };
        let found = Found {
            number: trading.begun,
            of: of.clone(),
            trade: Trade {
                outcomes: Vec::new(),
            },
            pixel_errors: Vec::new(),
            taken: 0,
            turns: 0,
            end: None,
        };
        let run = Run {
            gate: Arc::default(),
            found: Arc::new(Mutex::new(Arc::new(found))),
        };
        let task = Task {
            gate: Arc::clone(&run.gate),
            found: Arc::clone(&run.found),
            scene: Arc::clone(&shown.scene),
            of,
            rounds: trading.rounds,
            ctx: ctx.clone(),
        };
        std::thread::spawn(move || task.run());
        trading.run = Some(run);
    }

    /// Wants the settings of an outcome, of the scene and camera that it was traced with.
    pub fn choose_outcome(&mut self, place: usize) {
        let Some(found) = self.trading.found() else {
            return;
        };
        let Some(outcome) = found.trade.outcomes.get(place) else {
            return;
        };
        self.trading.chosen = Some(place);
        let setting = &outcome.choice.setting;
        let wanted = &mut self.wanted;
        wanted.scene = SceneRequest {
            source: found.of.scene.source.clone(),
            cylinders: setting.cylinders,
        };
        wanted.own_camera = found.of.own_camera;
        wanted.build = setting.build.clone();
        wanted.render = RenderSettings {
            threads: wanted.render.threads,
            ..setting.render
        };
    }
}

/// What the thread of a trade needs.
struct Task {
    gate: Arc<Gate>,
    found: Arc<Mutex<Arc<Found>>>,
    /// The scene on view; the trade begins with its cylinders exact.
    scene: Arc<Scene>,
    of: Request,
    rounds: u32,
    ctx: egui::Context,
}

impl Task {
    fn run(self) {
        let end = match self.take() {
            Ok(()) => End::Complete,
            Err(_) if self.gate.lock().cancelled => End::Cancelled,
            Err(why) => End::Failed(why),
        };
        self.tell(|found| found.end = Some(end));
    }

    fn take(&self) -> Result<(), String> {
        let words = |error: &dyn std::fmt::Display| error.to_string();
        let scene = if self.of.scene.cylinders == Cylinders::Exact {
            Arc::clone(&self.scene)
        } else {
            let exact = SceneRequest {
                cylinders: Cylinders::Exact,
                ..self.of.scene.clone()
            };
            Arc::new(load(&exact, &Progress::new()).map_err(|e| words(&e))?)
        };
        let render = &self.of.render;
        let choices = choices(&reference(&self.of.build, render), &scene);
        let pixels = render.width as usize * render.height as usize;
        let keeps = choices.len() * pixels * size_of::<f32>() <= MOST_BYTES;
        let mut trading =
            trade::Trading::new(&scene, choices, self.rounds).map_err(|e| words(&e))?;
        let turns = trading.turns();
        self.tell(|found| found.turns = turns);
        loop {
            let Some(progress) = self.gate.pass() else {
                return Err("cancelled".to_owned());
            };
            let turn = match trading.turn(&progress) {
                Ok(Some(turn)) => turn,
                Ok(None) => return Ok(()),
                // The worker came in between: once more, when it rests.
                Err(error) if error.is_cancelled() => continue,
                Err(error) => return Err(words(&error)),
            };
            self.tell(|found| {
                let outcome = trading.outcomes()[turn.place].clone();
                match found.trade.outcomes.get_mut(turn.place) {
                    Some(known) => *known = outcome,
                    None => found.trade.outcomes.push(outcome),
                }
                found
                    .pixel_errors
                    .extend(turn.pixel_errors.filter(|_| keeps).map(Arc::new));
                found.taken += 1;
            });
        }
    }

    fn tell(&self, news: impl FnOnce(&mut Found)) {
        news(Arc::make_mut(&mut lock(&self.found)));
        self.ctx.request_repaint();
    }
}
