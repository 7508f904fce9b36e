//! `bspscope paper`: the paper's tables next to measured values.

use super::args::PaperArgs;
use super::outcome::Outcome;
use super::{bar, output};
use crate::measure::paper::{Conditions, PaperScene, SCENES, reproduce};
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
    let mut results = Vec::new();
    for scene in scenes {
        let stage = format!("{}: both methods, building, tracing, counting", scene.name);
        results.push(bar::with_bar(&stage, |progress| {
            reproduce(scene, &conditions, progress, |_| ())
        })?);
    }
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
