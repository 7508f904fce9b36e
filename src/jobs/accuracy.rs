//! The accuracy study: time and error of every cheaper setting.

use super::context::{Context, JobError};
use super::job::Job;
use super::load::Load;
use super::slot::{Priority, Slot};
use crate::measure::accuracy::{AccuracyStudy, Knob, Outcome, StudyRun, choices, reference};
use crate::scene::{Cylinders, Scene, SceneRequest};
use crate::setup::Setup;
use std::sync::Arc;

/// The maximum memory, in bytes, for the errors of all pixels of all choices. Studies of larger
/// pictures do not send them.
const MOST_BYTES: usize = 512 << 20;

/// Measures time and error of every choice for a scene.
pub struct StudyAccuracy {
    /// As `setup` describes it.
    pub scene: Arc<Scene>,
    pub setup: Setup,
    /// Number of rounds, at least 1. Each round times every choice once.
    pub rounds: u32,
    /// The only knobs to vary, each alone. Empty varies all knobs, alone and together.
    pub only: Vec<&'static Knob>,
}

/// The result of timing one choice once.
pub struct Measured {
    /// Index of the outcome that has a new time. In the first round, the outcome itself is new.
    pub place: usize,
    pub outcome: Outcome,
    /// In the first round, the error of every pixel, row by row, unless they take too much memory.
    pub pixel_errors: Option<Vec<f32>>,
    /// Total number of steps.
    pub steps: usize,
}

impl Job for StudyAccuracy {
    type Partial = Measured;
    type Output = AccuracyStudy;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("accuracy study"), Priority::Study)
    }

    fn run(self, context: &Context<Measured>) -> Result<AccuracyStudy, JobError> {
        let StudyAccuracy {
            scene,
            setup,
            rounds,
            only,
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
        let mut choices = choices(&reference(&setup), &scene);
        if !only.is_empty() {
            let is_asked = |name: &str| only.iter().any(|knob| knob.name() == name);
            choices.retain(|choice| match &choice.turned[..] {
                [] => true,
                [(knob, _)] => is_asked(knob),
                _ => false,
            });
        }
        let pixels = render.width as usize * render.height as usize;
        let keeps = choices.len() * pixels * size_of::<f32>() <= MOST_BYTES;
        context.stage(format!("measuring {} choices", choices.len()));
        let mut run = StudyRun::new(&scene, choices, rounds)?;
        let steps = run.turns();
        for step in 0..steps {
            context.part(step, steps);
            let Some(turn) = context.timed(|progress| run.turn(progress))? else {
                break;
            };
            context.send(Measured {
                place: turn.place,
                outcome: run.outcomes()[turn.place].clone(),
                pixel_errors: turn.pixel_errors.filter(|_| keeps),
                steps,
            });
        }
        Ok(run.finish())
    }
}
