//! What the curves and the map of a sweep show.

use crate::measure::sweep::{Row, rule_depth};
use crate::measure::{Parameter, parameter};

/// What curves and map show.
pub struct Shown<'a> {
    pub rows: &'a [Row],
    pub parameter: &'static Parameter,
    /// Of every method.
    pub best: &'a [&'a Row],
    /// The row that was loaded last.
    pub chosen: Option<usize>,
}

impl Shown<'_> {
    /// The automatic depth, 1.2 log2 N + 2.
    pub fn rule(&self) -> Option<u32> {
        self.rows.first().and_then(rule_depth)
    }

    pub fn is_best(&self, row: &Row) -> bool {
        self.best.iter().any(|best| best.point == row.point)
    }

    /// A row in words.
    pub fn words(&self, row: &Row) -> String {
        let depth = parameter("D_MAX");
        format!(
            "{}, depth {}, leaf size {}: {} {}{}",
            row.key.method,
            depth.format(row.value(depth)),
            row.key.n_oilf,
            self.parameter.symbol,
            self.parameter.format(row.value(self.parameter)),
            if self.is_best(row) { " (least)" } else { "" }
        )
    }
}

/// Returns a text with the words that the window has for the paper's symbols.
pub fn in_words(text: &str) -> String {
    text.replace("D_MAX", "depth")
        .replace("N_OILF", "leaf size")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_stand_for_symbols() {
        let text = in_words("least T_TR at D_MAX 12, N_OILF 4");
        assert_eq!(text, "least T_TR at depth 12, leaf size 4");
    }
}
