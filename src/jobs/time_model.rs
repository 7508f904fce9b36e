//! The times of equation (1) for a scene: in place, and by regression over a set of trees.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::model::{
    Equation, Fit, InPlace, Observation, Term, fit, observe, parted, time_in_place,
};
use crate::scene::Scene;
use crate::structure::BuildSettings;
use crate::trace::RenderSettings;
use std::sync::Arc;

/// How often each tree is timed.
const ROUNDS: u32 = 3;

/// Measures the time model of a scene.
pub struct FitTimeModel {
    pub scene: Arc<Scene>,
    pub render: RenderSettings,
    /// The tree whose times are measured in place.
    pub build: BuildSettings,
    /// The trees that are timed for the regression.
    pub builds: Vec<BuildSettings>,
}

/// One more thing that is known.
pub enum Timed {
    InPlace(InPlace),
    Tree(Observation),
}

impl Job for FitTimeModel {
    type Partial = Timed;
    type Output = Fit;

    fn slot(&self) -> Slot {
        Slot::named("time model")
    }

    fn priority(&self) -> Priority {
        Priority::Study
    }

    fn run(self, context: &Context<Timed>) -> Result<Fit, JobError> {
        let FitTimeModel {
            scene,
            render,
            build,
            builds,
        } = self;
        // Timing in place is one more step than there are trees.
        let steps = builds.len() + 1;
        context.stage("measuring times");
        context.part(0, steps);
        let in_place =
            context.timed(|progress| time_in_place(&scene, &build, &render, progress))?;
        context.send(Timed::InPlace(in_place));
        let mut observations = Vec::new();
        for (place, build) in builds.iter().enumerate() {
            context.part(place + 1, steps);
            let observation =
                context.timed(|progress| observe(&scene, build, &render, ROUNDS, progress))?;
            observations.push(observation.clone());
            context.send(Timed::Tree(observation));
        }
        let [fitted, _] = parted(&observations);
        Ok(fit(&fitted, &Term::of(&scene), Equation::Corrected)?)
    }
}
