//! `bspscope measure`: measures every parameter of the paper for a scene.

use super::args::MeasureArgs;
use super::outcome::Outcome;
use super::{bar, failures, output, resolve};
use crate::measure::{MeasureError, Measured, measure};
use crate::present::report::{Failure, Report};
use crate::scene::Scene;
use crate::setup::Setup;
use anyhow::Result;

pub fn run(args: &MeasureArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let setups = args.settings.setups(&args.scene)?;
    let scene = resolve::scene_in_view(&setups[0])?;
    let (runs, failures) = each(&scene, &setups)?;
    let runs = runs.into_iter().map(|measured| measured.measurement);
    let report = Report {
        failures,
        ..Report::new(&scene, &setups[0].scene, runs.collect())
    };
    output::write_report(&report, &args.report)?;
    Ok(Outcome::Done)
}

/// Measures setups of a scene. One whose tree is too large does not hide the others.
///
/// # Errors
/// No setup could be measured.
pub fn each(scene: &Scene, setups: &[Setup]) -> Result<(Vec<Measured>, Vec<Failure>)> {
    let (mut runs, mut failed) = (Vec::new(), Vec::new());
    for setup in setups {
        match run_or_failure(scene, setup)? {
            Ok(measured) => runs.push(measured),
            Err(failure) => failed.push(failure),
        }
    }
    failures::check_any(&runs, &failed)?;
    Ok((runs, failed))
}

/// Measures a setup under a progress bar. A tree that is too large is a failure of this setup alone. It is
/// also printed to standard error, because not every report format has a place for it.
pub fn run_or_failure(
    scene: &Scene,
    setup: &Setup,
) -> Result<std::result::Result<Measured, Failure>> {
    let measured = bar::with_bar(&stage(scene, setup), |progress| {
        match measure(scene, &setup.build, &setup.render, progress) {
            Err(error) if error.is_too_large() => Ok(Err(Failure {
                method: setup.build.method.name,
                reason: error.to_string(),
            })),
            result => result.map(Ok),
        }
    });
    let measured: std::result::Result<std::result::Result<Measured, _>, MeasureError> = measured;
    let measured = measured?;
    if let Ok(measured) = &measured {
        resolve::warn_of_tree(&measured.tree, setup);
    }
    Ok(measured)
}

/// Returns the text beside the bar of a measurement.
pub fn stage(scene: &Scene, setup: &Setup) -> String {
    let method = setup.build.method.name;
    format!("{}, {method}: building, tracing, counting", scene.name())
}
