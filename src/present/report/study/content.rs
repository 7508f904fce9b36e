//! The content of a report on the study.

use crate::measure::study::Outcome;
use crate::present::report::Machine;

/// The study of some scenes.
pub struct StudyReport {
    /// At least one.
    pub outcomes: Vec<Outcome>,
    pub machine: Machine,
    /// Date and time of the report.
    pub date: String,
    /// The command that repeats it.
    pub command: String,
    /// The folder of the figures as the document refers to it; `None` without figures.
    pub figures: Option<String>,
}

impl StudyReport {
    /// Returns the name of the file of a scene's figure.
    pub fn figure(outcome: &Outcome) -> String {
        let name = outcome
            .scene
            .replace(|c: char| !c.is_ascii_alphanumeric(), "-");
        format!("{name}.svg")
    }
}
