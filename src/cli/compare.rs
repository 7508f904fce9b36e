//! `bspscope compare`: compares two trees of a scene, but only under equal conditions.

use super::args::CompareArgs;
use super::outcome::Outcome;
use super::{failures, measure, output, resolve};
use crate::measure::{Measured, unequal};
use crate::present::report::{Failure, Report};
use crate::scene::Scene;
use crate::setup::{Edits, Setup};
use anyhow::{Result, anyhow};

pub fn run(args: &CompareArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let shared = args.settings.setup(&args.scene)?;
    let of_side = |edits: &Edits| edits.apply(&shared).map_err(|reason| anyhow!(reason));
    let (of_a, of_b) = (of_side(&args.a)?, of_side(&args.b)?);
    let scene = resolve::scene(&of_a.scene)?;
    let other = match of_a.scene == of_b.scene {
        true => None,
        false => Some(resolve::scene(&of_b.scene)?),
    };
    let scene_of_b = other.as_ref().unwrap_or(&scene);
    of_a.render.view(&scene)?;
    of_b.render.view(scene_of_b)?;
    let (a, b) = match (
        measure::run_or_failure(&scene, &of_a)?,
        measure::run_or_failure(scene_of_b, &of_b)?,
    ) {
        (Ok(a), Ok(b)) => (a, b),
        (a, b) => return one_alone([(&scene, &of_a, a), (scene_of_b, &of_b, b)], args),
    };
    let reasons = unequal((&a.measurement, &a.picture), (&b.measurement, &b.picture));
    if !reasons.is_empty() {
        output::write_to(None, |out| {
            writeln!(out, "A and B are not comparable:")?;
            reasons
                .iter()
                .try_for_each(|reason| writeln!(out, "- {reason}"))
        })?;
        return Ok(Outcome::CheckFailed);
    }
    let report = Report {
        per_kind: args.per_kind,
        ..Report::new(&scene, &of_a.scene, vec![a.measurement, b.measurement])
    };
    output::write_report(&report, &args.report)?;
    Ok(Outcome::Done)
}

/// Reports what could be measured of two trees that cannot be compared, because one is too large.
fn one_alone(
    sides: [(&Scene, &Setup, std::result::Result<Measured, Failure>); 2],
    args: &CompareArgs,
) -> Result<Outcome> {
    let (mut runs, mut failed) = (Vec::new(), Vec::new());
    for (scene, setup, result) in sides {
        match result {
            Ok(measured) => runs.push((scene, setup, measured.measurement)),
            Err(failure) => failed.push(failure),
        }
    }
    failures::check_any(&runs, &failed)?;
    for (scene, setup, measurement) in runs {
        let report = Report {
            per_kind: args.per_kind,
            failures: failed.clone(),
            ..Report::new(scene, &setup.scene, vec![measurement])
        };
        output::write_report(&report, &args.report)?;
    }
    Ok(Outcome::CheckFailed)
}
