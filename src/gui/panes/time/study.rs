//! The times of equation (1) for the scene on view, in the background: first in place, then by
//! regression over a set of trees. Once known, they hold for every tree and picture of the scene with
//! the same kernel and precision.

use crate::gui::document::study::Study;
use crate::gui::document::{Current, Document};
use crate::jobs::{FitTimeModel, Timed};
use crate::measure::model::{Equation, Fit, InPlace, Observation, TermTimes, parted, trees};
use crate::scene::Scene;
use crate::trace::RenderSettings;
use std::sync::Arc;

/// Most pixels of the pictures that are timed.
const MOST_PIXELS: f64 = 128.0 * 128.0;

/// How often each tree is timed.
const ROUNDS: u32 = 3;

/// The measurement of the time model.
#[derive(Default)]
pub struct Modelling {
    pub study: Study<FitTimeModel, Found>,
}

/// What is known of the times; it grows with every step.
#[derive(Clone)]
pub struct Found {
    scene: Arc<Scene>,
    /// What the trees are timed with.
    render: RenderSettings,
    pub in_place: Option<InPlace>,
    pub observations: Vec<Observation>,
    /// Trees that are timed in all.
    pub trees: usize,
    /// Once all trees were timed.
    pub fit: Option<Fit>,
}

impl Found {
    /// Whether the times hold for what is shown.
    pub fn is_of(&self, current: &Current) -> bool {
        let (shown, mine) = (&current.shown, &self.render);
        Arc::ptr_eq(&self.scene, &shown.scene)
            && mine.kernel == shown.setup.render.kernel
            && mine.precision == shown.setup.render.precision
    }

    /// What the terms take by regression; `None` until all trees were timed.
    pub fn fitted(&self) -> Option<TermTimes> {
        let rays = self.observations.first()?.terms.rays;
        Some(TermTimes::of_fit(self.fit.as_ref()?, rays))
    }

    /// The greatest relative error on the trees that were left out of the fit, at least 0.
    pub fn worst(&self) -> Option<f64> {
        let [_, left_out] = parted(&self.observations);
        let errors = self.fit.as_ref()?.errors(&left_out);
        Some(
            errors
                .iter()
                .fold(0.0, |worst, error| error.abs().max(worst)),
        )
    }
}

impl Modelling {
    pub fn receive(&mut self) {
        let fit = self.study.receive(|found, timed| match timed {
            Timed::InPlace(times) => found.in_place = Some(times),
            Timed::Tree(observation) => found.observations.push(observation),
        });
        if let (Some(fit), Some(found)) = (fit, self.study.found_mut()) {
            found.fit = Some(fit);
        }
    }
}

impl Modelling {
    /// Whether the times can be measured: of a finished picture of a scene that has objects.
    pub fn may_start(&self, doc: &Document) -> bool {
        !self.study.is_running() && doc.current.as_ref().is_some_and(Current::is_of_objects)
    }

    /// Measures the times of the scene on view, in place of those before.
    pub fn start(&mut self, doc: &Document) {
        let Some(current) = doc.current.as_ref().filter(|_| self.may_start(doc)) else {
            return;
        };
        let shown = &current.shown;
        let (scene, render) = (Arc::clone(&shown.scene), reduced(&shown.setup.render));
        let (build, builds) = (shown.setup.build.clone(), trees(&scene));
        let found = Found {
            scene: Arc::clone(&scene),
            render,
            in_place: None,
            observations: Vec::new(),
            trees: builds.len(),
            fit: None,
        };
        let handle = doc.jobs.start(FitTimeModel {
            scene,
            render,
            builds,
            rounds: ROUNDS,
            equation: Equation::Corrected,
            in_place: Some(build),
        });
        self.study.follow(handle, found);
    }
}

/// A smaller picture of the same, rendered on one thread: others would compete for caches and memory.
fn reduced(render: &RenderSettings) -> RenderSettings {
    let pixels = f64::from(render.width) * f64::from(render.height);
    let share = (MOST_PIXELS / pixels).sqrt().min(1.0);
    let side = |side: u32| ((f64::from(side) * share) as u32).max(1);
    RenderSettings {
        width: side(render.width),
        height: side(render.height),
        threads: 1,
        ..*render
    }
}
