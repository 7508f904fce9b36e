//! The paper's experiment, repeated.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::paper::{Conditions, PaperScene, Reproduction, reproduce};

/// Measures scenes of the paper with both methods, one scene after the other.
pub struct RepeatPaper {
    pub scenes: Vec<&'static PaperScene>,
    pub conditions: Conditions,
}

impl Job for RepeatPaper {
    /// A scene as far as it was measured.
    type Partial = Reproduction;
    /// One result per scene.
    type Output = Vec<Reproduction>;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("paper's experiment"), Priority::Study)
    }

    fn run(self, context: &Context<Reproduction>) -> Result<Vec<Reproduction>, JobError> {
        let mut results = Vec::new();
        for scene in self.scenes {
            context.stage(scene.name);
            results.push(context.timed(|progress| {
                reproduce(scene, &self.conditions, progress, |partial| {
                    context.send(partial.clone());
                })
            })?);
        }
        Ok(results)
    }
}
