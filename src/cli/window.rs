//! `bspscope [SCENE]`: the window, or the same job without one.

use super::args::WindowArgs;
use super::{Outcome, measure, output, render, resolve};
use crate::files;
use crate::report::{Report, write_summary};
use anyhow::{Context, Result};
use image::ImageFormat;
use std::io::Write;

/// What is shown where no scene was asked for.
const FIRST_SCENE: &str = "balls";

pub fn run(args: &WindowArgs) -> Result<Outcome> {
    let Some(why) = open(args)? else {
        return Ok(Outcome::Done);
    };
    // Without a standard error stream there is nobody to tell.
    let _ = writeln!(
        std::io::stderr(),
        "bspscope: {why}; measuring, and rendering to a file, without it"
    );
    without_window(args)
}

/// Opens the window and waits until it is closed; where there can be none, says why.
#[cfg(feature = "gui")]
fn open(args: &WindowArgs) -> Result<Option<String>> {
    use crate::gui::{GuiError, StartOptions};
    use crate::scene::{SceneRequest, SceneSource};

    let mut start = StartOptions::default();
    // The window shows one method at a time.
    let methods = resolve::methods(&args.methods.method);
    start.build = resolve::builds(&methods, &args.build)?.remove(0);
    start.render = resolve::render(start.render.camera, &args.trace, &args.picture);
    start.scene = SceneRequest {
        source: SceneSource::parse(scene_text(args)),
        cylinders: args.cylinders.cylinders,
    };
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
fn open(_: &WindowArgs) -> Result<Option<String>> {
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
    let settings = resolve::render(*scene.camera(), &args.trace, &args.picture);
    settings.view()?;
    let mut runs = Vec::new();
    let mut last = None;
    for build in &builds {
        let measured = measure::run_of(&scene, build, &settings)?;
        runs.push(measured.measurement);
        last = Some(measured.picture);
    }
    let report = Report::new(&scene, &request, runs);
    output::write_to(None, |out| write_summary(&report, out))?;

    let picture = last.context("there is at least one method")?;
    let bytes = render::encoded(&picture, ImageFormat::Png)?;
    let (path, mut file) = output::create_free(&files::stem(scene.name()), "png")?;
    file.write_all(&bytes)
        .with_context(|| path.display().to_string())?;
    output::write_to(None, |out| writeln!(out, "Picture: {}", path.display()))?;
    Ok(Outcome::Done)
}
