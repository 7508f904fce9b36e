//! The load report: notes on how a scene file was read.

use std::fmt;

/// The kind of a note.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoteKind {
    /// Content that was read unchanged.
    Read,
    /// Content that was skipped, and why.
    Skipped,
    /// Content that was repaired or replaced by something similar.
    Changed,
    /// A default that stands in for something the file does not contain.
    Defaulted,
    /// A remark by the scene's author.
    Remark,
}

impl NoteKind {
    /// All kinds, in the order of the load report.
    pub const ALL: [NoteKind; 5] = [
        NoteKind::Read,
        NoteKind::Skipped,
        NoteKind::Changed,
        NoteKind::Defaulted,
        NoteKind::Remark,
    ];

    /// Returns the heading for notes of this kind.
    pub const fn title(self) -> &'static str {
        match self {
            NoteKind::Read => "Read",
            NoteKind::Skipped => "Skipped",
            NoteKind::Changed => "Changed",
            NoteKind::Defaulted => "Default",
            NoteKind::Remark => "Note",
        }
    }
}

/// One entry of the load report.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Note {
    pub kind: NoteKind,
    pub text: String,
}

impl Note {
    pub fn new(kind: NoteKind, text: impl Into<String>) -> Self {
        let text = text.into();
        Note { kind, text }
    }
}

/// Writes the note with its kind, as in `Skipped: 2 × polygon with zero area, first at line 7`.
impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.title(), self.text)
    }
}
