//! The scores as CSV: one line per scene, kernel, set of rays and measure.

use super::content::StudyReport;
use crate::structure::split::Structure;
use std::io::{Result, Write};

/// Writes one line per score. Shares are fractions. Each line has the processor, the instruction set, the kernel and
/// the version, as rows of a sweep have.
pub fn write(report: &StudyReport, out: &mut dyn Write) -> Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "scene",
        "processor",
        "instruction_set",
        "kernel",
        "version",
        "rays",
        "measure",
        "structures",
        "r_squared",
        "r_squared_low",
        "r_squared_high",
        "rank_correlation",
        "rank_correlation_low",
        "rank_correlation_high",
        "error_median",
        "error_worst",
        "alpha",
    ])?;
    for outcome in &report.outcomes {
        for judged in &outcome.judged {
            let [_, instruction_set] = judged.kernel.names_for(Structure::Bintree);
            for score in &judged.scores {
                let first = [
                    outcome.scene.clone(),
                    report.machine.processor.clone(),
                    instruction_set.to_owned(),
                    judged.kernel.name().to_owned(),
                    env!("CARGO_PKG_VERSION").to_owned(),
                    judged.origin.name().to_owned(),
                    score.predictor.name().to_owned(),
                    score.count.to_string(),
                ];
                let numbers = [
                    score.r_squared.value,
                    score.r_squared.low,
                    score.r_squared.high,
                    score.rank.value,
                    score.rank.low,
                    score.rank.high,
                    score.left_out.median,
                    score.left_out.worst,
                ];
                let alpha = score.alpha.map_or(String::new(), |alpha| alpha.to_string());
                let numbers = numbers.into_iter().map(|number| number.to_string());
                csv.write_record(first.into_iter().chain(numbers).chain([alpha]))?;
            }
        }
    }
    csv.flush()
}
