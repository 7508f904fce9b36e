//! Outcomes in words.

use crate::measure::accuracy::{AccuracyStudy, ErrorMeasure, Outcome};
use crate::present::number::significant;

/// Describes an outcome: its choice, its time and its error by one measure.
pub fn words(trade: &AccuracyStudy, outcome: &Outcome, measure: &ErrorMeasure) -> String {
    format!(
        "{}: {:.3} of the reference's time, {} {}",
        outcome.choice.words(),
        trade.ratios(outcome)[1],
        measure.name,
        significant((measure.value)(outcome))
    )
}
