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

/// The start of a note on the root margin.
const ROOT_MARGIN: &str = "root margin ";

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

    /// Returns the note of a scene whose published figures hold for root cells that extend by `margin`
    /// beyond the bounds, in the scene's units of length. `source` is the publication. NFF files keep
    /// the note, so that a scene has the same trees wherever it is loaded from.
    pub fn of_root_margin(margin: f64, source: &str) -> Self {
        Note::new(
            NoteKind::Remark,
            format!("{ROOT_MARGIN}{margin} (published: {source})"),
        )
    }

    /// Returns the margin of a note that [`Note::of_root_margin`] created.
    pub fn root_margin(&self) -> Option<f64> {
        let rest = self.text.strip_prefix(ROOT_MARGIN)?;
        let (number, _) = rest.split_once(" (published: ")?;
        let margin: f64 = number.parse().ok()?;
        let is_margin = self.kind == NoteKind::Remark && margin >= 0.0 && margin.is_finite();
        is_margin.then_some(margin)
    }
}

/// Writes the note with its kind, as in `Skipped: 2 × polygon with zero area, first at line 7`.
impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.title(), self.text)
    }
}
