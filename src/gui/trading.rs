//! The trade of time for accuracy in the background, turn by turn.

use super::state::State;
use super::turns::{Doing, Stop, Turns};
use crate::measure::accuracy::{self, Trade, choices, reference};
use crate::progress::Progress;
use crate::scene::{Cylinders, Scene, SceneRequest, load};
use crate::setup::Setup;
use crate::trace::RenderSettings;
use std::sync::Arc;

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
    pub turns: Turns<Found>,
}

impl Default for Trading {
    fn default() -> Self {
        Trading {
            samples: 8,
            rounds: 3,
            chosen: None,
            begun: 0,
            turns: Turns::default(),
        }
    }
}

/// What is known of a trade; it grows with every turn.
#[derive(Clone)]
pub struct Found {
    /// No other trade of the window has it.
    pub number: u64,
    /// What was on view when the trade began.
    pub of: Setup,
    /// The outcomes so far, in the order of the choices.
    pub trade: Trade,
    /// By outcome, the error of every pixel of the reference, row by row; none where they would take
    /// too much memory.
    pub pixel_errors: Vec<Arc<Vec<f32>>>,
    /// Turns taken.
    pub taken: usize,
    /// Turns in all; 0 until the scene is there.
    pub turns: usize,
}

impl Found {
    /// Width and height of the reference; `None` until it was traced.
    pub fn size(&self) -> Option<[u32; 2]> {
        let first = self.trade.outcomes.first()?;
        let render = &first.choice.setup.render;
        Some([render.width, render.height])
    }
}

impl Trading {
    /// What is known of the last trade; `None` before the first.
    pub fn found(&self) -> Option<Arc<Found>> {
        self.turns.found()
    }

    /// How much of the trade is done, 0 to 1, and whether it waits for the worker; `None` while none
    /// is being taken.
    pub fn progress(&self) -> Option<(f64, bool)> {
        let (turn, waits) = self.turns.turn()?;
        let found = self.found()?;
        let share = (found.taken as f64 + turn) / found.turns.max(1) as f64;
        Some((share, waits))
    }
}

impl State {
    /// Whether a trade can be taken: of a finished picture with the settings that are wanted.
    pub fn may_trade(&self) -> bool {
        !self.trading.turns.is_running()
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
        let of = Setup {
            render: RenderSettings {
                samples: trading.samples.max(1),
                ..shown.setup.render
            },
            ..shown.setup.clone()
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
        };
        let (scene, rounds) = (Arc::clone(&shown.scene), trading.rounds);
        trading
            .turns
            .begin(found, ctx, move |doing| take(doing, &scene, &of, rounds));
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
        let threads = self.wanted.render.threads;
        self.wanted = outcome.choice.setup.clone();
        self.wanted.render.threads = threads;
    }
}

/// Takes the trade of a scene on view; it begins with its cylinders exact.
fn take(doing: &Doing<Found>, scene: &Arc<Scene>, of: &Setup, rounds: u32) -> Result<(), Stop> {
    let scene = if of.scene.cylinders == Cylinders::Exact {
        Arc::clone(scene)
    } else {
        let exact = SceneRequest {
            cylinders: Cylinders::Exact,
            ..of.scene.clone()
        };
        Arc::new(load(&exact, &Progress::new())?)
    };
    let render = &of.render;
    let choices = choices(&reference(of), &scene);
    let pixels = render.width as usize * render.height as usize;
    let keeps = choices.len() * pixels * size_of::<f32>() <= MOST_BYTES;
    let mut trading = accuracy::Trading::new(&scene, choices, rounds)?;
    let turns = trading.turns();
    doing.tell(|found| found.turns = turns);
    while let Some(turn) = doing.turn(|progress| trading.turn(progress))? {
        doing.tell(|found| {
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
    Ok(())
}
