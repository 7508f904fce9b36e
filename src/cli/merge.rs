//! `bspscope merge`: merges the parts of a sweep.

use super::args::MergeArgs;
use super::outcome::Outcome;
use super::{output, sweep};
use crate::measure::sweep::{check_comparable, header, line, merge, read_rows};
use anyhow::{Context, Result};
use std::fs;

pub fn run(args: &MergeArgs) -> Result<Outcome> {
    let form = sweep::form_of(&args.output)?;
    output::check_place(Some(&args.output))?;
    sweep::check_charts(&args.charts)?;
    let mut rows = Vec::new();
    for file in &args.files {
        let name = || file.display().to_string();
        let text = fs::read_to_string(file).with_context(name)?;
        let (part, _) = read_rows(&text, sweep::form_of(file)?).with_context(name)?;
        rows.extend(part);
    }
    let (rows, missing) = merge(rows)?;
    if !args.charts.chart.is_empty() {
        check_comparable(&rows, args.charts.show.0)?;
    }
    output::write_file(&args.output, |out| {
        out.write_all(header(form).as_bytes())?;
        rows.iter()
            .try_for_each(|row| out.write_all(line(row, form).as_bytes()))
    })?;
    sweep::finish(&rows, &args.charts)?;
    if missing.is_empty() {
        return Ok(Outcome::Done);
    }
    output::write_to(None, |out| {
        let numbers: Vec<_> = missing.iter().map(|point| point.to_string()).collect();
        writeln!(
            out,
            "missing points (counted from 0): {}",
            numbers.join(" ")
        )
    })?;
    Ok(Outcome::CheckFailed)
}
