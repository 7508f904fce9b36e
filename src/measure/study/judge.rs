//! How well every predictor explains the times, and predicts those of structures that its fit has not seen.

use super::observe::{Observation, SetObservation};
use super::predictor::{Predictor, Sample};
use super::rays::{RayOrigin, RaySet};
use super::statistics::{Estimate, estimate, median, r_squared, rank_correlation};
use crate::measure::parameter;
use crate::measure::random::Random;
use crate::scene::Scene;
use crate::structure::BuildSettings;
use crate::trace::KernelChoice;

/// The structures are divided into so many parts. Each part is predicted by a fit to the others.
const FOLDS: usize = 3;

/// Fewer structures tell nothing.
const FEWEST: usize = 9;

/// Measures of what equation (1) has no term for.
const MISSING: [&str; 6] = ["N_VLS", "N_AOIFL", "N_CULL", "B_RAY", "LCV", "M_TREE"];

/// How far predictions are off, relative to the measured times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    pub count: usize,
    /// Of the absolute errors.
    pub median: f64,
    /// The largest absolute error.
    pub worst: f64,
    /// Of the errors with their sign: above 0 if predictions are too high.
    pub bias: f64,
}

/// How well a predictor does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    pub predictor: Predictor,
    /// Structures to which it applies.
    pub count: usize,
    /// Of the logarithms of prediction and time. Of the equation, for structures left out of the fit.
    pub r_squared: Estimate,
    /// Spearman's rank correlation of prediction and time.
    pub rank: Estimate,
    /// On structures left out of the fit.
    pub left_out: Errors,
    /// The α of a fit to all structures, for the predictor that has one.
    pub alpha: Option<f64>,
}

/// Where equation (1) is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// The structure that is predicted worst, and its error: above 0 if the prediction is too high.
    pub worst: (BuildSettings, f64),
    /// Errors on structures left out of the fit, by family of structures.
    pub families: Vec<(&'static str, Errors)>,
    /// The measure without a term with which measured / predicted goes most, and the rank correlation.
    pub missing: Option<(&'static str, f64)>,
}

/// A set of rays with a kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    pub origin: RayOrigin,
    pub rays: usize,
    pub kernel: KernelChoice,
    /// (most − least) / median of a structure's times, in the median over structures. 0 for one round.
    pub spread: f64,
    /// By [`Predictor::ALL`], without those that apply to too few structures or are the same in all.
    pub scores: Vec<Score>,
    /// `None` without a score of the equation.
    pub misfit: Option<Misfit>,
}

impl Judged {
    /// Returns the score of a predictor, if it has one.
    pub fn score(&self, predictor: Predictor) -> Option<&Score> {
        self.scores
            .iter()
            .find(|score| score.predictor == predictor)
    }

    /// Returns the predictor that explains most among some; `None` if none has a score.
    pub fn best(&self, is_among: impl Fn(Predictor) -> bool) -> Option<&Score> {
        let scores = self.scores.iter().filter(|score| is_among(score.predictor));
        scores.max_by(|a, b| a.r_squared.value.total_cmp(&b.r_squared.value))
    }
}

/// Judges all predictors for every set of rays and every kernel, in this order.
pub fn judge(
    scene: &Scene,
    sets: &[RaySet],
    observations: &[Observation],
    kernels: &[KernelChoice],
) -> Vec<Judged> {
    let places = sets.iter().enumerate();
    places
        .flat_map(|(place, set)| {
            let of_set: Vec<_> = observations.iter().map(|o| &o.sets[place]).collect();
            let judged = (0..kernels.len()).map(move |k| (k, of_set.clone()));
            judged.map(move |(k, of_set)| judge_one(scene, set, &of_set, (k, kernels[k])))
        })
        .collect()
}

fn judge_one(
    scene: &Scene,
    set: &RaySet,
    observations: &[&SetObservation],
    (place, kernel): (usize, KernelChoice),
) -> Judged {
    let times = |o: &SetObservation| o.seconds[place].clone();
    let samples: Vec<Sample<'_>> = (observations.iter())
        .filter_map(|observation| {
            let seconds = median(&times(observation)).filter(|time| *time > 0.0)?;
            Some(Sample {
                observation,
                seconds,
            })
        })
        .collect();
    let spreads: Vec<f64> = (samples.iter())
        .map(|sample| {
            let times = times(sample.observation);
            let most = times.iter().copied().fold(0.0, f64::max);
            (most - times.iter().copied().fold(most, f64::min)) / sample.seconds
        })
        .collect();
    let scores = Predictor::ALL
        .iter()
        .filter_map(|p| score(scene, *p, &samples));
    Judged {
        origin: set.origin,
        rays: set.rays.len(),
        kernel,
        spread: median(&spreads).unwrap_or(0.0),
        scores: scores.collect(),
        misfit: misfit(scene, &samples),
    }
}

