//! The measures that may predict time.

use super::observe::SetObservation;
use super::statistics::{Line, r_squared};
use crate::measure::model::{self, Equation, Term};
use crate::measure::{Class, parameter};
use crate::scene::Scene;

/// A measure that may predict the time of tracing rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predictor {
    /// The parameter with this symbol.
    Parameter(&'static str),
    /// (1 − α) · `C_SAH` + α · `EPO`, with the α that explains most.
    SahAndEpo,
    /// Equation (1), whose times are fitted.
    Equation,
}

/// Rays in a structure, with the time of tracing them in seconds.
#[derive(Clone, Copy, Debug)]
pub struct Sample<'a> {
    pub observation: &'a SetObservation,
    pub seconds: f64,
}

/// A predictor with what was fitted to samples.
#[derive(Clone, Debug)]
pub enum Fitted {
    /// The logarithm of the time is a line over that of a measure.
    Power {
        predictor: Predictor,
        alpha: f64,
        line: Line,
    },
    Equation(model::Fit),
}

impl Predictor {
    /// All predictors: those of the structure alone, then those of the rays in it.
    pub const ALL: [Predictor; 11] = [
        Predictor::Parameter("C_SAH"),
        Predictor::SahAndEpo,
        Predictor::Parameter("V_SOV"),
        Predictor::Parameter("M_TREE"),
        Predictor::Parameter("LCV"),
        Predictor::Parameter("N_AT"),
        Predictor::Parameter("N_RPRT"),
        Predictor::Parameter("N_BT/ray"),
        Predictor::Parameter("N_PT"),
        Predictor::Parameter("B_RAY"),
        Predictor::Equation,
    ];

    /// Returns the symbol in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Predictor::Parameter(symbol) => symbol,
            Predictor::SahAndEpo => "C_SAH + EPO",
            Predictor::Equation => "equation (1)",
        }
    }

    /// Returns what it is, in a few words.
    pub fn about(self) -> &'static str {
        match self {
            Predictor::Parameter(symbol) => parameter(symbol).name,
            Predictor::SahAndEpo => "SAH cost and end-point overlap",
            Predictor::Equation => "nodes, boxes, hits and misses by their times",
        }
    }

    /// Returns whether it is known before a ray is traced.
    pub fn is_static(self) -> bool {
        match self {
            Predictor::Parameter(symbol) => parameter(symbol).class == Class::C,
            Predictor::SahAndEpo => true,
            Predictor::Equation => false,
        }
    }

    /// Returns whether it has a value for rays in a structure.
    pub fn applies(self, observation: &SetObservation) -> bool {
        self == Predictor::Equation || self.value(observation, 0.5).is_some()
    }

    /// Returns its value for rays in a structure. `None` if it does not apply to the structure, for 0, which has no
    /// logarithm, and for the equation, which has no value before it is fitted.
    fn value(self, observation: &SetObservation, alpha: f64) -> Option<f64> {
        let of = |symbol: &str| parameter(symbol).value(&observation.measurement);
        let value = match self {
            Predictor::Parameter(symbol) => of(symbol)?,
            Predictor::SahAndEpo => (1.0 - alpha) * of("C_SAH")? + alpha * of("EPO")?,
            Predictor::Equation => return None,
        };
        (value > 0.0 && value.is_finite()).then_some(value)
    }

    /// Fits it to samples to which it applies. `None` if they are too few or do not differ.
    pub fn fit(self, scene: &Scene, samples: &[Sample<'_>]) -> Option<Fitted> {
        match self {
            Predictor::Equation => fit_equation(scene, samples),
            Predictor::Parameter(_) => self.fit_power(samples, 0.0),
            Predictor::SahAndEpo => {
                let fits = (0..ALPHAS).map(|i| f64::from(i) / f64::from(ALPHAS));
                let fits = fits.filter_map(|alpha| {
                    let (x, y) = self.logarithms(samples, alpha);
                    Some((r_squared(&x, &y)?, alpha))
                });
                let (_, alpha) = fits.max_by(|a, b| a.0.total_cmp(&b.0))?;
                self.fit_power(samples, alpha)
            }
        }
    }

    fn fit_power(self, samples: &[Sample<'_>], alpha: f64) -> Option<Fitted> {
        let (x, y) = self.logarithms(samples, alpha);
        Some(Fitted::Power {
            predictor: self,
            alpha,
            line: Line::through(&x, &y)?,
        })
    }

    /// Returns the logarithms of values and of times.
    fn logarithms(self, samples: &[Sample<'_>], alpha: f64) -> (Vec<f64>, Vec<f64>) {
        let pairs = samples.iter().filter_map(|sample| {
            let value = self.value(sample.observation, alpha)?;
            Some((value.ln(), sample.seconds.ln()))
        });
        pairs.unzip()
    }
}

/// Steps from α = 0 to α = 1. The last is not tried: EPO alone has no logarithm for trees with planes.
const ALPHAS: u32 = 20;

fn fit_equation(scene: &Scene, samples: &[Sample<'_>]) -> Option<Fitted> {
    let observations: Vec<_> = (samples.iter())
        .map(|sample| model::Observation {
            build: sample.observation.measurement.build.clone(),
            terms: sample.observation.terms,
            seconds: sample.seconds,
        })
        .collect();
    let observations: Vec<_> = observations.iter().collect();
    let fit = model::fit(&observations, &Term::of(scene), Equation::Corrected);
    fit.ok().map(Fitted::Equation)
}

impl Fitted {
    /// Predicts the time of rays in a structure in seconds; `None` where the predictor does not apply.
    pub fn predict(&self, observation: &SetObservation) -> Option<f64> {
        match self {
            Fitted::Power {
                predictor,
                alpha,
                line,
            } => Some(line.at(predictor.value(observation, *alpha)?.ln()).exp()),
            Fitted::Equation(fit) => {
                Some(fit.predict(&observation.terms)).filter(|time| *time > 0.0)
            }
        }
    }

    /// Returns the α that was fitted; `None` for predictors without one.
    pub fn alpha(&self) -> Option<f64> {
        match self {
            Fitted::Power {
                predictor: Predictor::SahAndEpo,
                alpha,
                ..
            } => Some(*alpha),
            _ => None,
        }
    }
}
