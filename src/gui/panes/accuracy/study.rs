//! The accuracy study of the window: the rendering time and the error of each choice.

use crate::gui::document::Document;
use crate::gui::document::study::Study;
use crate::jobs::{Measured, StudyAccuracy};
use crate::measure::accuracy::AccuracyStudy;
use crate::setup::Setup;
use crate::trace::RenderSettings;
use std::sync::Arc;

/// The last study, and the settings of the next.
pub struct Trading {
    /// Samples per pixel of the next reference, at least 1.
    pub samples: u32,
    /// Rounds of the next study, at least 1.
    pub rounds: u32,
    /// Which outcome was chosen.
    pub chosen: Option<usize>,
    /// How many studies were started.
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

/// What is known of a study; it grows with every step.
#[derive(Clone)]
pub struct Found {
    /// No other study of the window has it.
    pub number: u64,
    /// What was on view when the study began.
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
    pub fn receive(&mut self) {
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

impl Trading {
    /// Whether a study can be started: of a finished picture with the settings that are wanted.
    pub fn may_start(&self, doc: &Document) -> bool {
        !self.study.is_running()
            && doc.work.is_none()
            && !doc.is_previous()
            && doc.current.as_ref().is_some_and(|current| current.done)
    }

    /// Starts the study of the scene and settings on view, in place of the last one.
    pub fn start(&mut self, doc: &Document) {
        let Some(current) = doc.current.as_ref().filter(|_| self.may_start(doc)) else {
            return;
        };
        let shown = &current.shown;
        self.begun += 1;
        self.chosen = None;
        let of = Setup {
            render: RenderSettings {
                samples: self.samples.max(1),
                ..shown.setup.render
            },
            ..shown.setup.clone()
        };
        let found = Found {
            number: self.begun,
            of: of.clone(),
            trade: AccuracyStudy {
                outcomes: Vec::new(),
            },
            pixel_errors: Vec::new(),
            taken: 0,
            steps: 0,
        };
        let handle = doc.jobs.start(StudyAccuracy {
            scene: Arc::clone(&shown.scene),
            setup: of,
            rounds: self.rounds,
            only: Vec::new(),
        });
        self.study.follow(handle, found);
    }

    /// Chooses an outcome; returns its settings, with the scene and camera that it was rendered with.
    pub fn choose(&mut self, place: usize) -> Option<Setup> {
        let found = self.study.found()?;
        let setup = found.trade.outcomes.get(place)?.choice.setup.clone();
        self.chosen = Some(place);
        Some(setup)
    }
}
