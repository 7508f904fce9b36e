//! Lessons: short guided tours in plain text. A lesson is one file in `assets/lessons/` and one
//! line in [`LESSONS`].
//!
//! Each step defines what is built and shown, explains what to look at, and asks for a prediction
//! before it shows the figures. A lesson never contains figures: [`Prose`] has formulas in braces,
//! and the right answer to a [`Question`] follows from what was measured. The conditions under
//! which the text of a step is true are listed in the step, and [`check`] verifies them.
//! `assets/lessons/README.md` explains how to write a lesson.

mod check;
mod content;
mod figures;
mod formula;
mod grade;
mod prose;
mod question;
mod read;
mod secret;
mod subject;
mod tolerance;

pub use check::{Measurer, check, check_step};
pub use content::{Expectation, Lesson, LessonError, Step};
pub use figures::{Difference, Figures, Name, Side, SideFigures};
pub use formula::{Condition, Formula, Operator, Relation, Style};
pub use grade::{Grade, GuessScale, Verdict};
pub use prose::{Placeholder, Prose};
pub use question::{Answer, Choice, Prediction, Question};
pub use secret::Secret;
pub use subject::{Look, Named, Subject};
pub use tolerance::Tolerance;

use std::path::Path;

/// A lesson that comes with the program.
pub struct Embedded {
    /// Name on the command line; its file name without the extension.
    pub name: &'static str,
    pub text: &'static str,
}

macro_rules! lessons {
    ($($name:literal)*) => {
        /// All lessons that come with the program, in the recommended order.
        pub static LESSONS: &[Embedded] = &[$( Embedded {
            name: $name,
            text: include_str!(concat!("../../assets/lessons/", $name, ".md")),
        } ),*];
    };
}

lessons! {
    "what-a-tree-saves"
    "one-ray"
    "median-or-surface-area"
    "empty-space"
    "how-deep"
    "speed-and-accuracy"
    "planes-or-boxes"
    "when-planes-win"
}

/// Why a lesson could not be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    #[error("{file}: {reason}")]
    Io {
        file: String,
        reason: std::io::Error,
    },
    #[error(transparent)]
    Wrong(#[from] LessonError),
}

impl Lesson {
    /// Parses a lesson. `name` is its file name for error messages. Paths of scenes are relative to
    /// the working directory.
    ///
    /// # Errors
    /// The first error, with its line.
    pub fn parse(text: &str, name: &str) -> Result<Lesson, LessonError> {
        read::read(text, name, None)
    }

    /// Returns the embedded lesson of this name, or else reads a file. Paths of scenes in a file
    /// are relative to its folder.
    ///
    /// # Errors
    /// The file cannot be read, or the first error in it, with its line.
    pub fn open(name_or_path: &str) -> Result<Lesson, OpenError> {
        if let Some(known) = LESSONS.iter().find(|known| known.name == name_or_path) {
            return Ok(known.read());
        }
        let path = Path::new(name_or_path);
        let text = std::fs::read_to_string(path).map_err(|reason| OpenError::Io {
            file: name_or_path.to_owned(),
            reason,
        })?;
        Ok(read::read(&text, name_or_path, path.parent())?)
    }
}

impl Embedded {
    /// Parses the lesson.
    ///
    /// # Panics
    /// If it is not valid, which tests exclude.
    pub fn read(&self) -> Lesson {
        let name = format!("{}.md", self.name);
        Lesson::parse(self.text, &name).unwrap_or_else(|error| panic!("{error}"))
    }
}
