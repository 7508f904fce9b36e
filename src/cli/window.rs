//! `bspscope [SCENE]`: the window, or the same job without one.

use super::args::WindowArgs;
use super::outcome::Outcome;
use super::{measure, output, resolve};
use crate::files;
use crate::present::export;
use crate::present::report::{Report, write_summary};
use crate::scene::{Scene, SceneRequest};
use crate::structure::BuildSettings;
use crate::trace::RenderSettings;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use image::ImageFormat;
use std::io::Write;
use std::path::{Path, PathBuf};

/// What is shown where no scene was asked for.
const FIRST_SCENE: &str = "balls";

pub fn run(args: &WindowArgs) -> Result<Outcome> {
    let workspace = workspace(args)?;
    let Some(why) = open(args, workspace.clone())? else {
        return Ok(Outcome::Done);
    };
    // Without a standard error stream there is nobody to tell.
    let _ = writeln!(
        std::io::stderr(),
        "bspscope: {why}; measuring, and rendering to a file, without it"
    );
    match workspace {
        Some((_, workspace)) => workspace_without_window(&workspace),
        None => without_window(args),
    }
}

/// The workspace asked for, if it is one.
fn workspace(args: &WindowArgs) -> Result<Option<(PathBuf, Workspace)>> {
    let path = args.scene.as_deref().map(Path::new);
    let Some(path) = path.filter(|path| Workspace::is_path(path)) else {
        return Ok(None);
    };
    if !is_plain(args) {
        bail!(
            "{}: a workspace has its own settings; open it without options",
            path.display()
        );
    }
    let path = std::path::absolute(path)?;
    let workspace = Workspace::read(&path)?;
    if let Some(scene) = workspace.missing_scene() {
        bail!(
            "{}: its scene is not there: {}",
            path.display(),
            scene.display()
        );
    }
    Ok(Some((path, workspace)))
}

/// Whether nothing was set.
fn is_plain(args: &WindowArgs) -> bool {
    let WindowArgs {
        scene: _,
        lesson: _,
        cylinders,
        methods,
        build,
        trace,
        picture,
    } = args;
    let plain = WindowArgs::plain();
    methods.method.is_empty()
        && *cylinders == plain.cylinders
        && *build == plain.build
        && *trace == plain.trace
        && *picture == plain.picture
}

/// Opens the window and waits until it is closed; where there can be none, says why.
#[cfg(feature = "gui")]
fn open(args: &WindowArgs, workspace: Option<(PathBuf, Workspace)>) -> Result<Option<String>> {
    use crate::gui::{GuiError, StartOptions};
    use crate::scene::SceneSource;
    use crate::setup::Setup;

    let mut start = StartOptions::default();
    // The window shows one method at a time.
    let methods = resolve::methods(&args.methods.method);
    start.setup = Setup {
        scene: SceneRequest {
            source: SceneSource::parse(scene_text(args)),
            cylinders: args.cylinders.cylinders,
        },
        build: resolve::builds(&methods, &args.build)?.remove(0),
        render: resolve::render(&args.trace, &args.picture),
    };
    start.last_session = args.scene.is_none() && args.lesson.is_none() && is_plain(args);
    start.workspace = workspace;
    let lesson = args.lesson.as_deref().map(crate::lesson::Lesson::open);
    start.lesson = lesson.transpose()?;
    match crate::gui::run(start) {
        Ok(()) => Ok(None),
        Err(GuiError::NoDisplay(why)) => Ok(Some(format!("no display ({why})"))),
        Err(GuiError::NoGraphics(why)) => Ok(Some(format!("no graphics adapter ({why})"))),
        Err(error @ GuiError::Ended(_)) => Err(error.into()),
    }
}

#[cfg(not(feature = "gui"))]
fn open(_: &WindowArgs, _: Option<(PathBuf, Workspace)>) -> Result<Option<String>> {
    Ok(Some("this build has no window".into()))
}

/// The scene asked for, or the first one.
fn scene_text(args: &WindowArgs) -> &str {
    args.scene.as_deref().unwrap_or(FIRST_SCENE)
}

/// Δ and Λ of the methods, and the picture in a file of its own.
fn without_window(args: &WindowArgs) -> Result<Outcome> {
    let builds = resolve::builds(&resolve::methods(&args.methods.method), &args.build)?;
    let (request, scene) = resolve::scene(scene_text(args), &args.cylinders)?;
    let settings = resolve::render(&args.trace, &args.picture);
    summary(&request, &scene, builds, &settings)
}

/// The same of a workspace's trees; the second as the first was traced.
fn workspace_without_window(workspace: &Workspace) -> Result<Outcome> {
    let request = SceneRequest {
        source: workspace.scene.source.clone(),
        cylinders: workspace.a.cylinders,
    };
    let scene = resolve::load_scene(&request)?;
    let settings = workspace.a.picture.with(workspace.camera);
    let trees = [Some(&workspace.a), workspace.b.as_ref()];
    let builds = trees.into_iter().flatten().map(|t| t.build.clone());
    summary(&request, &scene, builds.collect(), &settings)
}

fn summary(
    request: &SceneRequest,
    scene: &Scene,
    builds: Vec<BuildSettings>,
    settings: &RenderSettings,
) -> Result<Outcome> {
    settings.view(scene)?;
    let mut runs = Vec::new();
    let mut last = None;
    for build in &builds {
        let measured = measure::run_of(scene, build, settings)?;
        runs.push(measured.measurement);
        last = Some(measured.picture);
    }
    let report = Report::new(scene, request, runs);
    output::write_to(None, |out| write_summary(&report, out))?;

    let picture = last.context("there is at least one method")?;
    let bytes = export::encoded(&picture, ImageFormat::Png)?;
    let (path, mut file) = output::create_free(&files::stem(scene.name()), "png")?;
    file.write_all(&bytes)
        .with_context(|| path.display().to_string())?;
    output::write_to(None, |out| writeln!(out, "Picture: {}", path.display()))?;
    Ok(Outcome::Done)
}
