//! Output to standard output, or to a file that is written completely or not at all.

use super::args::ReportArgs;
use super::resolve;
use crate::files;
use crate::present::report::{Report, WRITERS, Writer};
use anyhow::{Context, Result, bail};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Rejects a path that cannot be written to, before work is done for it.
pub fn check_place(file: Option<&Path>) -> Result<()> {
    let Some(path) = file.filter(|path| path.as_os_str() != "-") else {
        return Ok(());
    };
    if path.is_dir() {
        bail!("{}: this is a folder; expected a file", path.display());
    }
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            bail!(
                "{}: the folder {} does not exist",
                path.display(),
                folder.display()
            )
        }
        _ => Ok(()),
    }
}

/// Writes to a file, or to standard output for `-` or `None`.
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

/// Writes a report in the requested format to the requested file.
pub fn write_report(report: &Report, args: &ReportArgs) -> Result<()> {
    write_with(WRITERS, report, args)
}

/// Writes a report with the requested writer to the requested file.
pub fn write_with<R: ?Sized>(
    writers: &'static [Writer<R>],
    report: &R,
    args: &ReportArgs,
) -> Result<()> {
    let file = args.output.as_deref();
    let writer = resolve::writer(writers, args.format.as_deref(), file);
    write_to(file, |out| (writer.write)(report, out))
}

/// Writes a file completely, or leaves an existing file unchanged.
pub fn write_file(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    files::write_whole(path, write).with_context(|| path.display().to_string())
}

/// Creates a file with the first free name: `stem.extension`, `stem-1.extension`, …
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
