//! Atomic file writes, names for files, and checksums.

use sha2::{Digest, Sha256};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Writes a file completely or not at all: writes a temporary file in the same folder and renames
/// it when it is complete. Devices and pipes are written to directly.
///
/// # Errors
/// I/O errors, and errors of `write`.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // A symbolic link is kept; its target is replaced.
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let existing = fs::metadata(path).ok();
    if existing.as_ref().is_some_and(|m| !m.is_file()) {
        let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
        write(&mut out)?;
        return out.flush();
    }
    let beside = beside(path)?;
    let result = (|| {
        let mut out = BufWriter::new(File::create_new(&beside)?);
        write(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        if let Some(existing) = existing {
            file.set_permissions(existing.permissions())?;
        }
        drop(file);
        fs::rename(&beside, path)
    })();
    if result.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&beside);
    }
    result
}

/// Returns the name of a temporary file in the same folder.
fn beside(path: &Path) -> io::Result<PathBuf> {
    let name = path
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not the name of a file"))?;
    Ok(path.with_file_name(format!(
        ".{}.{}.tmp",
        name.to_string_lossy(),
        std::process::id()
    )))
}

/// Converts the name of a scene to a file name: `balls:3` becomes `balls-3`. Returns `scene` if
/// nothing is left.
pub fn stem(name: &str) -> String {
    let stem: String = name
        .chars()
        .map(|c| match c {
            '-' | '_' | '.' => c,
            c if c.is_alphanumeric() => c,
            _ => '-',
        })
        .collect();
    let stem = stem.trim_start_matches('.');
    if stem.is_empty() {
        "scene".into()
    } else {
        stem.into()
    }
}

/// Returns the SHA-256 of a file in hexadecimal digits, as `sha256sum` prints it.
///
/// # Errors
/// I/O errors.
pub fn sha256(path: &Path) -> io::Result<String> {
    const BLOCK: usize = 1 << 16;
    let mut file = BufReader::with_capacity(BLOCK, File::open(path)?);
    let mut hash = Sha256::new();
    let mut block = vec![0; BLOCK];
    loop {
        match file.read(&mut block)? {
            0 => break,
            count => hash.update(&block[..count]),
        }
    }
    let digits = hash.finalize();
    Ok(digits.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_previous_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_whole(&path, |out| out.write_all(b"first")).unwrap();
        let broken = write_whole(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("broken off"))
        });
        assert!(broken.is_err());
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        // As `printf first | sha256sum` prints it.
        let known = "a7937b64b8caa58f03721bb6bacf5c78cb235febe0e70b1b84cd99541461a08e";
        assert_eq!(sha256(&path).unwrap(), known);
    }

    #[test]
    fn names_of_scenes_become_names_of_files() {
        for (name, expected) in [("balls:3", "balls-3"), ("../x", "-x"), ("", "scene")] {
            assert_eq!(stem(name), expected);
        }
    }
}
