//! `bspscope report`: pictures, tables, settings and machine as one HTML file.

use super::args::PageArgs;
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::measure_pixels;
use crate::present::export::write_page;
use crate::present::report::Report;
use crate::setup::Setup;
use anyhow::{Context, Result};

pub fn run(args: &PageArgs) -> Result<Outcome> {
    output::check_place(Some(&args.output))?;
    let setups = args.settings.setups(&args.scene)?;
    let Setup {
        scene: request,
        render,
        ..
    } = &setups[0];
    let scene = resolve::scene(request)?;
    render.view(&scene)?;
    let (mut runs, mut all_counts, mut picture) = (Vec::new(), Vec::new(), None);
    for Setup { build, .. } in &setups {
        let method = build.method.name;
        let stage = format!("{}, {method}: building, tracing, counting", scene.name());
        let (measured, counts) = bar::with_bar(&stage, |progress| {
            measure_pixels(&scene, build, render, progress)
        })?;
        runs.push(measured.measurement);
        all_counts.push(counts);
        picture = Some(measured.picture);
    }
    let report = Report::new(&scene, request, runs);
    let picture = picture.context("there is at least one method")?;
    let counts: Vec<_> = all_counts.iter().map(Some).collect();
    output::write_file(&args.output, |out| {
        write_page(&report, &picture, &counts, "", out)
    })?;
    Ok(Outcome::Done)
}
