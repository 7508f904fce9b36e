//! All writers of the study.

use super::content::StudyReport;
use super::{csv, document, json, table};
use crate::present::report::writer::Writer;

/// All writers of the study.
pub static STUDY_WRITERS: &[Writer<StudyReport>] = &[
    Writer {
        name: "text",
        about: "tables and conclusions for reading on a terminal",
        extension: "txt",
        write: table::write,
    },
    Writer {
        name: "json",
        about: "for programs; also every structure with its counts and times",
        extension: "json",
        write: json::write,
    },
    Writer {
        name: "csv",
        about: "one line for every scene, kernel, set of rays and measure",
        extension: "csv",
        write: csv::write,
    },
    Writer {
        name: "markdown",
        about: "a document: the answer, and a paragraph and a figure per scene",
        extension: "md",
        write: document::write,
    },
];
