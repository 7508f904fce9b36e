//! `bspscope tune`: finds the best tree for a scene.

use super::args::TuneArgs;
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::jobs::FindBestTree;
use crate::measure::tune::Search;
use crate::present::report::tune::{TUNE_WRITERS, TuneReport};
use crate::structure::Method;
use anyhow::Result;
use std::sync::Arc;

pub fn run(args: &TuneArgs) -> Result<Outcome> {
    output::check_place(args.report.output.as_deref())?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = Arc::new(resolve::scene_in_view(&setup)?);
    let name = scene.name().to_owned();
    let search = Search {
        setup,
        goal: args.goal,
        rays: args.rays,
        most_bytes: args.max_memory,
        methods: Method::all().collect(),
        budget: args.budget,
    };
    let tuned = bar::follow(FindBestTree { scene, search }, |_| Ok(()))?;
    let report = TuneReport { scene: name, tuned };
    output::write_with(TUNE_WRITERS, &report, &args.report)?;
    Ok(Outcome::Done)
}
