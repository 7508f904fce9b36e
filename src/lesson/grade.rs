//! How good a prediction is, in words and on a scale.

use super::tolerance::Tolerance;

/// How close a prediction comes to what was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grade {
    /// A number within 2 %, or the right choice.
    Exact,
    /// A number within the lesson's tolerance.
    Close,
    Off,
}

/// The largest error of an exact number, as a fraction of the measured one.
pub(super) const EXACT: f64 = 0.02;

/// A prediction compared with the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    pub grade: Grade,
    /// The prediction and the truth, as text.
    pub predicted: String,
    pub truth: String,
    /// Where both lie; `None` for a choice.
    pub scale: Option<GuessScale>,
}

/// A prediction and the measured number on one scale. Positions are from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuessScale {
    /// Numbers at the two ends.
    pub bounds: [f64; 2],
    /// Whether equal distances are equal factors.
    pub logarithmic: bool,
    pub guess: f64,
    pub measured: f64,
    /// Positions between which a prediction is close.
    pub close: [f64; 2],
}

/// From this ratio between guess and measurement, a linear scale would hide the smaller one.
const LOGARITHMIC_FROM: f64 = 10.0;

impl Grade {
    /// Grades a number.
    pub(super) fn of(predicted: f64, truth: f64, within: Tolerance) -> Grade {
        let error = (predicted - truth).abs();
        if error <= EXACT * truth.abs() {
            Grade::Exact
        } else if error <= within.largest_error(truth) {
            Grade::Close
        } else {
            Grade::Off
        }
    }

    /// Returns the word for users.
    pub const fn word(self) -> &'static str {
        match self {
            Grade::Exact => "Exact",
            Grade::Close => "Close",
            Grade::Off => "Off",
        }
    }
}

impl Verdict {
    /// Returns whether the prediction counts as right.
    pub fn is_right(&self) -> bool {
        self.grade != Grade::Off
    }

    /// Returns the verdict in a sentence, such as `Off: you said 6, measured 12`.
    pub fn text(&self) -> String {
        let Verdict {
            predicted, truth, ..
        } = self;
        let word = self.grade.word();
        format!("{word}: you said {predicted}, measured {truth}")
    }
}

impl GuessScale {
    pub(super) fn new(guess: f64, measured: f64, within: Tolerance) -> GuessScale {
        let error = within.largest_error(measured);
        let close = [measured - error, measured + error];
        let smallest = guess.min(measured);
        let largest = guess.max(measured);
        let logarithmic = smallest > 0.0 && largest / smallest >= LOGARITHMIC_FROM;
        let bounds = if logarithmic {
            [
                libm::exp10(smallest.log10().floor()),
                libm::exp10(largest.log10().ceil()),
            ]
        } else {
            // Room for the marks at the ends.
            let [low, high] = [smallest.min(close[0]), largest.max(close[1])];
            let high = if high > low {
                high + 0.1 * (high - low)
            } else {
                high + 1.0
            };
            [low.min(0.0), high]
        };
        let scale = GuessScale {
            bounds,
            logarithmic,
            guess: 0.0,
            measured: 0.0,
            close: [0.0; 2],
        };
        GuessScale {
            guess: scale.position(guess),
            measured: scale.position(measured),
            close: close.map(|value| scale.position(value)),
            ..scale
        }
    }

    /// Returns the position of a number, 0 to 1. Numbers beyond the ends are at the ends.
    pub fn position(&self, value: f64) -> f64 {
        let along = |value: f64| match self.logarithmic {
            true => value.max(self.bounds[0]).log10(),
            false => value,
        };
        let [low, high] = self.bounds.map(along);
        ((along(value) - low) / (high - low)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grades_depend_on_the_error() {
        let grade = |predicted| Grade::of(predicted, 100.0, Tolerance::Relative(0.2));
        let grades = [98.0, 102.0, 97.9, 120.0, 80.0, 79.9, 121.0].map(grade);
        use Grade::{Close, Exact, Off};
        assert_eq!(grades, [Exact, Exact, Close, Close, Close, Off, Off]);
        assert_eq!(Grade::of(0.0, 0.0, Tolerance::Absolute(0.0)), Exact);
        assert_eq!(Grade::of(1.0, 0.0, Tolerance::Absolute(1.0)), Close);
        assert_eq!(Grade::of(11.0, 12.0, Tolerance::Absolute(0.0)), Off);
    }

    #[test]
    fn near_numbers_share_a_linear_scale_and_far_ones_a_logarithmic_one() {
        let near = GuessScale::new(6.0, 12.0, Tolerance::Absolute(3.0));
        assert!(!near.logarithmic && near.bounds[0] == 0.0 && near.bounds[1] > 15.0);
        assert!(near.guess < near.close[0] && near.close[0] < near.measured);
        assert!(near.measured < near.close[1] && near.close[1] < 1.0);
        let ratio = near.guess / near.measured;
        assert!((ratio - 0.5).abs() < 1e-12);

        let far = GuessScale::new(2e6, 12.0, Tolerance::Relative(0.2));
        assert!(far.logarithmic);
        assert_eq!(far.bounds, [10.0, 1e7]);
        assert!(far.measured < 0.1 && far.guess > 0.8 && far.guess < 1.0);
        assert!(far.close[0] < far.measured && far.measured < far.close[1]);

        for (guess, measured) in [(0.0, 0.0), (-5.0, 12.0), (0.0, 1e9), (7.0, 7.0)] {
            let scale = GuessScale::new(guess, measured, Tolerance::Absolute(0.0));
            let [guess, measured] = [scale.guess, scale.measured];
            assert!((0.0..=1.0).contains(&guess) && (0.0..=1.0).contains(&measured));
            assert!(scale.bounds[0] < scale.bounds[1]);
        }
    }
}
