//! `bspscope accuracy`: measures accuracy vs. time.

use super::args::{AccuracyArgs, AccuracyFormat};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::jobs::StudyAccuracy;
use crate::present::report::accuracy::{AccuracyReport, write_csv, write_json, write_text};
use anyhow::Result;
use std::sync::Arc;

pub fn run(args: &AccuracyArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = Arc::new(resolve::scene_in_view(&setup)?);
    let job = StudyAccuracy {
        scene: Arc::clone(&scene),
        setup,
        rounds: args.rounds,
        only: args.only.clone(),
    };
    let study = bar::follow(job, |_| Ok(()))?;
    let report = AccuracyReport {
        scene: scene.name(),
        study: &study,
    };
    output::write_to(args.output.as_deref(), |out| match args.format {
        AccuracyFormat::Text => write_text(&report, out),
        AccuracyFormat::Json => write_json(&report, out),
        AccuracyFormat::Csv => write_csv(&report, out),
    })?;
    Ok(Outcome::Done)
}
