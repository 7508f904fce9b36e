//! The study as tables for a terminal.

use super::content::StudyReport;
use super::words::{conditions, estimate, paragraph};
use crate::measure::study::{Judged, Outcome, Score};
use crate::present::number::{Digits, NO_VALUE};
use crate::present::report::grid::Grid;
use crate::trace::KernelChoice;
use std::io::{Result, Write};

const TITLES: [&str; 8] = [
    "rays",
    "measure",
    "structures",
    "R²",
    "rank correlation",
    "error",
    "worst",
    "α",
];

/// Writes one table per scene and kernel, and a paragraph per scene.
pub fn write(report: &StudyReport, out: &mut dyn Write) -> Result<()> {
    writeln!(out, "{}", conditions(report))?;
    for outcome in &report.outcomes {
        for &kernel in &outcome.kernels {
            grid(outcome, kernel).write_text(out)?;
        }
        writeln!(out, "\n{}", paragraph(outcome))?;
    }
    Ok(())
}

fn grid(outcome: &Outcome, kernel: KernelChoice) -> Grid {
    let of_kernel = outcome.judged.iter().filter(|j| j.kernel == kernel);
    Grid {
        title: format!(
            "{}, kernel {}: how well each measure predicts time",
            outcome.scene,
            kernel.name()
        ),
        header: TITLES.map(String::from).to_vec(),
        rows: of_kernel
            .flat_map(|judged| judged.scores.iter().map(|score| cells(judged, score)))
            .collect(),
        first_number: 2,
    }
}

fn cells(judged: &Judged, score: &Score) -> Vec<String> {
    vec![
        judged.origin.name().into(),
        score.predictor.name().into(),
        score.count.to_string(),
        estimate(&score.r_squared),
        estimate(&score.rank),
        Digits::Three.percent(score.left_out.median),
        Digits::Three.percent(score.left_out.worst),
        score
            .alpha
            .map_or(NO_VALUE.into(), |alpha| format!("{alpha:.2}")),
    ]
}
