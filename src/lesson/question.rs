//! Questions: a number, or a choice of answers. The right answer is never written down; it follows
//! from what was measured.

use super::figures::Figures;
use super::formula::{Condition, Formula, Operator, Relation, Style};
use super::grade::{Grade, GuessScale, Verdict};
use super::tolerance::Tolerance;
use crate::present::number::Digits;

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

/// A prediction by the reader.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prediction {
    Number(f64),
    /// The index of a choice.
    Choice(usize),
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
                    grade: Grade::of(predicted, truth, *within),
                    predicted: Digits::All.number(predicted),
                    truth: formula.write(Some(truth), Style::Plain),
                    scale: Some(GuessScale::new(predicted, truth, *within)),
                })
            }
            (Answer::Choice(choices), Prediction::Choice(place)) => {
                let right = self.right_choices(figures);
                let grade = match right.contains(&place) {
                    true => Grade::Exact,
                    false => Grade::Off,
                };
                Some(Verdict {
                    grade,
                    scale: None,
                    predicted: choices.get(place)?.text.clone(),
                    truth: choices[*right.first()?].text.clone(),
                })
            }
            _ => None,
        }
    }
}
