//! Files that are written whole or not at all, and fingerprints of files.

use sha2::{Digest, Sha256};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Writes a file beside its place and moves it there when it is complete: whatever was there stays
/// until then. Devices and pipes are written to as they are.
///
/// # Errors
/// Those of the file system, and those of `write`.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // A link stays a link: what it leads to is replaced.
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
        // The error that matters is the first one.
        let _ = fs::remove_file(&beside);
    }
    result
}

/// A name beside a file that nothing else uses.
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

/// A scene's name as the name of a file: `balls:3` becomes `balls-3`; `scene` where nothing is left.
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

/// The SHA-256 of a file's bytes in hexadecimal digits, as `sha256sum` prints it.
///
/// # Errors
/// Those of the file system.
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
    fn a_file_that_could_not_be_written_leaves_the_one_before() {
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
