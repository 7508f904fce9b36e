//! Resolves arguments to a scene, a tree and a writer.

use super::bar;
use crate::present::report::{Failure, Writer};
use crate::scene::format::{FORMATS, FormatError};
use crate::scene::{LoadError, NoteKind, Scene, SceneRequest, SceneSource, builtin, load};
use crate::setup::Setup;
use crate::structure::tree_file::{self, Fault};
use crate::structure::{BuildError, Builder, Tree, build};
use crate::trace::{RenderSettings, thread_pool};
use anyhow::{Result, bail};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Loads a scene, with a progress bar.
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
                "{}: neither a file nor a generator with a valid size; the generators are {}",
                path.display(),
                names.join(", ")
            )
        }
        Err(error) => Err(error.into()),
    }
}

/// Loads the scene of a setup. Reports an invalid camera or size before a tree is built for it.
pub fn scene_in_view(setup: &Setup) -> Result<Scene> {
    let scene = scene(&setup.scene)?;
    setup.render.view(&scene)?;
    Ok(scene)
}

/// Builds the tree of a setup, with a progress bar.
pub fn tree(scene: &Scene, setup: &Setup) -> Result<Tree> {
    let pool = thread_pool(setup.render.threads)?;
    let method = setup.build.method.name;
    let stage = format!("{}, {method}: building the tree", scene.name());
    let tree = bar::with_bar(&stage, |progress| {
        pool.install(|| build(scene, &setup.build, progress))
    })?;
    warn_of_tree(&tree, setup);
    Ok(tree)
}

/// Prints to standard error what is wrong with a tree that was read from a file.
pub fn warn_of_tree(tree: &Tree, setup: &Setup) {
    let Builder::File(file) = setup.build.method.builder else {
        return;
    };
    let mut reasons: Vec<String> = tree.faults().list().iter().map(Fault::to_string).collect();
    if let SceneSource::File(scene) = &setup.scene.source
        && tree_file::is_of_another_scene(file, scene)
    {
        reasons.insert(0, format!("made for a file other than {}", scene.display()));
    }
    let mut out = std::io::stderr().lock();
    for reason in reasons {
        // Without a standard error stream there is nobody to warn.
        let _ = writeln!(out, "bspscope: {}: {reason}", file.display());
    }
}

/// Builds the tree of a setup. One that is too large is a failure of this setup alone.
pub fn tree_or_failure(scene: &Scene, setup: &Setup) -> Result<std::result::Result<Tree, Failure>> {
    match tree(scene, setup) {
        Ok(tree) => Ok(Ok(tree)),
        Err(error) => {
            let reason = error.downcast::<BuildError>()?;
            if !reason.is_too_large() {
                return Err(reason.into());
            }
            Ok(Err(Failure {
                method: setup.build.method.name,
                reason: reason.to_string(),
            }))
        }
    }
}

/// Prints a warning to standard error if the chosen precision cannot represent the scene, in the words in
/// which `measure` reports the precision.
pub fn warn_of_precision(scene: &Scene, render: &RenderSettings) {
    if let Some(warning) = render.precision_for(scene).warning() {
        // Without a standard error stream there is nobody to warn.
        let _ = writeln!(
            std::io::stderr().lock(),
            "bspscope: {}: {warning}",
            scene.name()
        );
    }
}

/// Prints what was skipped, changed or defaulted in a file to standard error. The whole load report
/// is part of the output of `measure`.
fn tell(file: &str, scene: &Scene) {
    let mut out = std::io::stderr().lock();
    for note in scene.notes() {
        if !matches!(note.kind, NoteKind::Read | NoteKind::Remark) {
            // Without a standard error stream there is nobody to tell.
            let _ = writeln!(out, "bspscope: {file}: {note}");
        }
    }
}

/// Returns whether the argument looks like a file: it has a folder or the extension of a scene
/// file.
fn looks_like_a_file(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    path.components().count() > 1
        || extension.is_some_and(|e| {
            FORMATS
                .iter()
                .any(|format| format.extensions.iter().any(|known| e == *known))
        })
}

/// Returns the writer by name, else by the extension of the file, else the first.
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
