//! `bspscope [SCENE]`: the window, or the same job without one.

use super::args::WindowArgs;
use super::outcome::Outcome;
use super::{measure, output, resolve};
use crate::files;
use crate::present::export;
use crate::present::report::{Report, write_summary};
use crate::setup::Setup;
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
    if !args.settings.is_empty() {
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

/// Opens the window and waits until it is closed; where there can be none, says why.
#[cfg(feature = "gui")]
fn open(args: &WindowArgs, workspace: Option<(PathBuf, Workspace)>) -> Result<Option<String>> {
    use crate::gui::{GuiError, StartOptions};

    let mut start = StartOptions::default();
    // The window shows one method at a time.
    start.setup = args.settings.setup(scene_text(args))?;
    start.last_session = args.scene.is_none() && args.lesson.is_none() && args.settings.is_empty();
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
    summary(&args.settings.setups(scene_text(args))?)
}

/// The same of a workspace's setups.
fn workspace_without_window(workspace: &Workspace) -> Result<Outcome> {
    let setups = [Some(&workspace.a), workspace.b.as_ref()];
    summary(&setups.into_iter().flatten().cloned().collect::<Vec<_>>())
}

/// The summary of setups of one scene; all are rendered as the first.
fn summary(setups: &[Setup]) -> Result<Outcome> {
    let first = setups.first().context("there is at least one method")?;
    let scene = &resolve::scene(&first.scene)?;
    first.render.view(scene)?;
    let mut runs = Vec::new();
    let mut last = None;
    for Setup { build, .. } in setups {
        let measured = measure::run_of(scene, build, &first.render)?;
        runs.push(measured.measurement);
        last = Some(measured.picture);
    }
    let report = Report::new(scene, &first.scene, runs);
    output::write_to(None, |out| write_summary(&report, out))?;

    let picture = last.context("there is at least one method")?;
    let bytes = export::encoded(&picture, ImageFormat::Png)?;
    let (path, mut file) = output::create_free(&files::stem(scene.name()), "png")?;
    file.write_all(&bytes)
        .with_context(|| path.display().to_string())?;
    output::write_to(None, |out| writeln!(out, "Picture: {}", path.display()))?;
    Ok(Outcome::Done)
}
