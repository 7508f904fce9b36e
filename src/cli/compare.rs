//! `bspscope compare`: compares two trees of a scene, but only under equal conditions.

use super::args::CompareArgs;
use super::outcome::Outcome;
use super::{measure, output, resolve};
use crate::measure::unequal;
use crate::present::report::Report;
use crate::setup::Edits;
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
    let a = measure::run_of(&scene, &of_a)?;
    let b = measure::run_of(scene_of_b, &of_b)?;
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
