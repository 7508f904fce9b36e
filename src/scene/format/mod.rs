//! Scene file formats. A format is one file here and one line in [`FORMATS`].
//!
//! # What is read, reported and refused
//!
//! - **What is unambiguous is read,** even if a specification forbids it: text in tokens instead of
//!   lines, byte-order marks, whole numbers written as decimals, `-1.#IND` for what is not a number.
//! - **What was changed or ignored is reported,** with its count and its first place: the load report
//!   consists of the scene's [`Note`]s.
//! - **Only what would give wrong geometry is refused,** with file, line and reason: a coordinate that
//!   is not a finite number, the index of a vertex that does not exist, missing data, compressed
//!   meshes. A bad normal, texture coordinate, color, material, light or camera never refuses the
//!   geometry. Normals are replaced by the face normal, materials and the rest by defaults.
//! - **Another format or encoding is named:** UTF-16, glTF 1.0, the NFF of Sense8, AFF.
//!
//! `docs/formats.md` lists the details per format.
//!
//! # Parsers
//!
//! All parsers are our own, except for the JSON of glTF (`serde_json`), because the existing crates
//! fail on files that people have:
//!
//! - `tobj` 4.0.5 panics on a material with `Kd 1 2`, reports no line numbers and silently ignores
//!   unknown statements.
//! - `stl_io` 0.11 reads binary files that begin with `solid` as text and stops after the first solid.
//! - `ply-rs-bw` 4.0.1 reads text in lines instead of tokens and refuses byte-order marks, blank
//!   header lines and whole numbers written as decimals.
//! - `gltf-json` 1.4.1 refuses a file for a single bad material and for whole numbers written as
//!   `3.0`; `gltf` panics if a mesh refers to a missing accessor.
//!
//! # Memory
//!
//! Memory use is bounded by the actual size of a file, not by the counts that it declares. A file
//! can have at most [`MAX_BYTES`] bytes and [`MAX_FACES`] objects of at most [`BYTES_PER_TRIANGLE`]
//! bytes per triangle; polygons take memory in proportion to their vertices. A mesh that a glTF file
//! places many times takes memory for each of its triangles, as if it were written out.

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

pub use builder::{BYTES_PER_TRIANGLE, MAX_FACES, MAX_SPLIT_VERTICES, MAX_VERTICES};
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
        "{}: unknown file format: neither the extension nor the content is that of a scene file ({}){}",
        .path.display(),
        names(),
        hint(.path)
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

/// Returns what else is known about a file of an unknown format.
fn hint(path: &Path) -> &'static str {
    let is_aff = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("aff"));
    match is_aff {
        true => "; AFF, the Animated File Format of BART, is another format than NFF",
        false => "",
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
