//! All writers of searches.

use super::content::TuneReport;
use super::{csv, json, table};
use crate::present::report::writer::Writer;

/// All writers of searches, under the names of [`crate::present::report::WRITERS`].
pub static TUNE_WRITERS: &[Writer<TuneReport>] = &[
    Writer {
        name: "text",
        about: "a table for reading on a terminal",
        extension: "txt",
        write: table::write_text,
    },
    Writer {
        name: "json",
        about: "for programs; also what was left out",
        extension: "json",
        write: json::write,
    },
    Writer {
        name: "csv",
        about: "one line for every candidate, the best first",
        extension: "csv",
        write: csv::write,
    },
    Writer {
        name: "markdown",
        about: "a table for issues and notes",
        extension: "md",
        write: table::write_markdown,
    },
    Writer {
        name: "latex",
        about: "a tabular environment for papers",
        extension: "tex",
        write: table::write_latex,
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::report::WRITERS;

    #[test]
    fn searches_are_written_in_every_form_of_a_report() {
        let names: Vec<_> = WRITERS.iter().map(|w| (w.name, w.extension)).collect();
        let of_searches: Vec<_> = TUNE_WRITERS.iter().map(|w| (w.name, w.extension)).collect();
        assert_eq!(of_searches, names);
    }
}
