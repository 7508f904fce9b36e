//! Markdown tables for issues and notes.

use super::content::Report;
use super::sections::{Section, delta_and_lambda, rows, tables, value_titles};
use super::writer::Writer;
use super::{escape, per_kind, words};
use std::io::{Result, Write};

pub(super) const WRITER: Writer = Writer {
    name: "markdown",
    about: "tables for issues and notes",
    extension: "md",
    write,
};

fn write(report: &Report, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "# {}\n", escape::markdown(&report.scene.name))?;
    let lines = [
        words::scene(report),
        words::settings(report),
        words::times(report),
    ];
    for line in lines.concat() {
        writeln!(out, "- {}", escape::markdown(&line))?;
    }
    for section in delta_and_lambda(report).into_iter().chain(tables()) {
        write_section(&section, report, out)?;
    }
    let mut grids = per_kind::grids(report).into_iter();
    grids.try_for_each(|grid| grid.write_markdown(out))
}

fn write_section(section: &Section, report: &Report, out: &mut dyn Write) -> Result<()> {
    let titles = value_titles(report);
    writeln!(out, "\n## {}\n", section.title)?;
    writeln!(
        out,
        "| symbol | name | class | unit | {} |",
        titles.join(" | ")
    )?;
    writeln!(out, "|---|---|---|---|{}", "--:|".repeat(titles.len()))?;
    for row in rows(section, report) {
        let mut cells = vec![
            format!("`{}`", row.parameter.symbol),
            row.parameter.name.into(),
            format!("{:?}", row.parameter.class),
            row.unit().into(),
        ];
        cells.extend(row.values);
        cells.extend(row.second_to_first);
        writeln!(out, "| {} |", cells.join(" | "))?;
    }
    Ok(())
}
