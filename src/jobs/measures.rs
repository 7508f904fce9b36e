//! Which measure predicts time: the study of a scene.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::study::{Observing, Outcome, Plan};
use crate::scene::Scene;
use std::sync::Arc;

/// Traces rays in all structures of a plan, and judges all measures.
pub struct StudyMeasures {
    pub scene: Arc<Scene>,
    pub plan: Plan,
}

impl Job for StudyMeasures {
    type Partial = ();
    type Output = Outcome;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("study of measures"), Priority::Study)
    }

    fn run(self, context: &Context<()>) -> Result<Outcome, JobError> {
        let StudyMeasures { scene, plan } = self;
        context.stage(format!("{}: finding rays", scene.name()));
        let new = |progress: &_| Observing::new(&scene, plan.clone(), progress);
        let mut observing = context.unit(new)?;
        context.stage(format!(
            "{}: tracing rays in {} structures",
            scene.name(),
            plan.builds.len()
        ));
        while let Some((done, all)) = observing.upcoming() {
            context.part(done, all);
            context.timed(|progress| observing.turn(progress))?;
        }
        Ok(Outcome::of(&scene, &plan, observing))
    }
}
