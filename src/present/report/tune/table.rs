//! The search as a table for people: the best candidate of every method, and those that were timed longest.

use super::content::TuneReport;
use super::words::{
    command, conditions, left_out, limits, memory, not_listed, rays_in_words, recommendation, time,
};
use crate::measure::tune::{Rank, Row};
use crate::present::number::{Digits, NO_VALUE, grouped};
use crate::present::report::escape;
use crate::present::report::grid::Grid;
use std::io::{Result, Write};

const TITLES: [&str; 10] = [
    "rank",
    "method",
    "D_MAX",
    "N_OILF",
    "time",
    "least to most",
    "tests per ray",
    "nodes",
    "build time",
    "memory",
];

fn grid(report: &TuneReport) -> Grid {
    let tuned = &report.tuned;
    let ranking = tuned.short_ranking();
    let rays = tuned.search.rays;
    let mut header = TITLES.map(String::from).to_vec();
    header.extend(rays.map(|rays| format!("build and {}", rays_in_words(rays))));
    let row = |rank: &Rank| {
        let row = &tuned.rows[rank.place];
        let mut cells = cells(rank, row);
        cells.extend(rays.map(|rays| time(row.spread_with_build(rays).median)));
        cells
    };
    Grid {
        title: format!("Trees by {}", tuned.search.goal.name()),
        header,
        rows: ranking.iter().map(row).collect(),
        first_number: 2,
    }
}

/// Returns the method with the constants that are not at their defaults.
fn method(row: &Row) -> String {
    let build = &row.setup.build;
    let constants = build.constants.iter();
    let constants = constants.map(|(name, value)| format!(", {name} {value}"));
    format!("{}{}", build.method.name, constants.collect::<String>())
}

fn cells(rank: &Rank, row: &Row) -> Vec<String> {
    let [depth, leaf_size] = limits(row);
    let spread = row.spread();
    let range = match row.rounds() {
        1 => NO_VALUE.into(),
        _ => format!("{} to {}", time(spread.least), time(spread.most)),
    };
    let tie = if rank.is_tied { "=" } else { "" };
    vec![
        format!("{}{tie}", rank.rank),
        method(row),
        depth,
        leaf_size,
        time(spread.median),
        range,
        row.tests_per_ray()
            .map_or(NO_VALUE.into(), |tests| Digits::Four.number(tests)),
        grouped(row.nodes() as f64),
        time(row.measurement.building.cpu.as_secs_f64()),
        memory(row),
    ]
}

/// Returns the sentences after the table.
fn conclusion(report: &TuneReport) -> Vec<String> {
    let tuned = &report.tuned;
    let mut lines = left_out(tuned);
    lines.extend(not_listed(tuned));
    lines.push(recommendation(tuned));
    lines
}

/// Writes the table, what was left out, and at the end the recommendation with its command.
pub fn write_text(report: &TuneReport, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "{}", conditions(&report.scene, &report.tuned))?;
    grid(report).write_text(out)?;
    writeln!(out)?;
    for line in conclusion(report) {
        writeln!(out, "{line}")?;
    }
    let (_, row) = report.tuned.recommended();
    writeln!(out, "\n{}", command(row))
}

/// Writes the same as Markdown.
pub fn write_markdown(report: &TuneReport, out: &mut dyn Write) -> Result<()> {
    let conditions = conditions(&report.scene, &report.tuned);
    writeln!(out, "{}", escape::markdown(&conditions))?;
    grid(report).write_markdown(out)?;
    writeln!(out)?;
    for line in conclusion(report) {
        writeln!(out, "- {}", escape::markdown(&line))?;
    }
    let (_, row) = report.tuned.recommended();
    writeln!(out, "\n```sh\n{}\n```", command(row))
}

/// Writes the table as LaTeX, and everything else as comments.
pub fn write_latex(report: &TuneReport, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "% {}", conditions(&report.scene, &report.tuned))?;
    for line in conclusion(report) {
        writeln!(out, "% {line}")?;
    }
    let (_, row) = report.tuned.recommended();
    writeln!(out, "% {}", command(row))?;
    grid(report).write_latex(out)
}
