//! Files that other programs write and open although a specification forbids them: what is
//! unambiguous is read, and what was changed or ignored is reported.

mod gltf;
mod nff;
mod obj;
mod ply;
mod stl;

use bspscope::progress::Progress;
use bspscope::scene::format::{FORMATS, Input, ReadError};
use bspscope::scene::{NoteKind, SceneParts};

pub fn try_read(format: &str, bytes: &[u8]) -> Result<SceneParts, ReadError> {
    let format = FORMATS.iter().find(|f| f.name == format).unwrap();
    (format.read)(&Input::from(bytes), &Progress::new())
}

pub fn read(format: &str, bytes: impl AsRef<[u8]>) -> SceneParts {
    let bytes = bytes.as_ref();
    let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(600)]);
    try_read(format, bytes).unwrap_or_else(|error| panic!("{error} in {shown}"))
}

/// What the load report says was skipped or changed.
pub fn reported(parts: &SceneParts) -> String {
    let kinds = [NoteKind::Skipped, NoteKind::Changed];
    let notes = parts.notes.iter().filter(|n| kinds.contains(&n.kind));
    let texts: Vec<_> = notes.map(|note| note.text.as_str()).collect();
    texts.join("; ")
}

/// Checks the number of objects and the report of what was skipped or changed; the latter is a part
/// of it, or empty if there must be none.
pub fn check(format: &str, bytes: impl AsRef<[u8]>, objects: usize, report: &str) -> SceneParts {
    let shown = String::from_utf8_lossy(bytes.as_ref()).into_owned();
    let parts = read(format, bytes);
    assert_eq!(parts.objects.len(), objects, "{shown}");
    let found = reported(&parts);
    let is_right = match report {
        "" => found.is_empty(),
        part => found.contains(part),
    };
    assert!(is_right, "{found:?}, not {report:?}, in {shown}");
    parts
}
