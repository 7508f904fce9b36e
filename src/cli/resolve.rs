//! What the arguments come to: a scene, a writer.

use super::bar;
use crate::present::report::Writer;
use crate::scene::format::{FORMATS, FormatError};
use crate::scene::{LoadError, NoteKind, Scene, SceneRequest, SceneSource, builtin, load};
use anyhow::{Result, bail};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// The scene of a request, loaded under a progress bar.
pub fn scene(request: &SceneRequest) -> Result<Scene> {
    let stage = format!("{}: loading", request.source);
    match bar::with_bar(&stage, |progress| load(request, progress)) {
        Ok(scene) => {
            if matches!(request.source, SceneSource::File(_)) {
                tell(&request.source.to_string(), &scene);
            }
            Ok(scene)
        }
        Err(LoadError::Format(FormatError::Io { path, reason }))
            if reason.kind() == ErrorKind::NotFound && !looks_like_a_file(&path) =>
        {
            let names: Vec<_> = builtin::BUILTINS.iter().map(|b| b.name).collect();
            bail!(
                "{}: no such file, and no generator of this name and size; generators are {}",
                path.display(),
                names.join(", ")
            )
        }
        Err(error) => Err(error.into()),
    }
}

/// Says on standard error what of a file is not as it was found; the whole load report is part of
/// `measure`'s.
fn tell(file: &str, scene: &Scene) {
    let mut out = std::io::stderr().lock();
    for note in scene.notes() {
        if !matches!(note.kind, NoteKind::Read | NoteKind::Remark) {
            // Without a standard error stream there is nobody to tell.
            let _ = writeln!(out, "bspscope: {file}: {note}");
        }
    }
}

/// Whether a user who typed this meant a file: it has a folder or the extension of a scene file.
fn looks_like_a_file(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    path.components().count() > 1
        || extension.is_some_and(|e| {
            FORMATS
                .iter()
                .any(|format| format.extensions.iter().any(|known| e == *known))
        })
}

/// The writer asked for by name, else by the file's extension, else the first.
pub fn writer<R: ?Sized>(
    writers: &'static [Writer<R>],
    name: Option<&str>,
    file: Option<&Path>,
) -> &'static Writer<R> {
    let extension = file
        .and_then(Path::extension)
        .map(|e| e.to_string_lossy().to_ascii_lowercase());
    writers
        .iter()
        .find(|writer| match name {
            Some(name) => writer.name == name,
            None => extension.as_deref() == Some(writer.extension),
        })
        .unwrap_or(&writers[0])
}
