//! Why a reader fails.

use super::place::Place;
use crate::progress::Cancelled;
use std::fmt::Display;

/// Why a reader gave up; it knows no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    #[error("{place}: expected {expected}, found {found}")]
    Syntax {
        place: Place,
        expected: String,
        found: String,
    },
    /// A mistake in, or the lack of, a file that this one names.
    #[error("{}", located(.name, .reason))]
    Beside {
        name: String,
        reason: Box<ReadError>,
    },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl ReadError {
    /// The mistake that something else was found than expected.
    pub(super) fn at(place: Place, expected: impl Display, found: impl Display) -> Self {
        ReadError::Syntax {
            place,
            expected: expected.to_string(),
            found: found.to_string(),
        }
    }
}

/// A mistake with its file, `file:line: …` as compilers write it.
pub(super) fn located(file: impl Display, reason: &ReadError) -> String {
    match reason {
        ReadError::Syntax {
            place: Place::Line(line),
            expected,
            found,
        } => format!("{file}:{line}: expected {expected}, found {found}"),
        reason => format!("{file}: {reason}"),
    }
}
