//! `bspscope sweep`: the parameters over a grid of settings, a row a point, to be broken off and gone
//! on with at any time.

use super::args::{BuildArgs, ChartArgs, SweepArgs};
use super::{Outcome, measure, output, resolve};
use crate::measure::sweep::{
    Answer, Chart, Form, Key, Row, answers, done, header, line, png, read_rows, svg,
};
use crate::measure::{Parameter, parameter};
use crate::scene::{Sampling, SceneRequest};
use crate::trace::RenderSettings;
use crate::tree::BuildSettings;
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
    let builds = builds(args)?;
    let (request, scene) = resolve::scene(&args.scene.scene, &args.scene.cylinders)?;
    let render = resolve::render(*scene.camera(), &args.trace, &args.picture);
    render.view()?;
    let (scene_name, picture) = (scene_name(&request), picture(&render));
    let points: Vec<(usize, Key)> = builds
        .iter()
        .enumerate()
        .filter(|(point, _)| args.shard.contains(*point))
        .map(|(point, build)| (point, Key::of(&scene_name, build, &picture)))
        .collect();

    let name = || args.output.display().to_string();
    let (mut rows, complete) = match fs::read_to_string(&args.output) {
        Ok(text) => read_rows(&text, form).with_context(name)?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => (Vec::new(), 0),
        Err(error) => return Err(error).with_context(name),
    };
    let at = done(&rows, &points, builds.len()).with_context(name)?;
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
    for (i, (point, key)) in points.iter().enumerate().skip(at) {
        let build = &builds[*point];
        let stage = format!(
            "point {} of {}: {}, D_MAX {}, N_OILF {}",
            i + 1,
            points.len(),
            build.method.name,
            build.d_max,
            build.n_oilf
        );
        let measured = measure::staged(&scene, build, &render, &stage)?;
        let row = Row::of(*point, builds.len(), key.clone(), &measured.measurement);
        // One call a row, so that what a stop leaves is whole rows and at most one torn one.
        file.write_all(line(&row, form).as_bytes())
            .with_context(name)?;
        rows.push(row);
    }
    finish(&rows, &args.charts)?;
    Ok(Outcome::Done)
}

/// The settings of every point: methods, then leaf sizes, then depths.
fn builds(args: &SweepArgs) -> Result<Vec<BuildSettings>> {
    let mut all = Vec::new();
    let methods = resolve::methods(&args.method);
    for place in 0..methods.len() {
        for &n_oilf in &args.n_oilf.0 {
            for &d_max in &args.d_max.0 {
                let build = BuildArgs {
                    d_max,
                    n_oilf,
                    rules: args.rules.clone(),
                };
                // Of all methods at once: a setting may be that of another one.
                all.push(resolve::builds(&methods, &build)?.swap_remove(place));
            }
        }
    }
    Ok(all)
}

fn scene_name(request: &SceneRequest) -> String {
    format!("{}, cylinders {}", request.source, request.cylinders)
}

/// Everything of the picture that counts depend on, in words.
fn picture(render: &RenderSettings) -> String {
    format!(
        "{}x{}, D_AREC {}, cut-off {}, {}, samples at {}",
        render.width,
        render.height,
        render.d_arec,
        render.cut_off,
        render.precision.name(),
        match render.sampling {
            Sampling::Center => "centres",
            Sampling::Corner => "corners",
        }
    )
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
            .try_for_each(|answer| writeln!(out, "{}", sentence(answer, shown)))
    })
}

/// Which depth, which leaf size, and how the automatic rule does beside that.
fn sentence(answer: &Answer<'_>, shown: &Parameter) -> String {
    let Answer {
        best,
        rule,
        at_rule,
    } = answer;
    let of = |row: &Row| {
        let depth = parameter("D_MAX");
        format!(
            "D_MAX {}, N_OILF {}: {}",
            depth.format(row.value(depth)),
            row.key.n_oilf,
            shown.format(row.value(shown))
        )
    };
    let mut text = format!(
        "{}: least {} at {}",
        best.key.method,
        shown.symbol,
        of(best)
    );
    text += &format!("; the rule 1.2 log2 N + 2 gives D_MAX {rule}");
    match at_rule {
        None => text += ", which is not among the points",
        Some(row) => {
            text += &format!(", where the least is at {}", of(row));
            let ratio = row.value(shown).zip(best.value(shown)).map(|(a, b)| a / b);
            if let Some(ratio) = ratio.filter(|ratio| ratio.is_finite()) {
                text += &format!(" ({:+.1} %)", (ratio - 1.0) * 100.0);
            }
        }
    }
    text
}
