//! The times of equation (1) for a scene: in place, and by regression over a set of trees.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::model::{
    Equation, Fit, InPlace, Observation, Term, fastest, fit, observe, parted, time_in_place,
};
use crate::scene::Scene;
use crate::structure::BuildSettings;
use crate::trace::RenderSettings;
use std::sync::Arc;

/// Measures the time model of a scene.
pub struct FitTimeModel {
    pub scene: Arc<Scene>,
    pub render: RenderSettings,
    /// The trees that are timed for the regression.
    pub builds: Vec<BuildSettings>,
    /// How often each tree is timed; the shortest time counts.
    pub rounds: u32,
    pub equation: Equation,
    /// The tree whose times are measured in place, before the others. `None` measures those of the
    /// fastest tree, at the end.
    pub in_place: Option<BuildSettings>,
}

/// One more thing that is known.
pub enum Timed {
    InPlace(InPlace),
    Tree(Observation),
}

impl Job for FitTimeModel {
    type Partial = Timed;
    type Output = Fit;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("time model"), Priority::Study)
    }

    fn run(self, context: &Context<Timed>) -> Result<Fit, JobError> {
        let FitTimeModel {
            scene,
            render,
            builds,
            rounds,
            equation,
            in_place,
        } = self;
        // Timing in place is one more step than there are trees.
        let steps = builds.len() + 1;
        context.stage(format!("{}: timing {} trees", scene.name(), builds.len()));
        let time_in_place = |build: &BuildSettings| {
            let times =
                context.timed(|progress| time_in_place(&scene, build, &render, progress))?;
            context.send(Timed::InPlace(times));
            Ok::<_, JobError>(())
        };
        let is_first = in_place.is_some();
        if let Some(build) = in_place {
            context.part(0, steps);
            time_in_place(&build)?;
        }
        let (mut observations, mut too_large) = (Vec::new(), Vec::new());
        for (place, build) in builds.iter().enumerate() {
            context.part(place + usize::from(is_first), steps);
            let observed = context.timed(|progress| {
                match observe(&scene, build, &render, rounds, progress) {
                    Err(error) if error.is_too_large() => Ok(Err(error)),
                    result => result.map(Ok),
                }
            })?;
            let observation = match observed {
                Ok(observation) => observation,
                Err(error) => {
                    let BuildSettings { method, d_max, .. } = build;
                    too_large.push(format!(
                        "{}, D_MAX {d_max}: not timed: {error}",
                        method.name
                    ));
                    continue;
                }
            };
            observations.push(observation.clone());
            context.send(Timed::Tree(observation));
        }
        if let Some(fastest) = fastest(&observations).filter(|_| !is_first) {
            context.part(steps - 1, steps);
            time_in_place(&fastest.build)?;
        }
        if let ([], [reason, ..]) = (&observations[..], &too_large[..]) {
            return Err(JobError::new(reason.as_str()));
        }
        let [fitted, _] = parted(&observations);
        let mut fit = fit(&fitted, &Term::of(&scene), equation)?;
        fit.notes.extend(too_large);
        Ok(fit)
    }
}
