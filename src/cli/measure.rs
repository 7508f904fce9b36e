//! `bspscope measure`: measures every parameter of the paper for a scene.

use super::args::MeasureArgs;
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::{Measured, measure};
use crate::present::report::Report;
use crate::scene::Scene;
use crate::setup::Setup;
use crate::structure::BuildSettings;
use crate::trace::RenderSettings;
use anyhow::Result;

pub fn run(args: &MeasureArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let setups = args.settings.setups(&args.scene)?;
    let Setup {
        scene: request,
        render,
        ..
    } = &setups[0];
    let scene = resolve::scene(request)?;
    // Report an invalid size before a tree is built for it.
    render.view(&scene)?;
    let mut runs = Vec::new();
    for Setup { build, .. } in &setups {
        runs.push(run_of(&scene, build, render)?.measurement);
    }
    let report = Report::new(&scene, request, runs);
    output::write_report(&report, &args.report)?;
    Ok(Outcome::Done)
}

/// Measures one method under a progress bar.
pub fn run_of(scene: &Scene, build: &BuildSettings, render: &RenderSettings) -> Result<Measured> {
    let stage = format!(
        "{}, {}: building, tracing, counting",
        scene.name(),
        build.method.name
    );
    Ok(bar::with_bar(&stage, |progress| {
        measure(scene, build, render, progress)
    })?)
}
