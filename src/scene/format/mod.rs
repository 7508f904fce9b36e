//! Scene file formats. A format is one file here and one line in [`FORMATS`].

pub mod nff;

use super::SceneParts;
use crate::progress::{Cancelled, Progress};
use std::path::{Path, PathBuf};

/// A reader and a writer of one file format.
pub struct Format {
    /// Lower-case name, such as `nff`.
    pub name: &'static str,
    /// File name extensions, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// Reads a whole file's bytes.
    pub read: fn(&[u8], &Progress) -> Result<SceneParts, ReadError>,
    /// Writes the scene so that reading it back gives the identical scene.
    pub write: fn(&SceneParts, &mut dyn std::io::Write) -> std::io::Result<()>,
}

/// All formats; the first takes files of unknown extension.
pub static FORMATS: &[Format] = &[nff::FORMAT];

/// A mistake in a file, at a line counted from 1; the reader knows no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    #[error("{line}: expected {expected}, found {found}")]
    Syntax {
        line: usize,
        expected: String,
        found: String,
    },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Why a file gave no scene: `file:line: what was expected, what was found`.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    #[error("{}: {reason}", .path.display())]
    Io {
        path: PathBuf,
        reason: std::io::Error,
    },
    #[error("{}:{reason}", .path.display())]
    Read { path: PathBuf, reason: ReadError },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The format for a path, by its extension.
pub fn for_path(path: &Path) -> &'static Format {
    let extension = path
        .extension()
        .map(|e| e.to_string_lossy().to_ascii_lowercase());
    FORMATS
        .iter()
        .find(|f| {
            f.extensions
                .iter()
                .any(|e| Some(*e) == extension.as_deref())
        })
        .unwrap_or(&FORMATS[0])
}

/// Reads a scene file; the scene is named after the file's stem.
///
/// # Errors
/// The file cannot be read, holds a mistake, or the task was cancelled.
pub fn read_file(path: &Path, progress: &Progress) -> Result<SceneParts, FormatError> {
    let bytes = std::fs::read(path).map_err(|reason| FormatError::Io {
        path: path.to_owned(),
        reason,
    })?;
    match (for_path(path).read)(&bytes, progress) {
        Ok(mut parts) => {
            parts.name = path
                .file_stem()
                .map_or_else(String::new, |s| s.to_string_lossy().into_owned());
            Ok(parts)
        }
        Err(ReadError::Cancelled(c)) => Err(c.into()),
        Err(reason) => Err(FormatError::Read {
            path: path.to_owned(),
            reason,
        }),
    }
}
