//! What a lesson consists of.

use super::formula::Condition;
use super::prose::Prose;
use super::question::Question;
use super::subject::Subject;

/// A lesson.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The name of its file, as it is told in errors.
    pub name: String,
    pub title: String,
    /// What it is about, in a sentence.
    pub about: String,
    /// At least one.
    pub steps: Vec<Step>,
}

/// A step of a lesson.
#[derive(Clone, Debug)]
pub struct Step {
    /// Line of its heading, from 1.
    pub line: usize,
    pub title: String,
    /// Line that names its scene.
    pub(super) scene_line: usize,
    pub subject: Subject,
    /// What to look at.
    pub before: Prose,
    /// `None` where nothing is asked; then nothing is told after it either.
    pub question: Option<Question>,
    /// What is told once there is a prediction.
    pub after: Prose,
    /// What must hold for the text to be true.
    pub expectations: Vec<Expectation>,
}

/// A condition that must hold for a text to be true.
#[derive(Clone, Debug)]
pub struct Expectation {
    pub line: usize,
    pub text: String,
    pub condition: Condition,
}

/// What is wrong with a lesson, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}:{line}: {reason}")]
pub struct LessonError {
    pub file: String,
    /// From 1.
    pub line: usize,
    pub reason: String,
}

impl Lesson {
    /// What is wrong in a line of it.
    pub(super) fn error(&self, line: usize, reason: String) -> LessonError {
        LessonError {
            file: self.name.clone(),
            line,
            reason,
        }
    }
}
