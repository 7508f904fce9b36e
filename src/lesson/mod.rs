//! Lessons: short guided tours in plain text. A lesson is one file in `assets/lessons/` and one line
//! in [`LESSONS`].
//!
//! Every step says what is built and shown, what to look at, and asks for a prediction before it
//! tells the figures. No figure is ever written into a lesson: [`Prose`] has formulas in braces, and
//! the right answer of a [`Question`] follows from what was measured. What a step takes for granted
//! it expects in so many words, and [`check`] tells where that does not hold.
//! `assets/lessons/README.md` tells how to write one.

mod check;
mod content;
mod figures;
mod formula;
mod prose;
mod question;
mod read;
mod subject;

pub use check::{Measurer, check, check_step};
pub use content::{Expectation, Lesson, LessonError, Step};
pub use figures::{Difference, Figures, Name, Side, SideFigures};
pub use formula::{Condition, Formula, Operator, Relation, Style};
pub use prose::{Placeholder, Prose};
pub use question::{Answer, Choice, Prediction, Question, Tolerance, Verdict};
pub use subject::{Look, Named, Subject};

use std::path::Path;

/// A lesson that comes with the program.
pub struct Embedded {
    /// Its name on the command line, and that of its file without the ending.
    pub name: &'static str,
    pub text: &'static str,
}

macro_rules! lessons {
    ($($name:literal)*) => {
        /// All lessons that come with the program, in the order in which they are best taken.
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
}

/// Why a lesson cannot be had.
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
    /// Reads a lesson that `name` names in errors; paths of scenes are relative to the working
    /// folder.
    ///
    /// # Errors
    /// Line and reason of the first thing that is wrong.
    pub fn parse(text: &str, name: &str) -> Result<Lesson, LessonError> {
        read::read(text, name, None)
    }

    /// The lesson of this name, or else that in this file, whose scenes may lie beside it.
    ///
    /// # Errors
    /// A file that cannot be read, or line and reason of the first thing that is wrong in it.
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
    /// The lesson.
    ///
    /// # Panics
    /// Never: a test reads them all.
    pub fn read(&self) -> Lesson {
        let name = format!("{}.md", self.name);
        Lesson::parse(self.text, &name).unwrap_or_else(|error| panic!("{error}"))
    }
}
