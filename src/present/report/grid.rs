//! A plain table of text that can be written for a terminal, as Markdown, or as LaTeX.

use super::escape;
use super::table::plain_table;
use std::io::{Result, Write};

/// A table with titles. Every row has one cell per title.
#[derive(Clone, Debug, Default)]
pub struct Grid {
    pub title: String,
    pub header: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// Index of the first right-aligned column.
    pub first_number: usize,
}

impl Grid {
    /// Writes the table for a terminal.
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

    /// Writes the table as Markdown.
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

    /// Writes the table as a LaTeX tabular environment.
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
