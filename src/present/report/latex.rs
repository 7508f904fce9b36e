//! LaTeX tables for papers, in the style of the paper's Table 5. They need no package.

use super::content::Report;
use super::sections::{Section, delta_and_lambda, rows, tables, value_titles};
use super::writer::Writer;
use super::{escape, per_kind, words};
use std::io::{Result, Write};

pub(super) const WRITER: Writer = Writer {
    name: "latex",
    about: "tabular environments for papers",
    extension: "tex",
    write,
};

fn write(report: &Report, out: &mut dyn Write) -> Result<()> {
    let lines = [
        words::scene(report),
        words::settings(report),
        words::times(report),
    ];
    for line in lines.concat() {
        writeln!(out, "% {line}")?;
    }
    for section in delta_and_lambda(report).into_iter().chain(tables()) {
        write_section(&section, report, out)?;
    }
    let mut grids = per_kind::grids(report).into_iter();
    grids.try_for_each(|grid| grid.write_latex(out))
}

fn write_section(section: &Section, report: &Report, out: &mut dyn Write) -> Result<()> {
    let titles: Vec<_> = value_titles(report)
        .iter()
        .map(|title| format!("\\multicolumn{{1}}{{c}}{{{}}}", escape::latex(title)))
        .collect();
    writeln!(out, "\n% {}", section.title)?;
    writeln!(
        out,
        "\\begin{{tabular}}{{ll{}}}\n\\hline",
        "r".repeat(titles.len())
    )?;
    writeln!(
        out,
        "\\multicolumn{{2}}{{l}}{{{}}} & {} \\\\\n\\hline",
        escape::latex(section.title),
        titles.join(" & ")
    )?;
    for row in rows(section, report) {
        let mut symbol = symbol(row.parameter.symbol);
        if !row.unit().is_empty() {
            symbol += &format!(" [{}]", escape::latex(row.unit()));
        }
        let mut cells = vec![symbol, escape::latex(row.parameter.name)];
        cells.extend(row.values.iter().map(|value| number(value)));
        cells.extend(row.second_to_first.as_deref().map(number));
        writeln!(out, "{} \\\\", cells.join(" & "))?;
    }
    writeln!(out, "\\hline\n\\end{{tabular}}")
}

/// Formats a symbol as a formula: `T_TT/T_TR` becomes `$T_{TT}/T_{TR}$`.
fn symbol(symbol: &str) -> String {
    let parts: Vec<_> = symbol
        .split('/')
        .map(|part| match part.split_once('_') {
            Some((letter, index)) => format!("{letter}_{{{}}}", index.replace('_', "\\_")),
            None => part.to_owned(),
        })
        .collect();
    format!("${}$", parts.join("/"))
}

/// Formats a number so that its groups of digits are never broken across lines.
fn number(text: &str) -> String {
    escape::latex(text).replace(' ', "\\,")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_become_formulas() {
        assert_eq!(symbol("N_LS"), "$N_{LS}$");
        assert_eq!(symbol("T_TT/T_TR"), "$T_{TT}/T_{TR}$");
        assert_eq!(symbol("T_CB_WALL"), "$T_{CB\\_WALL}$");
    }

    #[test]
    fn text_is_escaped() {
        assert_eq!(escape::latex("a_b 5 %"), "a\\_b 5 \\%");
        assert_eq!(number("2 127 616"), "2\\,127\\,616");
    }
}
