//! What a study finds of a scene, and of several.

use super::judge::{Judged, judge};
use super::observe::{LeftOut, Observation, Observing, Plan};
use super::predictor::Predictor;
use super::rays::RayOrigin;
use super::statistics::{Estimate, estimate};
use crate::primitive::Precision;
use crate::scene::Scene;
use crate::trace::KernelChoice;

/// What a study finds of a scene.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub scene: String,
    pub objects: usize,
    pub precision: Precision,
    pub rounds: usize,
    pub kernels: Vec<KernelChoice>,
    /// Every structure with its counts and times.
    pub observations: Vec<Observation>,
    pub left_out: LeftOut,
    /// By set of rays and kernel.
    pub judged: Vec<Judged>,
}

impl Outcome {
    /// Judges what was observed in a scene.
    pub fn of(scene: &Scene, plan: &Plan, observing: Observing<'_>) -> Outcome {
        let (sets, observations, left_out) = observing.into_result();
        Outcome {
            scene: scene.name().to_owned(),
            objects: scene.objects().len(),
            precision: plan.render.precision_for(scene).precision,
            rounds: plan.rounds,
            kernels: plan.kernels.clone(),
            judged: judge(scene, &sets, &observations, &plan.kernels),
            observations,
            left_out,
        }
    }

    /// Returns the judgement for a set of rays and a kernel, if there are such rays.
    pub fn judged(&self, origin: RayOrigin, kernel: KernelChoice) -> Option<&Judged> {
        let mut judged = self.judged.iter();
        judged.find(|judged| judged.origin == origin && judged.kernel == kernel)
    }
}

/// Returns the mean R² of a predictor over scenes, with a confidence interval for other scenes; `None` if it has no
/// score in any.
pub fn over_scenes(
    outcomes: &[Outcome],
    origin: RayOrigin,
    kernel: KernelChoice,
    predictor: Predictor,
) -> Option<Estimate> {
    let of = |outcome: &Outcome| {
        let score = outcome.judged(origin, kernel)?.score(predictor)?;
        Some(score.r_squared.value)
    };
    let values: Vec<f64> = outcomes.iter().filter_map(of).collect();
    let mean = |values: &[f64], _: &[f64]| {
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    estimate(&values, &values, mean)
}