fn score(scene: &Scene, predictor: Predictor, samples: &[Sample<'_>]) -> Option<Score> {
    let applies = |sample: &&Sample<'_>| predictor.applies(sample.observation);
    let samples: Vec<_> = samples.iter().filter(applies).copied().collect();
    if samples.len() < FEWEST {
        return None;
    }
    let fit = predictor.fit(scene, &samples)?;
    let left_out = left_out(scene, predictor, &samples);
    // A power law is one line for all, but the equation has enough times to fit noise.
    let explained: Vec<(f64, f64)> = match predictor {
        Predictor::Equation => left_out
            .iter()
            .map(|(s, time)| (*time, s.seconds))
            .collect(),
        _ => (samples.iter())
            .filter_map(|s| Some((fit.predict(s.observation)?, s.seconds)))
            .collect(),
    };
    let logarithms = explained.iter().map(|(x, y)| (x.ln(), y.ln()));
    let (x, y): (Vec<_>, Vec<_>) = logarithms.unzip();
    Some(Score {
        predictor,
        count: samples.len(),
        r_squared: estimate(&x, &y, r_squared)?,
        rank: estimate(&x, &y, rank_correlation)?,
        left_out: errors(left_out.iter())?,
        alpha: fit.alpha(),
    })
}

/// Predicts every sample by a fit to the parts without it. Samples without a prediction are left out.
fn left_out<'a>(
    scene: &Scene,
    predictor: Predictor,
    samples: &[Sample<'a>],
) -> Vec<(Sample<'a>, f64)> {
    // Settings vary with fixed periods, so parts are drawn.
    let mut order: Vec<usize> = (0..samples.len()).collect();
    let mut random = Random::new(3);
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
    let mut found = Vec::new();
    for fold in 0..FOLDS {
        let is_out = |i: usize| order[i] % FOLDS == fold;
        let part = |out: bool| (0..samples.len()).filter(move |i| is_out(*i) == out);
        let fitted: Vec<_> = part(false).map(|i| samples[i]).collect();
        let Some(fit) = predictor.fit(scene, &fitted) else {
            continue;
        };
        found.extend(
            part(true).filter_map(|i| Some((samples[i], fit.predict(samples[i].observation)?))),
        );
    }
    found
}

/// Returns the errors of predictions; `None` if there are none.
fn errors<'a>(predicted: impl Iterator<Item = &'a (Sample<'a>, f64)>) -> Option<Errors> {
    let errors: Vec<f64> = predicted
        .map(|(sample, time)| time / sample.seconds - 1.0)
        .collect();
    let absolute: Vec<f64> = errors.iter().map(|error| error.abs()).collect();
    Some(Errors {
        count: errors.len(),
        median: median(&absolute)?,
        worst: absolute.iter().copied().fold(0.0, f64::max),
        bias: median(&errors)?,
    })
}

/// Finds where the equation is wrong.
fn misfit(scene: &Scene, samples: &[Sample<'_>]) -> Option<Misfit> {
    if samples.len() < FEWEST {
        return None;
    }
    let predicted = left_out(scene, Predictor::Equation, samples);
    let family = |sample: &Sample<'_>| {
        sample
            .observation
            .measurement
            .build
            .method
            .structure
            .family()
    };
    let mut families: Vec<&'static str> = Vec::new();
    for (sample, _) in &predicted {
        if !families.contains(&family(sample)) {
            families.push(family(sample));
        }
    }
    let of_family = |name| errors(predicted.iter().filter(|(s, _)| family(s) == name));
    let goes_with = |symbol| {
        let pairs = predicted.iter().filter_map(|(sample, time)| {
            let value = parameter(symbol).value(&sample.observation.measurement)?;
            Some((value, sample.seconds / time))
        });
        let (x, y): (Vec<_>, Vec<_>) = pairs.unzip();
        Some((symbol, rank_correlation(&x, &y)?)).filter(|_| x.len() >= FEWEST)
    };
    let candidates = MISSING.into_iter().filter_map(goes_with);
    let off = |(sample, time): &(Sample<'_>, f64)| time / sample.seconds - 1.0;
    let worst = predicted
        .iter()
        .max_by(|a, b| off(a).abs().total_cmp(&off(b).abs()))?;
    Some(Misfit {
        worst: (worst.0.observation.measurement.build.clone(), off(worst)),
        families: families
            .into_iter()
            .filter_map(|name| Some((name, of_family(name)?)))
            .collect(),
        missing: candidates.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())),
    })
}
