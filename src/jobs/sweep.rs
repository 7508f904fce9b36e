//! The parameters over a grid of settings.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::sweep::{Plan, Row};
use crate::scene::Scene;
use std::sync::Arc;

/// Measures the points of a plan from number `first` on. Its partial results are the rows.
pub struct Sweep {
    pub scene: Arc<Scene>,
    pub plan: Arc<Plan>,
    pub first: usize,
}

impl Job for Sweep {
    type Partial = Row;
    type Output = ();

    fn slot(&self) -> Slot {
        Slot::named("sweep")
    }

    fn priority(&self) -> Priority {
        Priority::Study
    }

    fn run(self, context: &Context<Row>) -> Result<(), JobError> {
        let points = self.plan.points.len();
        context.stage("measuring points");
        for point in self.first..points {
            context.part(point, points);
            let row = context.timed(|progress| self.plan.row(&self.scene, point, progress))?;
            context.send(row);
        }
        Ok(())
    }
}
