//! What is to be said of where a scene came from: the load report.

use std::fmt;

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoteKind {
    /// What was found and taken as it is.
    Read,
    /// What was left out, and why.
    Skipped,
    /// What was repaired or taken for something else.
    Changed,
    /// What the file lacks and the program put there.
    MadeUp,
    /// What the scene's author has to say.
    Remark,
}

impl NoteKind {
    /// All kinds, in the order in which a report lists them.
    pub const ALL: [NoteKind; 5] = [
        NoteKind::Read,
        NoteKind::Skipped,
        NoteKind::Changed,
        NoteKind::MadeUp,
        NoteKind::Remark,
    ];

    /// The heading of such notes.
    pub const fn title(self) -> &'static str {
        match self {
            NoteKind::Read => "Read",
            NoteKind::Skipped => "Skipped",
            NoteKind::Changed => "Changed",
            NoteKind::MadeUp => "Made up",
            NoteKind::Remark => "Note",
        }
    }
}

/// One sentence of the load report.
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

/// With its kind, as in `Skipped: 2 × face without area, first at line 7`.
impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.title(), self.text)
    }
}
