//! Where output goes: standard output, or a file that is complete or not touched at all.

use super::args::ReportArgs;
use super::resolve;
use crate::report::{Report, WRITERS, Writer};
use anyhow::{Context, Result, bail};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Refuses a place where no file can be written, before work is done for it.
pub fn check_place(file: Option<&Path>) -> Result<()> {
    let Some(path) = file.filter(|path| path.as_os_str() != "-") else {
        return Ok(());
    };
    if path.is_dir() {
        bail!("{}: is a folder", path.display());
    }
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            bail!(
                "{}: there is no folder {}",
                path.display(),
                folder.display()
            )
        }
        _ => Ok(()),
    }
}

/// Writes to a file, or to standard output for `-` and for nothing.
pub fn write_to(
    file: Option<&Path>,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<()> {
    match file {
        Some(path) if path.as_os_str() != "-" => write_file(path, write),
        _ => {
            let mut out = BufWriter::new(io::stdout().lock());
            write(&mut out)?;
            Ok(out.flush()?)
        }
    }
}

/// Writes a report in the form and to the place asked for.
pub fn write_report(report: &Report, args: &ReportArgs) -> Result<()> {
    write_with(WRITERS, report, args)
}

/// Writes with the one of these writers that is asked for, to the place asked for.
pub fn write_with<R: ?Sized>(
    writers: &'static [Writer<R>],
    report: &R,
    args: &ReportArgs,
) -> Result<()> {
    let file = args.output.as_deref();
    let writer = resolve::writer(writers, args.format.as_deref(), file);
    write_to(file, |out| (writer.write)(report, out))
}

/// Writes a file beside its place and moves it there when it is complete: whatever was there stays
/// until then. Devices and pipes are written to as they are.
pub fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    replace(path, write).with_context(|| path.display().to_string())
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
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

/// Creates a file under the first free name: `stem.extension`, `stem-1.extension`, …
pub fn create_free(stem: &str, extension: &str) -> Result<(PathBuf, File)> {
    let mut number = 0;
    loop {
        let path = PathBuf::from(match number {
            0 => format!("{stem}.{extension}"),
            n => format!("{stem}-{n}.{extension}"),
        });
        match File::create_new(&path) {
            Ok(file) => return Ok((path, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            Err(error) => return Err(error).with_context(|| path.display().to_string()),
        }
    }
}
