//! `bspscope report`: pictures, tables, settings and machine as one HTML file.

use super::args::PageArgs;
use super::outcome::Outcome;
use super::{bar, measure, output, resolve};
use crate::measure::measure_pixels;
use crate::present::export::write_page;
use crate::present::report::Report;
use anyhow::{Context, Result};

pub fn run(args: &PageArgs) -> Result<Outcome> {
    output::check_place(Some(&args.output))?;
    let setups = args.settings.setups(&args.scene)?;
    let scene = resolve::scene_in_view(&setups[0])?;
    let (mut runs, mut all_counts, mut picture) = (Vec::new(), Vec::new(), None);
    for setup in &setups {
        let stage = measure::stage(&scene, setup);
        let (measured, counts) = bar::with_bar(&stage, |progress| {
            measure_pixels(&scene, &setup.build, &setup.render, progress)
        })?;
        runs.push(measured.measurement);
        all_counts.push(counts);
        picture = Some(measured.picture);
    }
    let report = Report::new(&scene, &setups[0].scene, runs);
    let picture = picture.context("there is at least one method")?;
    let counts: Vec<_> = all_counts.iter().map(Some).collect();
    output::write_file(&args.output, |out| {
        write_page(&report, &picture, &counts, "", out)
    })?;
    Ok(Outcome::Done)
}
