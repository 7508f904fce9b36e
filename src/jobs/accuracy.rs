//! What accuracy costs: every choice that trades accuracy for time.

use super::context::{Context, JobError};
use super::job::Job;
use super::load::Load;
use super::slot::{Priority, Slot};
use crate::measure::accuracy::{Outcome, Trading, choices, reference};
use crate::scene::{Cylinders, Scene, SceneRequest};
use crate::setup::Setup;
use std::sync::Arc;

/// The most bytes that the errors of all pixels of all choices may take; in a study of larger
/// pictures they are not kept.
const MOST_BYTES: usize = 512 << 20;

/// Measures time and error of every choice for a scene.
pub struct StudyAccuracy {
    /// As `setup` describes it.
    pub scene: Arc<Scene>,
    pub setup: Setup,
    /// Rounds in which every choice is timed once, at least 1.
    pub rounds: u32,
}

/// What is known after one choice was timed once more.
pub struct Measured {
    /// Which of the outcomes has another time now; in the first round, which is new.
    pub place: usize,
    pub outcome: Outcome,
    /// In the first round, the error of every pixel, row by row, unless they take too much memory.
    pub pixel_errors: Option<Vec<f32>>,
    /// Steps in all.
    pub steps: usize,
}

impl Job for StudyAccuracy {
    type Partial = Measured;
    type Output = ();

    fn slot(&self) -> Slot {
        Slot::named("accuracy study")
    }

    fn priority(&self) -> Priority {
        Priority::Study
    }

    fn run(self, context: &Context<Measured>) -> Result<(), JobError> {
        let StudyAccuracy {
            scene,
            setup,
            rounds,
        } = self;
        let scene = if setup.scene.cylinders == Cylinders::Exact {
            scene
        } else {
            let exact = Load(SceneRequest {
                cylinders: Cylinders::Exact,
                ..setup.scene.clone()
            });
            exact.run(&context.silent())?
        };
        let render = &setup.render;
        let choices = choices(&reference(&setup), &scene);
        let pixels = render.width as usize * render.height as usize;
        let keeps = choices.len() * pixels * size_of::<f32>() <= MOST_BYTES;
        let mut trading = Trading::new(&scene, choices, rounds)?;
        let steps = trading.turns();
        context.stage("measuring choices");
        for step in 0..steps {
            context.part(step, steps);
            let Some(turn) = context.timed(|progress| trading.turn(progress))? else {
                break;
            };
            context.send(Measured {
                place: turn.place,
                outcome: trading.outcomes()[turn.place].clone(),
                pixel_errors: turn.pixel_errors.filter(|_| keeps),
                steps,
            });
        }
        Ok(())
    }
}
