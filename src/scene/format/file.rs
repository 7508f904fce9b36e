//! Reading a file of any format.

use super::choose;
use super::error::{ReadError, located};
use super::input::{self, Input};
use super::registry::names;
use crate::progress::{Cancelled, Progress};
use crate::scene::note::{Note, NoteKind};
use crate::scene::parts::SceneParts;
use std::path::{Path, PathBuf};

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
