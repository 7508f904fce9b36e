//! Numbers in the form of the paper's tables, for reports and exports.

use super::digits::{NO_VALUE, OTHER_UNIT, SPACE, grouped};
use crate::measure::{Change, Comparison, Parameter, Unit};
use std::fmt;

impl Unit {
    /// Returns what follows a number; empty for plain numbers.
    pub const fn suffix(self) -> &'static str {
        match self {
            Unit::Count | Unit::Ratio => "",
            Unit::Percent => " %",
            Unit::Volume => " units³",
            Unit::Seconds => " s",
            Unit::Bytes => " B",
            Unit::Rate => " rays/s",
        }
    }

    /// Formats a value without its unit, which is [`Unit::suffix`].
    pub fn number(self, value: f64) -> String {
        match self {
            // Plain spaces, so that a search in a report finds the number.
            Unit::Count | Unit::Bytes => grouped(value).replace(SPACE, " "),
            Unit::Percent => significant(value * 100.0),
            Unit::Ratio | Unit::Volume | Unit::Seconds | Unit::Rate => significant(value),
        }
    }
}

impl Parameter {
    /// Formats a value without its unit, for reports.
    pub fn number(&self, value: f64) -> String {
        self.unit.number(value)
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Comparison::Change(change) => change.fmt(f),
            Comparison::NoValue => f.write_str(NO_VALUE),
            Comparison::OtherUnit => f.write_str(OTHER_UNIT),
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Change::Points(points) => {
                let decimals = usize::from(points.abs() < 1000.0);
                write!(f, "{points:+.decimals$} points")
            }
            Change::Ratio(ratio) => {
                let percent = ratio * 100.0;
                // Three significant digits, as in the paper.
                let decimals = if percent == 0.0 {
                    0
                } else {
                    (2.0 - percent.abs().log10().floor()).clamp(0.0, 9.0) as usize
                };
                write!(f, "{percent:.decimals$} %")
            }
        }
    }
}

/// Formats a number with at least four significant digits.
pub fn significant(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if !(1e-4..1e7).contains(&size) {
        format!("{value:.3e}")
    } else {
        let before = size.log10().floor() as i32 + 1;
        format!("{value:.*}", (4 - before).max(0) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{change, parameter};

    #[test]
    fn reports_have_plain_numbers() {
        assert_eq!(Unit::Count.number(2127616.0), "2 127 616");
        assert_eq!(Unit::Bytes.number(12.0), "12");
        assert_eq!(Unit::Percent.number(0.2507), "25.07");
        assert_eq!(significant(0.5), "0.5000");
        assert_eq!(significant(34.567), "34.57");
        assert_eq!(significant(12345.6), "12346");
        assert_eq!(significant(0.00001), "1.000e-5");
    }

    #[test]
    fn changes_are_written_as_in_the_paper() {
        let text = |symbol, a, b| {
            change(parameter(symbol).unit, Some(a), Some(b))
                .unwrap()
                .to_string()
        };
        assert_eq!(text("N_LS", 3244.0, 19892.0), "613 %");
        assert_eq!(text("N_LS", 96056.0, 11322.0), "11.8 %");
        assert_eq!(text("R_ETNLS", 0.323, 0.254), "-6.9 points");
        assert_eq!(text("R_ETNLS", 0.159, 0.256), "+9.7 points");
        assert_eq!(text("N_ADL", 45.05, 13.37), "-3168 points");
        assert_eq!(text("N_LS", 1e6, 1.5), "0.000150 %");
        assert_eq!(text("N_ELS", 5.0, 0.0), "0 %");
        assert_eq!(change(parameter("N_ELS").unit, Some(0.0), Some(1.0)), None);
        assert_eq!(change(parameter("N_RPRT").unit, None, Some(1.0)), None);
    }
}
