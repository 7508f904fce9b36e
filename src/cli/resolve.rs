//! What the arguments come to: a scene, settings, a writer.

use super::args::{BuildArgs, CameraArgs, CylinderArgs, PictureArgs, TraceArgs};
use super::bar;
use crate::present::report::Writer;
use crate::scene::format::{FORMATS, FormatError};
use crate::scene::{
    CameraOverride, LoadError, NoteKind, Scene, SceneRequest, SceneSource, builtin, load,
};
use crate::structure::{BuildSettings, Method};
use crate::trace::RenderSettings;
use anyhow::{Result, bail};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// The scene for what was typed, with the request that it answers.
pub fn scene(text: &str, cylinders: &CylinderArgs) -> Result<(SceneRequest, Scene)> {
    let request = SceneRequest {
        source: SceneSource::parse(text),
        cylinders: cylinders.cylinders,
    };
    let scene = load_scene(&request)?;
    Ok((request, scene))
}

/// The scene of a request, loaded under a progress bar.
pub fn load_scene(request: &SceneRequest) -> Result<Scene> {
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

/// Checked build settings for every method.
pub fn builds(methods: &[Method], args: &BuildArgs) -> Result<Vec<BuildSettings>> {
    let mut builds: Vec<_> = methods
        .iter()
        .map(|&method| BuildSettings {
            d_max: args.d_max,
            n_oilf: args.n_oilf,
            root_margin: args.rules.root_margin,
            overlap: args.rules.overlap,
            first_axis: args.rules.first_axis,
            memory_limit: args.rules.memory_limit.saturating_mul(1 << 20),
            ..BuildSettings::for_method(method)
        })
        .collect();
    for (name, value) in &args.rules.set {
        let mut known = false;
        for build in &mut builds {
            if build.method.constants.iter().any(|c| c.name == name) {
                build.constants.insert(name.clone(), *value);
                known = true;
            }
        }
        if !known {
            let methods: Vec<_> = methods.iter().map(|m| m.name).collect();
            bail!(
                "--set {name}: no chosen method ({}) has this setting; see 'bspscope methods'",
                methods.join(", ")
            );
        }
    }
    for build in &builds {
        build.check()?;
    }
    Ok(builds)
}

/// Render settings as asked for.
pub fn render(trace: &TraceArgs, picture: &PictureArgs) -> RenderSettings {
    let [width, height] = picture.resolution;
    let CameraArgs {
        from,
        at,
        up,
        angle,
    } = trace.camera;
    RenderSettings {
        camera: CameraOverride {
            from,
            at,
            up,
            angle,
        },
        width,
        height,
        d_arec: trace.d_arec,
        min_contribution: trace.cut_off,
        precision: trace.precision,
        kernel: trace.kernel,
        sampling: trace.sampling,
        threads: trace.threads,
        ..RenderSettings::default()
    }
}

/// The methods asked for, or the paper's.
pub fn methods(asked: &[Method]) -> Vec<Method> {
    if asked.is_empty() {
        Method::of_the_paper()
    } else {
        asked.to_vec()
    }
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
