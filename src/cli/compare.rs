//! `bspscope compare`: two trees of a scene beside each other, under equal conditions or not at all.

use super::args::CompareArgs;
use super::outcome::Outcome;
use super::{measure, output, resolve};
use crate::measure::unequal;
use crate::present::report::Report;
use anyhow::Result;

pub fn run(args: &CompareArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let (request, scene) = resolve::scene(&args.scene.scene, &args.scene.cylinders)?;
    let render = resolve::render(&args.trace, &args.picture);
    render.view(&scene)?;
    let a = measure::run_of(&scene, &args.a, &render)?;
    let b = measure::run_of(&scene, &args.b, &render)?;
    let reasons = unequal((&a.measurement, &a.picture), (&b.measurement, &b.picture));
    if !reasons.is_empty() {
        output::write_to(None, |out| {
            writeln!(out, "A and B cannot be compared:")?;
            reasons
                .iter()
                .try_for_each(|reason| writeln!(out, "- {reason}"))
        })?;
        return Ok(Outcome::CheckFailed);
    }
    let report = Report {
        per_kind: args.per_kind,
        ..Report::new(&scene, &request, vec![a.measurement, b.measurement])
    };
    output::write_report(&report, &args.report)?;
    Ok(Outcome::Done)
}
