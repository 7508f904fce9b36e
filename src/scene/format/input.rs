//! The input of a reader: the bytes of a file, and the files that it refers to.

use crate::progress::{Cancelled, Progress};
use std::io::{self, Read};
use std::path::{Component, Path};

/// Maximum size of a file in bytes.
pub const MAX_BYTES: u64 = 4 << 30;

/// Bytes between two checks for cancellation.
const CHUNK: u64 = 16 << 20;

/// The bytes of a file, and the folder in which the files it refers to are found.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    pub bytes: &'a [u8],
    /// The file's folder; `None` for bytes that do not come from a file.
    pub folder: Option<&'a Path>,
}

impl<'a> From<&'a [u8]> for Input<'a> {
    fn from(bytes: &'a [u8]) -> Self {
        let folder = None;
        Input { bytes, folder }
    }
}

/// Why a file that another file refers to could not be read.
#[derive(Debug, thiserror::Error)]
pub enum SiblingError {
    #[error("the path leads outside the scene file's folder")]
    Elsewhere,
    #[error(transparent)]
    Io(#[from] io::Error),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Input<'_> {
    /// Reads a file that this file refers to, by its path relative to the folder. Never reads
    /// anything outside the folder, whatever the path and whatever links there are.
    ///
    /// # Errors
    /// The path leads outside the folder, the file cannot be read or is too large, or cancellation.
    pub fn read_sibling(&self, name: &str, progress: &Progress) -> Result<Vec<u8>, SiblingError> {
        let folder = self.folder.ok_or(SiblingError::Elsewhere)?;
        // Files written on Windows may use backslashes.
        let name = name.replace('\\', "/");
        let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !Path::new(&name).components().all(inside) {
            return Err(SiblingError::Elsewhere);
        }
        let folder = folder.canonicalize()?;
        let path = folder.join(&name).canonicalize()?;
        if !path.starts_with(&folder) {
            return Err(SiblingError::Elsewhere);
        }
        // Reading a pipe might block forever.
        if !path.is_file() {
            return Err(io::Error::other("not a file").into());
        }
        match read_whole(&path, progress)? {
            Ok(bytes) => Ok(bytes),
            Err(cancelled) => Err(cancelled.into()),
        }
    }
}

/// Reads all bytes of a file.
///
/// # Errors
/// The file cannot be read or is larger than [`MAX_BYTES`]. The inner error is cancellation.
pub(super) fn read_whole(
    path: &Path,
    progress: &Progress,
) -> io::Result<Result<Vec<u8>, Cancelled>> {
    let mut file = std::fs::File::open(path)?;
    let too_large = || io::Error::other(format!("larger than {} GiB", MAX_BYTES >> 30));
    let length = file.metadata()?.len();
    if length > MAX_BYTES {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length as usize)?;
    loop {
        if let Err(cancelled) = progress.check() {
            return Ok(Err(cancelled));
        }
        if (&mut file).take(CHUNK).read_to_end(&mut bytes)? == 0 {
            return Ok(Ok(bytes));
        }
        // Devices and pipes report no length.
        if bytes.len() as u64 > MAX_BYTES {
            return Err(too_large());
        }
        progress.set(bytes.len() as f64 / length.max(1) as f64);
    }
}
