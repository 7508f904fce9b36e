//! `bspscope [SCENE]`: opens the window, or measures the scene on the terminal without a display.

use super::args::WindowArgs;
use super::outcome::Outcome;
use super::{measure, output, resolve};
use crate::present::export;
use crate::present::report::{Report, write_summary};
use crate::setup::Setup;
use crate::structure::tree_file::is_tree_file;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use image::ImageFormat;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The default scene.
const FIRST_SCENE: &str = "balls";

pub fn run(args: &WindowArgs) -> Result<Outcome> {
    check_picture(args.output.as_deref())?;
    let workspace = workspace(args)?;
    let Some(why) = open(args, workspace.clone())? else {
        return Ok(Outcome::Done);
    };
    // Standard error may be closed.
    let _ = writeln!(
        std::io::stderr(),
        "bspscope: {why}; measuring the scene instead{}",
        match args.output {
            Some(_) => "",
            None => " (to save the picture, add -o FILE.png)",
        }
    );
    let setups = match workspace {
        Some((_, workspace)) => [Some(workspace.a), workspace.b]
            .into_iter()
            .flatten()
            .collect(),
        None => args.settings.setups(scene_text(args))?,
    };
    summary(&setups, args.output.as_deref())
}

/// Rejects a picture file that cannot be written, before work is done for it.
fn check_picture(file: Option<&Path>) -> Result<()> {
    if let Some(path) = file
        && path
            .extension()
            .is_none_or(|e| !e.eq_ignore_ascii_case("png"))
    {
        bail!("{}: expected the extension .png", path.display());
    }
    output::check_place(file)
}

/// Reads the workspace to open, if the argument is one.
fn workspace(args: &WindowArgs) -> Result<Option<(PathBuf, Workspace)>> {
    if let Some(file) = args.scene.as_deref().filter(|text| is_tree_file(text)) {
        bail!("{file} is a tree; open it with its scene: bspscope SCENE --tree {file}");
    }
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
            "{}: the scene of this workspace does not exist: {}",
            path.display(),
            scene.display()
        );
    }
    Ok(Some((path, workspace)))
}

/// Opens the window and waits until it is closed. Returns the reason if there can be no window.
#[cfg(feature = "gui")]
fn open(args: &WindowArgs, workspace: Option<(PathBuf, Workspace)>) -> Result<Option<String>> {
    use crate::gui::{GuiError, StartOptions};

    let lesson = args.lesson.as_deref().map(crate::lesson::Lesson::open);
    let start = StartOptions {
        // The window shows one method at a time.
        setup: args.settings.setup(scene_text(args))?,
        last_session: args.scene.is_none() && args.lesson.is_none() && args.settings.is_empty(),
        workspace,
        lesson: lesson.transpose()?,
        ..StartOptions::default()
    };
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

/// Returns the scene argument, or the default scene.
fn scene_text(args: &WindowArgs) -> &str {
    args.scene.as_deref().unwrap_or(FIRST_SCENE)
}

/// Prints Δ and Λ of setups of one scene, and writes the picture of
/// the last to a file, if there is one.
fn summary(setups: &[Setup], file: Option<&Path>) -> Result<Outcome> {
    let first = setups.first().context("there is at least one method")?;
    let scene = &resolve::scene_in_view(first)?;
    let (runs, failures) = measure::each(scene, setups)?;
    let last = runs.last().map(|run| run.picture.clone());
    let runs = runs.into_iter().map(|measured| measured.measurement);
    let report = Report {
        failures,
        ..Report::new(scene, &first.scene, runs.collect())
    };
    output::write_to(None, |out| write_summary(&report, out))?;

    if let Some(file) = file {
        let picture = last.context("there is at least one method")?;
        let bytes = export::encoded(&picture, ImageFormat::Png)?;
        output::write_file(file, |out| out.write_all(&bytes))?;
        output::write_to(None, |out| writeln!(out, "Picture: {}", file.display()))?;
    }
    Ok(Outcome::Done)
}
