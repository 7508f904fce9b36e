//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! Two readers use third-party parsers: `gltf-json` for the JSON of glTF and `ply-rs-bw` for the
//! values of PLY. OBJ and STL have their own parsers here because the existing crates fail on some
//! files. `tobj` 4.0.5 panics on a material with `Kd 1 2`, reports no line numbers and silently
//! ignores unknown statements. `stl_io` 0.11 reads binary files that begin with `solid` as text and
//! stops after the first solid. (Likewise, `gltf` 1.4.1 panics if a mesh refers to a missing
//! accessor.)
//!
//! Memory use is bounded by the actual size of a file, not by the counts that it declares. A file
//! can have at most [`MAX_BYTES`] bytes and [`MAX_FACES`] objects.

mod builder;
mod choose;
mod complete;
mod gltf;
mod input;
mod lines;
pub mod nff;
mod obj;
mod place;
mod ply;
mod stl;

pub use builder::{MAX_FACES, MAX_SPLIT_VERTICES, MAX_VERTICES};
pub use input::{Input, MAX_BYTES, SiblingError};
pub use place::Place;

use super::{Note, NoteKind, SceneParts};
use crate::progress::{Cancelled, Progress};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Writes a scene to a stream.
pub type WriteScene = fn(&SceneParts, &mut dyn std::io::Write) -> std::io::Result<()>;

/// A file format: its reader and, optionally, its writer.
pub struct Format {
    /// Lower-case name, such as `nff`.
    pub name: &'static str,
    /// A short description.
    pub about: &'static str,
    /// File name extensions, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// Returns whether the bytes are clearly a file of this format.
    pub recognizes: fn(&[u8]) -> bool,
    /// Reads a whole file.
    pub read: fn(&Input<'_>, &Progress) -> Result<SceneParts, ReadError>,
    /// Writes a scene so that reading it back gives an identical scene; `None` for formats that
    /// cannot represent every scene.
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

/// Why a reader failed, without the path of the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    #[error("{place}: expected {expected}, found {found}")]
    Syntax {
        place: Place,
        expected: String,
        found: String,
    },
    /// An error in a file that this file refers to, or the lack of that file.
    #[error("{}", located(.name, .reason))]
    InSibling {
        name: String,
        reason: Box<ReadError>,
    },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl ReadError {
    /// Creates the error that something else was found than expected.
    pub(super) fn at(place: Place, expected: impl Display, found: impl Display) -> Self {
        ReadError::Syntax {
            place,
            expected: expected.to_string(),
            found: found.to_string(),
        }
    }
}

/// Why a scene file could not be read: `file:line: expected …, found …`.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    #[error("{}: {reason}", .path.display())]
    Io {
        path: PathBuf,
        reason: std::io::Error,
    },
    #[error("{}", located(.path.display(), .reason))]
    Read { path: PathBuf, reason: ReadError },
    #[error(
        "{}: unknown file format: neither the extension nor the content is that of a scene file ({})",
        .path.display(),
        names()
    )]
    Unknown { path: PathBuf },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Formats an error with its file, `file:line: …`, as compilers do.
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

/// Returns the names of all formats in capitals, separated by commas.
pub fn names() -> String {
    let names: Vec<_> = FORMATS.iter().map(|f| f.name.to_uppercase()).collect();
    names.join(", ")
}

/// Returns the format for the extension of a path.
pub fn for_path(path: &Path) -> Option<&'static Format> {
    let extension = path.extension()?.to_string_lossy().to_ascii_lowercase();
    let has_it = |f: &&Format| f.extensions.contains(&extension.as_str());
    FORMATS.iter().find(has_it)
}

/// Reads a scene file. The content determines the format, or else the extension. The scene is named
/// after the stem of the file name; its notes are the load report.
///
/// # Errors
/// The file cannot be read, its format is unknown, it contains an error, or the task was cancelled.
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
        // The folder of a bare file name is the current folder.
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
