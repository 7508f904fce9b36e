//! Plain text for a terminal: Δ and Λ first, then every parameter.

use super::content::Report;
use super::sections::{Section, delta_and_lambda, rows, tables, value_titles};
use super::table::plain_table;
use super::writer::Writer;
use super::{per_kind, words};
use std::io::{Result, Write};

pub(super) const WRITER: Writer = Writer {
    name: "text",
    about: "tables for reading on a terminal",
    extension: "txt",
    write,
};

fn write(report: &Report, out: &mut dyn Write) -> Result<()> {
    write_summary(report, out)?;
    writeln!(out)?;
    for line in words::settings(report) {
        writeln!(out, "{line}")?;
    }
    for section in tables() {
        write_section(&section, report, true, out)?;
    }
    let mut grids = per_kind::grids(report).into_iter();
    grids.try_for_each(|grid| grid.write_text(out))
}

/// Writes the scene, Δ and Λ, and the times.
///
/// # Errors
/// Those of `out`.
pub fn write_summary(report: &Report, out: &mut dyn Write) -> Result<()> {
    for line in words::scene(report) {
        writeln!(out, "{line}")?;
    }
    for section in delta_and_lambda(report) {
        write_section(&section, report, false, out)?;
    }
    writeln!(out)?;
    for line in words::times(report) {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

fn write_section(
    section: &Section,
    report: &Report,
    with_class: bool,
    out: &mut dyn Write,
) -> Result<()> {
    let mut titles: Vec<String> = vec!["".into(), "".into()];
    if with_class {
        titles.push("class".into());
    }
    titles.push("unit".into());
    let first_value = titles.len();
    titles.extend(value_titles(report));
    let mut table = plain_table(titles, first_value);
    for row in rows(section, report) {
        let mut cells: Vec<String> = vec![row.parameter.symbol.into(), row.parameter.name.into()];
        if with_class {
            cells.push(format!("{:?}", row.parameter.class));
        }
        cells.push(row.unit().into());
        cells.extend(row.values);
        cells.extend(row.second_to_first);
        table.add_row(cells);
    }
    writeln!(out, "\n{}", section.title)?;
    writeln!(out, "{}", table.trim_fmt())
}
