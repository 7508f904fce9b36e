//! Values of counters with their units.

use super::digits::{Digits, NO_VALUE, with_unit};
use crate::measure::{Parameter, RayFigure, Unit};

impl Unit {
    /// Formats a value with its unit.
    pub fn text(self, value: f64, digits: Digits) -> String {
        match self {
            Unit::Count => digits.count(value),
            Unit::Ratio => digits.number(value),
            Unit::Percent => digits.percent(value),
            Unit::Volume => with_unit(digits.number(value), "units³"),
            Unit::Seconds => digits.seconds(value),
            Unit::Bytes => digits.bytes(value),
            Unit::Rate => with_unit(digits.number(value), "rays/s"),
        }
    }
}

impl Parameter {
    /// Formats a value with its unit; `–` if there is no value.
    pub fn text(&self, value: Option<f64>, digits: Digits) -> String {
        text(self.unit, value, digits)
    }

    /// Formats a value with its unit and four significant digits; `–` if there is no value.
    pub fn format(&self, value: Option<f64>) -> String {
        self.text(value, Digits::Four)
    }
}

impl RayFigure {
    /// Formats a value with its unit; `–` if there is no value.
    pub fn text(&self, value: Option<f64>, digits: Digits) -> String {
        text(self.unit, value, digits)
    }
}

fn text(unit: Unit, value: Option<f64>, digits: Digits) -> String {
    value.map_or_else(|| NO_VALUE.into(), |value| unit.text(value, digits))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{parameter, ray_figures};

    #[test]
    fn values_have_the_unit_of_their_counter() {
        for (symbol, value, expected) in [
            ("N_LS", 153_456.0, "153_k"),
            ("N_RPRT", 68.23, "68.2"),
            ("R_ETNLS", 0.2507, "25.1_%"),
            ("V_SCENE", 8.0, "8.00_units³"),
            ("T_TR", 0.0052, "5.20_ms"),
            ("M_TREE", 2048.0, "2.00_KiB"),
        ] {
            let text = parameter(symbol).text(Some(value), Digits::Three);
            assert_eq!(text.replace('\u{a0}', "_"), expected);
        }
        assert_eq!(parameter("T_TR").format(None), "–");
        assert_eq!(parameter("T_TR").format(Some(0.0052)), "5.200\u{a0}ms");
        let nodes = ray_figures().iter().find(|f| f.key == "nodes_mean");
        let nodes = nodes.expect("a figure");
        assert_eq!(nodes.text(Some(12.345), Digits::Three), "12.3");
        assert_eq!(nodes.text(None, Digits::All), "–");
    }
}
