//! What a reader reads: a file's bytes, and the files beside it.

use crate::progress::{Cancelled, Progress};
use std::io::{self, Read};
use std::path::{Component, Path};

/// The most bytes of a file.
pub const MOST_BYTES: u64 = 4 << 30;

/// Bytes between two looks at whether the task was cancelled.
const CHUNK: u64 = 16 << 20;

/// A file's bytes; files that it names are found in its folder and below.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    pub bytes: &'a [u8],
    /// The file's folder; `None` if there is no file, and nothing beside it.
    pub folder: Option<&'a Path>,
}

impl<'a> From<&'a [u8]> for Input<'a> {
    fn from(bytes: &'a [u8]) -> Self {
        let folder = None;
        Input { bytes, folder }
    }
}

/// Why a file that another one names was not read.
#[derive(Debug, thiserror::Error)]
pub enum BesideError {
    #[error("it is neither in the file's folder nor below")]
    Elsewhere,
    #[error(transparent)]
    Io(#[from] io::Error),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl Input<'_> {
    /// Reads a file that this one names, relative to its folder. Whatever the name is, and whatever
    /// links there are, nothing outside that folder is read.
    ///
    /// # Errors
    /// It lies elsewhere, cannot be read or is too large; cancellation.
    pub fn beside(&self, name: &str, progress: &Progress) -> Result<Vec<u8>, BesideError> {
        let folder = self.folder.ok_or(BesideError::Elsewhere)?;
        // Written on Windows, read anywhere.
        let name = name.replace('\\', "/");
        let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        if !Path::new(&name).components().all(inside) {
            return Err(BesideError::Elsewhere);
        }
        let folder = folder.canonicalize()?;
        let path = folder.join(&name).canonicalize()?;
        if !path.starts_with(&folder) {
            return Err(BesideError::Elsewhere);
        }
        // Reading a pipe might wait for ever.
        if !path.is_file() {
            return Err(io::Error::other("not a file").into());
        }
        match read_whole(&path, progress)? {
            Ok(bytes) => Ok(bytes),
            Err(cancelled) => Err(cancelled.into()),
        }
    }
}

/// All bytes of a file.
///
/// # Errors
/// It cannot be read, or is larger than [`MOST_BYTES`]; inside, cancellation.
pub(super) fn read_whole(
    path: &Path,
    progress: &Progress,
) -> io::Result<Result<Vec<u8>, Cancelled>> {
    let mut file = std::fs::File::open(path)?;
    let too_large = || io::Error::other(format!("larger than {} GiB", MOST_BYTES >> 30));
    let length = file.metadata()?.len();
    if length > MOST_BYTES {
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
        // Devices and pipes tell no length.
        if bytes.len() as u64 > MOST_BYTES {
            return Err(too_large());
        }
        progress.set(bytes.len() as f64 / length.max(1) as f64);
    }
}
