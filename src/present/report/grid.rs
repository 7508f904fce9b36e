//! A plain table of text in the forms for people: terminal, Markdown, LaTeX.

use super::escape;
use super::table::plain_table;
use std::io::{Result, Write};

/// A table: titles, and rows with as many cells.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    pub title: String,
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// The first column set to the right.
    pub first_number: usize,
}

impl Grid {
    /// For a terminal.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_text(&self, out: &mut dyn Write) -> Result<()> {
        let mut table = plain_table(self.header.clone(), self.first_number);
        for row in &self.rows {
            table.add_row(row.clone());
        }
        writeln!(out, "\n{}\n{}", self.title, table.trim_fmt())
    }

    /// As Markdown.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_markdown(&self, out: &mut dyn Write) -> Result<()> {
        let line = |cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| escape::markdown(cell)).collect();
            format!("| {} |", cells.join(" | "))
        };
        writeln!(out, "\n## {}\n", escape::markdown(&self.title))?;
        writeln!(out, "{}", line(&self.header))?;
        let numbers = self.header.len() - self.first_number;
        let rule = "---|".repeat(self.first_number) + &"--:|".repeat(numbers);
        writeln!(out, "|{rule}")?;
        self.rows
            .iter()
            .try_for_each(|row| writeln!(out, "{}", line(row)))
    }

    /// As a tabular environment of LaTeX.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_latex(&self, out: &mut dyn Write) -> Result<()> {
        let line = |cells: &[String]| {
            let cells: Vec<_> = cells.iter().map(|cell| escape::latex(cell)).collect();
            format!("{} \\\\", cells.join(" & "))
        };
        let numbers = self.header.len() - self.first_number;
        let columns = "l".repeat(self.first_number) + &"r".repeat(numbers);
        writeln!(out, "\n% {}", self.title)?;
        writeln!(out, "\\begin{{tabular}}{{{columns}}}\n\\hline")?;
        writeln!(out, "{}\n\\hline", line(&self.header))?;
        for row in &self.rows {
            writeln!(out, "{}", line(row))?;
        }
        writeln!(out, "\\hline\n\\end{{tabular}}")
    }
}
