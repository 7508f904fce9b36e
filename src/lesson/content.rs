//! What a lesson consists of.

use super::formula::Condition;
use super::prose::Prose;
use super::question::Question;
use super::subject::Subject;

/// A lesson.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The name of its file, for error messages.
    pub name: String,
    pub title: String,
    /// What it is about, in one sentence.
    pub about: String,
    /// The steps; at least one.
    pub steps: Vec<Step>,
}

/// A step of a lesson.
#[derive(Clone, Debug)]
pub struct Step {
    /// Line of its heading, counted from 1.
    pub line: usize,
    pub title: String,
    /// Line of the key `scene`.
    pub(super) scene_line: usize,
    pub subject: Subject,
    /// Text before the question.
    pub before: Prose,
    /// `None` if nothing is asked; then `after` is empty.
    pub question: Option<Question>,
    /// Text that is shown after the prediction.
    pub after: Prose,
    /// Conditions that must hold for the text to be true.
    pub expectations: Vec<Expectation>,
}

/// A condition that must hold for a text to be true.
#[derive(Clone, Debug)]
pub struct Expectation {
    pub line: usize,
    pub text: String,
    pub condition: Condition,
}

/// An error in a lesson, with its position.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}:{line}: {reason}")]
pub struct LessonError {
    pub file: String,
    /// Counted from 1.
    pub line: usize,
    pub reason: String,
}

impl Lesson {
    /// Creates an error in a line of this lesson.
    pub(super) fn error(&self, line: usize, reason: String) -> LessonError {
        LessonError {
            file: self.name.clone(),
            line,
            reason,
        }
    }
}
