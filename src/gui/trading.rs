//! The accuracy study of the window: what each choice costs in time, and what it gives in accuracy.

use super::state::State;
use super::study::Study;
use crate::jobs::{Measured, StudyAccuracy};
use crate::measure::accuracy::AccuracyStudy;
use crate::setup::Setup;
use crate::trace::RenderSettings;
use std::sync::Arc;

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
    pub study: Study<StudyAccuracy, Found>,
}

impl Default for Trading {
    fn default() -> Self {
        Trading {
            samples: 8,
            rounds: 3,
            chosen: None,
            begun: 0,
            study: Study::default(),
        }
    }
}

/// What is known of a trade; it grows with every step.
#[derive(Clone)]
pub struct Found {
    /// No other trade of the window has it.
    pub number: u64,
    /// What was on view when the trade began.
    pub of: Setup,
    /// The outcomes so far, in the order of the choices.
    pub trade: AccuracyStudy,
    /// By outcome, the error of every pixel of the reference, row by row; none where they would take
    /// too much memory.
    pub pixel_errors: Vec<Arc<Vec<f32>>>,
    /// Steps taken.
    pub taken: usize,
    /// Steps in all; 0 before the first.
    pub steps: usize,
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
    pub(super) fn receive(&mut self) {
        self.study.receive(|found, measured| {
            let Measured {
                place,
                outcome,
                pixel_errors,
                steps,
            } = measured;
            match found.trade.outcomes.get_mut(place) {
                Some(known) => *known = outcome,
                None => found.trade.outcomes.push(outcome),
            }
            found.pixel_errors.extend(pixel_errors.map(Arc::new));
            found.taken += 1;
            found.steps = steps;
        });
    }
}

impl State {
    /// Whether a trade can be taken: of a finished picture with the settings that are wanted.
    pub fn may_trade(&self) -> bool {
        !self.trading.study.is_running()
            && self.work.is_none()
            && !self.is_previous()
            && self.current.as_ref().is_some_and(|current| current.done)
    }

    /// Begins the trade of the scene and settings on view, in the place of the one before.
    pub fn begin_trade(&mut self) {
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
            trade: AccuracyStudy {
                outcomes: Vec::new(),
            },
            pixel_errors: Vec::new(),
            taken: 0,
            steps: 0,
        };
        let handle = self.jobs.start(StudyAccuracy {
            scene: Arc::clone(&shown.scene),
            setup: of,
            rounds: trading.rounds,
            only: Vec::new(),
        });
        trading.study.follow(handle, found);
    }

    /// Wants the settings of an outcome, of the scene and camera that it was traced with.
    pub fn choose_outcome(&mut self, place: usize) {
        let Some(found) = self.trading.study.found().cloned() else {
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
