//! Questions: a number, or a choice of answers. The right answer is never written down; it follows
//! from what was measured.

use super::figures::Figures;
use super::formula::{Condition, Formula, Operator, Relation, Style};

/// A question of a step.
#[derive(Clone, Debug)]
pub struct Question {
    /// Line in the file, counted from 1.
    pub line: usize,
    /// The question in plain text.
    pub ask: String,
    pub answer: Answer,
}

/// The kind of answer that a question expects.
#[derive(Clone, Debug)]
pub enum Answer {
    /// A number, within a tolerance.
    Number { formula: Formula, within: Tolerance },
    /// One of several choices, of which exactly one is right.
    Choice(Vec<Choice>),
}

/// One of several answers to choose from.
#[derive(Clone, Debug)]
pub struct Choice {
    pub text: String,
    /// It is right if all of these conditions hold.
    pub when: Vec<Condition>,
}

/// How far off a prediction may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    Absolute(f64),
    /// A fraction of the true value.
    Relative(f64),
}

/// A prediction by the reader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prediction {
    Number(f64),
    /// The index of a choice.
    Choice(usize),
}

/// A prediction compared with the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    pub right: bool,
    /// The prediction and the truth, as text.
    pub predicted: String,
    pub truth: String,
}

impl Tolerance {
    /// Parses `20 %` or a number.
    ///
    /// # Errors
    /// What was expected.
    pub fn parse(text: &str) -> Result<Tolerance, String> {
        let (number, share) = match text.trim().strip_suffix('%') {
            Some(number) => (number.trim(), true),
            None => (text.trim(), false),
        };
        let number = number.parse::<f64>().ok();
        let number = number.filter(|n| *n >= 0.0 && n.is_finite());
        match (number, share) {
            (Some(percent), true) => Ok(Tolerance::Relative(percent / 100.0)),
            (Some(number), false) => Ok(Tolerance::Absolute(number)),
            (None, _) => Err(format!("expected a number or '20 %', found '{text}'")),
        }
    }

    fn allows(self, predicted: f64, truth: f64) -> bool {
        let most = match self {
            Tolerance::Absolute(most) => most,
            Tolerance::Relative(share) => share * truth.abs(),
        };
        (predicted - truth).abs() <= most
    }
}

impl std::fmt::Display for Tolerance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Tolerance::Absolute(most) => write!(f, "{most}"),
            Tolerance::Relative(share) => write!(f, "{} %", share * 100.0),
        }
    }
}

impl Answer {
    /// Creates the choice "more", "the same" or "less" for the first formula compared with the
    /// second. Differences smaller than the fraction `same_within` of the second count as the same.
    pub fn comparison(first: &Formula, second: &Formula, same_within: f64) -> Answer {
        let scaled = |factor: f64| {
            let factor = Box::new(Formula::Number(factor));
            Formula::Of(Box::new(second.clone()), Operator::Times, factor)
        };
        let (low, high) = (scaled(1.0 - same_within), scaled(1.0 + same_within));
        let condition = |relation, right: &Formula| Condition {
            left: first.clone(),
            relation,
            right: right.clone(),
        };
        let choice = |text: &str, when| Choice {
            text: text.to_owned(),
            when,
        };
        Answer::Choice(vec![
            choice("More", vec![condition(Relation::More, &high)]),
            choice(
                match same_within {
                    0.0 => "The same",
                    _ => "About the same",
                },
                vec![
                    condition(Relation::AtMost, &high),
                    condition(Relation::AtLeast, &low),
                ],
            ),
            choice("Less", vec![condition(Relation::Less, &low)]),
        ])
    }

    /// Returns all formulas that determine the right answer.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            Answer::Number { formula, .. } => vec![formula],
            Answer::Choice(choices) => {
                let conditions = choices.iter().flat_map(|choice| &choice.when);
                conditions.flat_map(|when| when.sides()).collect()
            }
        }
    }

    /// Returns the indices of the choices that are right; empty for a number.
    pub fn right_choices(&self, figures: &Figures) -> Vec<usize> {
        let Answer::Choice(choices) = self else {
            return Vec::new();
        };
        let right = |choice: &Choice| choice.when.iter().all(|w| w.holds(figures) == Some(true));
        let all = choices.iter().enumerate();
        all.filter_map(|(i, choice)| right(choice).then_some(i))
            .collect()
    }

    /// Compares a prediction with what was measured. Returns `None` if the answer has no value or
    /// the prediction is of another kind.
    pub fn judge(&self, prediction: Prediction, figures: &Figures) -> Option<Verdict> {
        match (self, prediction) {
            (Answer::Number { formula, within }, Prediction::Number(predicted)) => {
                let truth = formula.value(figures)?;
                Some(Verdict {
                    right: within.allows(predicted, truth),
                    predicted: predicted.to_string(),
                    truth: formula.write(Some(truth), Style::Plain),
                })
            }
            (Answer::Choice(choices), Prediction::Choice(place)) => {
                let right = self.right_choices(figures);
                Some(Verdict {
                    right: right.contains(&place),
                    predicted: choices.get(place)?.text.clone(),
                    truth: choices[*right.first()?].text.clone(),
                })
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_are_shares_or_numbers() {
        assert_eq!(Tolerance::parse("20 %"), Ok(Tolerance::Relative(0.2)));
        assert_eq!(Tolerance::parse("3"), Ok(Tolerance::Absolute(3.0)));
        for wrong in ["", "x", "-1", "5 %%", "inf"] {
            assert!(Tolerance::parse(wrong).is_err(), "{wrong}");
        }
        assert!(Tolerance::Relative(0.2).allows(8.0, 10.0));
        assert!(!Tolerance::Relative(0.2).allows(7.9, 10.0));
        assert!(Tolerance::Absolute(1.0).allows(11.0, 10.0));
        assert!(!Tolerance::Absolute(1.0).allows(11.5, 10.0));
    }
}
