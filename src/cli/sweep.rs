//! `bspscope sweep`: the parameters over a grid of settings, a row a point, to be broken off and gone
//! on with at any time.

use super::args::{BuildArgs, ChartArgs, SweepArgs};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::measure::sweep::{Form, Key, Plan, Row, answers, done, header, line, read_rows};
use crate::present::chart::{Chart, png, svg};
use crate::structure::{BuildSettings, MaxDepth};
use anyhow::{Context, Result, bail};
use std::fs::{self, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

/// Width and height of charts in pixels.
const CHART: (u32, u32) = (960, 600);

pub fn run(args: &SweepArgs) -> Result<Outcome> {
    let form = form_of(&args.output)?;
    output::check_place(Some(&args.output))?;
    check_charts(&args.charts)?;
    let bases = bases(args)?;
    let (request, scene) = resolve::scene(&args.scene.scene, &args.scene.cylinders)?;
    let render = resolve::render(&args.trace, &args.picture);
    render.view(&scene)?;
    let plan = Plan::new(&request, &bases, &args.d_max.0, &args.n_oilf.0, &render);
    let points: Vec<(usize, Key)> = (plan.points.iter().enumerate())
        .filter(|(number, _)| args.shard.contains(*number))
        .map(|(number, point)| (number, point.key.clone()))
        .collect();

    let name = || args.output.display().to_string();
    let (mut rows, complete) = match fs::read_to_string(&args.output) {
        Ok(text) => read_rows(&text, form).with_context(name)?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => (Vec::new(), 0),
        Err(error) => return Err(error).with_context(name),
    };
    let at = done(&rows, &points, plan.points.len()).with_context(name)?;
    let mut file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(&args.output)
        .with_context(name)?;
    // What was torn off in the midst of a row is written over.
    file.set_len(complete as u64).with_context(name)?;
    file.seek(SeekFrom::End(0)).with_context(name)?;
    if complete == 0 {
        file.write_all(header(form).as_bytes()).with_context(name)?;
    }
    for (i, (point, _)) in points.iter().enumerate().skip(at) {
        let build = &plan.points[*point].build;
        let stage = format!(
            "point {} of {}: {}, D_MAX {}, N_OILF {}",
            i + 1,
            points.len(),
            build.method.name,
            build.d_max,
            build.n_oilf
        );
        let row = bar::with_bar(&stage, |progress| plan.row(&scene, *point, progress))?;
        // One call a row, so that what a stop leaves is whole rows and at most one torn one.
        file.write_all(line(&row, form).as_bytes())
            .with_context(name)?;
        rows.push(row);
    }
    finish(&rows, &args.charts)?;
    Ok(Outcome::Done)
}

/// The settings of every method, but for depth and leaf size.
fn bases(args: &SweepArgs) -> Result<Vec<BuildSettings>> {
    let build = BuildArgs {
        d_max: MaxDepth::Automatic,
        n_oilf: 1,
        rules: args.rules.clone(),
    };
    resolve::builds(&resolve::methods(&args.method), &build)
}

/// The form of a file of rows.
pub fn form_of(path: &Path) -> Result<Form> {
    Form::for_path(path)
        .with_context(|| format!("{}: rows are written as .csv or .jsonl", path.display()))
}

/// Refuses charts that cannot be written, before work is done for them.
pub fn check_charts(args: &ChartArgs) -> Result<()> {
    for path in &args.chart {
        if !matches!(extension(path).as_deref(), Some("png" | "svg")) {
            bail!("{}: charts are drawn as .png or .svg", path.display());
        }
        output::check_place(Some(path))?;
    }
    Ok(())
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

/// Draws the charts of rows, and tells which settings are best.
pub fn finish(rows: &[Row], args: &ChartArgs) -> Result<()> {
    let shown = args.show.0;
    for path in &args.chart {
        let chart = Chart {
            rows,
            parameter: shown,
            size: CHART,
        };
        let bytes = match extension(path).as_deref() {
            Some("svg") => svg(&chart)?.into_bytes(),
            _ => png(&chart)?,
        };
        output::write_file(path, |out| out.write_all(&bytes))?;
    }
    output::write_to(None, |out| {
        answers(rows, shown)
            .iter()
            .try_for_each(|answer| writeln!(out, "{}", answer.sentence(shown)))
    })
}
