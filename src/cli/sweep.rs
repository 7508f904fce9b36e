//! `bspscope sweep`: measures every combination of settings, one row per combination. It can be
//! interrupted and resumed at any time.

use super::args::{ChartArgs, SweepArgs};
use super::outcome::Outcome;
use super::{bar, output, resolve};
use crate::jobs::Sweep;
use crate::measure::sweep::{Axis, Form, Key, Plan, Row, answers, done, header, line, read_rows};
use crate::present::chart::{Chart, png, svg};
use crate::setup::Setup;
use crate::structure::Method;
use anyhow::{Context, Result, anyhow, bail};
use std::fs::{self, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use std::sync::Arc;

/// Width and height of charts in pixels.
const CHART: (u32, u32) = (960, 600);

pub fn run(args: &SweepArgs) -> Result<Outcome> {
    let form = form_of(&args.output)?;
    output::check_place(Some(&args.output))?;
    check_charts(&args.charts)?;
    let plan = plan(args)?;
    let first = plan.points[0].setup.clone();
    let scene = resolve::scene(&first.scene)?;
    for point in &plan.points {
        point.setup.render.view(&scene)?;
        point.setup.build.check()?;
    }
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
    let points = points[at..].iter().map(|(number, _)| *number);
    let job = Sweep {
        points: points.collect(),
        scene: (first.scene.clone(), Arc::new(scene)),
        plan: Arc::new(plan),
    };
    let mut failures = Vec::new();
    bar::follow(job, |row| {
        // One call per row, so that an interruption leaves whole rows and at most one torn row.
        file.write_all(line(&row, form).as_bytes())
            .with_context(name)?;
        if let Some(reason) = &row.failure {
            failures.push(format!(
                "point {} ({}): {reason}",
                row.point + 1,
                row.key.method
            ));
        }
        rows.push(row);
        Ok(())
    })?;
    for failure in &failures {
        // Without a standard error stream there is nobody to tell.
        let _ = writeln!(io::stderr(), "bspscope: {failure}");
    }
    finish(&rows, &args.charts)?;
    if !failures.is_empty()
        && rows
            .iter()
            .all(|row| row.values.iter().all(Option::is_none))
    {
        bail!("no point could be measured");
    }
    Ok(Outcome::Done)
}

/// Returns the points to measure: methods vary slowest, leaf sizes and depths fastest. These two
/// have default values without `--vary`.
fn plan(args: &SweepArgs) -> Result<Plan> {
    let wrong = |reason: String| anyhow!(reason);
    let mut axes = Vec::new();
    for text in &args.vary {
        axes.push(Axis::parse(text).map_err(wrong)?);
    }
    let usual = |values: &'static str| args.vary.is_empty().then_some(values);
    for (name, asked, usual) in [
        ("n-oilf", &args.n_oilf, usual("1,2,4,8")),
        ("d-max", &args.d_max, usual("1..30")),
    ] {
        if let Some(values) = asked.as_deref().or(usual) {
            axes.push(Axis::of(name, values).map_err(wrong)?);
        }
    }
    let is_method = |axis: &Axis| axis.name == "method";
    let mut methods = args.method.clone();
    for axis in axes.extract_if(.., |axis| is_method(axis)) {
        let named = axis
            .values
            .into_iter()
            .map(|value| Method::named(value.choice()));
        methods.extend(named.collect::<Result<Vec<_>, _>>()?);
    }
    if methods.is_empty() {
        methods = Method::of_the_paper();
    }
    for (i, axis) in axes.iter().enumerate() {
        if axes[..i].iter().any(|other| other.name == axis.name) {
            bail!("--vary {}: this setting is varied twice", axis.name);
        }
        let has = |m: &Method| Setup::of_method(*m).setting(axis.name).is_ok();
        if !methods.iter().any(has) {
            bail!("--vary {}: no chosen method has this setting", axis.name);
        }
    }
    let bases = args.settings.setups_for(&args.scene, &methods)?;
    Ok(Plan::new(&bases, &axes))
}

/// Returns the format of a file of rows.
pub fn form_of(path: &Path) -> Result<Form> {
    Form::for_path(path)
        .with_context(|| format!("{}: expected the extension .csv or .jsonl", path.display()))
}

/// Rejects charts that cannot be written, before work is done for them.
pub fn check_charts(args: &ChartArgs) -> Result<()> {
    for path in &args.chart {
        if !matches!(extension(path).as_deref(), Some("png" | "svg")) {
            bail!("{}: expected the extension .png or .svg", path.display());
        }
        output::check_place(Some(path))?;
    }
    Ok(())
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

/// Draws the charts of rows and prints the best settings, or why they are not compared.
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
    let answers = answers(rows, shown);
    output::write_to(None, |out| match &answers {
        Ok(answers) => answers
            .iter()
            .try_for_each(|answer| writeln!(out, "{}", answer.sentence(shown))),
        Err(why) => writeln!(out, "{why}"),
    })
}
