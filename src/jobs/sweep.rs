//! The parameters over a grid of settings.

use super::context::{Context, JobError};
use super::job::Job;
use super::load::Load;
use super::slot::{Priority, Slot};
use crate::measure::sweep::{Plan, Row};
use crate::scene::{Scene, SceneRequest};
use std::sync::Arc;

/// Measures points of a plan. Its partial results are the rows.
pub struct Sweep {
    pub plan: Arc<Plan>,
    /// The points to measure, by number, in order.
    pub points: Vec<usize>,
    /// A scene that is loaded, and how it was requested. Points of another scene load theirs.
    pub scene: (SceneRequest, Arc<Scene>),
}

impl Job for Sweep {
    type Partial = Row;
    type Output = ();

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("sweep"), Priority::Study)
    }

    fn run(self, context: &Context<Row>) -> Result<(), JobError> {
        let Sweep {
            plan,
            points,
            scene: (mut loaded, mut scene),
        } = self;
        for point in points {
            let (setup, key) = (&plan.points[point].setup, &plan.points[point].key);
            if setup.scene != loaded {
                scene = Load(setup.scene.clone()).run(&context.silent())?;
                loaded = setup.scene.clone();
            }
            let mut stage = format!(
                "point {} of {}: {}, D_MAX {}, N_OILF {}",
                point + 1,
                plan.points.len(),
                key.method,
                key.d_max,
                key.n_oilf
            );
            let varied = key.varied();
            if !varied.is_empty() {
                stage += &format!(", {varied}");
            }
            context.stage(stage);
            context.part(point, plan.points.len());
            let row = context.timed(|progress| plan.row(&scene, point, progress))?;
            context.send(row);
        }
        Ok(())
    }
}
