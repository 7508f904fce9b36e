//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! Third-party readers are used where they hold: `gltf-json` for glTF's JSON and `ply-rs-bw` for
//! PLY's values. OBJ and STL are read here, since the readers there are cannot be trusted with any
//! file: `tobj` 4.0.5 panics at a material's `Kd 1 2`, names no lines and passes over what it does
//! not know; `stl_io` 0.11 takes binary files that begin with `solid` for text and stops after the
//! first solid. (Likewise `gltf` 1.4.1 panics where a mesh names an accessor that is not there.)
//!
//! Whatever a file claims, memory grows with the bytes that are there: files have at most
//! [`MOST_BYTES`] and come to at most [`MOST_FACES`] objects.

mod choose;
mod complete;
mod gather;
mod gltf;
mod input;
mod lines;
pub mod nff;
mod obj;
mod place;
mod ply;
mod stl;

pub use gather::{MOST_FACES, MOST_VERTICES, MOST_VERTICES_SPLIT};
pub use input::{BesideError, Input, MOST_BYTES};
pub use place::Place;

use super::{Note, NoteKind, SceneParts};
use crate::progress::{Cancelled, Progress};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Writes a scene to a stream.
pub type WriteScene = fn(&SceneParts, &mut dyn std::io::Write) -> std::io::Result<()>;

/// A reader, and maybe a writer, of one file format.
pub struct Format {
    /// Lower-case name, such as `nff`.
    pub name: &'static str,
    /// One phrase: what it is.
    pub about: &'static str,
    /// File name extensions, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// Whether the bytes are clearly a file of this format.
    pub recognizes: fn(&[u8]) -> bool,
    /// Reads a whole file.
    pub read: fn(&Input<'_>, &Progress) -> Result<SceneParts, ReadError>,
    /// Writes the scene so that reading it back gives the identical scene; `None` for formats that
    /// cannot hold all of a scene.
    pub write: Option<WriteScene>,
}

/// All formats.
pub static FORMATS: &[Format] = &[
    nff::FORMAT,
    obj::FORMAT,
    ply::FORMAT,
    gltf::FORMAT,
    stl::FORMAT,
];

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

/// Why a file gave no scene: `file:line: what was expected, what was found`.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    #[error("{}: {reason}", .path.display())]
    Io {
        path: PathBuf,
        reason: std::io::Error,
    },
    #[error("{}", located(.path.display(), .reason))]
    Read { path: PathBuf, reason: ReadError },
    #[error("{}: neither name nor content is that of a scene file ({})", .path.display(), names())]
    Unknown { path: PathBuf },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A mistake with its file, `file:line: …` as compilers write it.
fn located(file: impl Display, reason: &ReadError) -> String {
    match reason {
        ReadError::Syntax {
            place: Place::Line(line),
            expected,
            found,
        } => format!("{file}:{line}: expected {expected}, found {found}"),
        reason => format!("{file}: {reason}"),
    }
}

/// The names of all formats, in capitals.
pub fn names() -> String {
    let names: Vec<_> = FORMATS.iter().map(|f| f.name.to_uppercase()).collect();
    names.join(", ")
}

/// The format for a path, by its extension alone.
pub fn for_path(path: &Path) -> Option<&'static Format> {
    let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
    let has_it = |f: &&Format| f.extensions.contains(&extension.as_str());
    FORMATS.iter().find(has_it)
}

/// Reads a scene file of the format that its content shows, or else its extension; the scene is
/// named after the file's stem. Its notes are the load report.
///
/// # Errors
/// The file cannot be read, is of no known format, holds a mistake, or the task was cancelled.
pub fn read_file(path: &Path, progress: &Progress) -> Result<SceneParts, FormatError> {
    let failed = |reason| FormatError::Io {
        path: path.to_owned(),
        reason,
    };
    let bytes = input::read_whole(path, &progress.part(0.0, 0.1)).map_err(failed)??;
    let Some((format, why)) = choose::format_of(path, &bytes) else {
        let path = path.to_owned();
        return Err(FormatError::Unknown { path });
    };
    let input = Input {
        bytes: &bytes,
        // The folder of a bare file name is the current one.
        folder: path.parent().map(|folder| match folder.as_os_str() {
            empty if empty.is_empty() => Path::new("."),
            _ => folder,
        }),
    };
    match (format.read)(&input, &progress.part(0.1, 1.0)) {
        Ok(mut parts) => {
            parts.name = path
                .file_stem()
                .map_or_else(String::new, |s| s.to_string_lossy().into_owned());
            let name = format.name.to_uppercase();
            let size = format!("{name} file of {} bytes{why}", bytes.len());
            parts.notes.insert(0, Note::new(NoteKind::Read, size));
            Ok(parts)
        }
        Err(ReadError::Cancelled(c)) => Err(c.into()),
        Err(reason) => Err(FormatError::Read {
            path: path.to_owned(),
            reason,
        }),
    }
}
