//! `bspscope paper`: the paper's tables next to measured values.

use super::args::PaperArgs;
use super::outcome::Outcome;
use super::{bar, output};
use crate::jobs::RepeatPaper;
use crate::measure::paper::{Conditions, PaperScene, SCENES};
use crate::present::report::paper::PAPER_WRITERS;
use anyhow::Result;

pub fn run(args: &PaperArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let render = args.settings.setup("")?.render;
    let conditions = Conditions {
        resolution: [render.width, render.height],
        threads: render.threads,
    };
    let scenes: Vec<&'static PaperScene> = if args.scenes.is_empty() {
        SCENES.iter().collect()
    } else {
        args.scenes.clone()
    };
    let job = RepeatPaper { scenes, conditions };
    let results = bar::follow(job, |_| Ok(()))?;
    output::write_with(PAPER_WRITERS, &results[..], &args.report)?;
    let is_comparable = |reasons: &Vec<_>| reasons.is_empty();
    if results
        .iter()
        .all(|r| r.unequal.as_ref().is_some_and(is_comparable))
    {
        Ok(Outcome::Done)
    } else {
        Ok(Outcome::CheckFailed)
    }
}
