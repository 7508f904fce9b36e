//! `bspscope measure`: measures every parameter of the paper for a scene.

use super::args::MeasureArgs;
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::{Measured, measure};
use crate::present::report::Report;
use crate::scene::Scene;
use crate::setup::Setup;
use anyhow::Result;

pub fn run(args: &MeasureArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let setups = args.settings.setups(&args.scene)?;
    let scene = resolve::scene_in_view(&setups[0])?;
    let mut runs = Vec::new();
    for setup in &setups {
        runs.push(run_of(&scene, setup)?.measurement);
    }
    let report = Report::new(&scene, &setups[0].scene, runs);
    output::write_report(&report, &args.report)?;
    Ok(Outcome::Done)
}

/// Measures a setup under a progress bar.
pub fn run_of(scene: &Scene, setup: &Setup) -> Result<Measured> {
    Ok(bar::with_bar(&stage(scene, setup), |progress| {
        measure(scene, &setup.build, &setup.render, progress)
    })?)
}

/// Returns the text beside the bar of a measurement.
pub fn stage(scene: &Scene, setup: &Setup) -> String {
    let method = setup.build.method.name;
    format!("{}, {method}: building, tracing, counting", scene.name())
}
