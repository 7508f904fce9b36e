//! What a parameter of the paper is.

use super::Measurement;
use serde::Serialize;

/// Where the paper lists a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Table {
    /// Table 1: scene and image.
    Scene,
    /// Table 2: static properties of the tree.
    Static,
    /// Table 3: dynamic properties of the tree.
    Dynamic,
    /// Not in the tables: an input of Λ, or stated beside it.
    Ours,
}

impl Table {
    pub const fn title(self) -> &'static str {
        match self {
            Table::Scene => "Scene and image (Table 1)",
            Table::Static => "Static properties of the tree (Table 2)",
            Table::Dynamic => "Dynamic properties of the tree (Table 3)",
            Table::Ours => "Beside the tables",
        }
    }
}

/// The paper's classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Class {
    /// Specified before rendering.
    S,
    /// Derived from the specified ones and the nature of ray tracing.
    D,
    /// Computed from the construction of the tree.
    C,
    /// Computed from rendering.
    R,
    /// Times: depend on implementation and machine.
    T,
}

/// What a value is counted in, and so how it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Unit {
    /// A whole number of things.
    Count,
    /// A mean or ratio, written as a plain number.
    Ratio,
    /// A share, written in per cent; its value is a fraction.
    Percent,
    /// Scene units to the third power.
    Volume,
    Seconds,
    Bytes,
}

impl Unit {
    /// Behind a number in text; empty for plain numbers.
    pub const fn suffix(self) -> &'static str {
        match self {
            Unit::Count | Unit::Ratio => "",
            Unit::Percent => " %",
            Unit::Volume => " units³",
            Unit::Seconds => " s",
            Unit::Bytes => " B",
        }
    }

    /// A value as people read it, without the unit.
    pub fn number(self, value: f64) -> String {
        match self {
            Unit::Count | Unit::Bytes => grouped(value),
            Unit::Percent => significant(value * 100.0),
            Unit::Ratio | Unit::Volume | Unit::Seconds => significant(value),
        }
    }
}

/// One parameter: what it is, and how it follows from a measurement.
pub struct Parameter {
    /// The paper's symbol, such as `N_LS`; the key in JSON and CSV.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    pub table: Table,
    pub class: Class,
    pub unit: Unit,
    /// What it means, in a sentence; where our reading of the paper needs saying, that too.
    pub meaning: &'static str,
    /// How it follows from others, with their symbols; empty for what is counted or given.
    pub formula: &'static str,
    /// Its value; `None` where it has none (a ratio without a denominator, or not measured yet).
    pub value: fn(&Measurement) -> Option<f64>,
}

impl Parameter {
    /// The value as people read it, with its unit; `–` where there is none.
    pub fn format(&self, value: Option<f64>) -> String {
        match value {
            None => "–".into(),
            Some(value) => format!("{}{}", self.number(value), self.unit.suffix()),
        }
    }

    /// The value as people read it, without its unit.
    pub fn number(&self, value: f64) -> String {
        self.unit.number(value)
    }
}

/// A whole number with thin groups of three digits.
pub fn grouped(value: f64) -> String {
    let digits = format!("{value:.0}");
    let mut out = String::new();
    for (i, c) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) && out != "-" {
            out.push(' ');
        }
        out.push(c);
    }
    out
}

/// Four significant digits or more.
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

    #[test]
    fn numbers_are_written_for_people() {
        assert_eq!(grouped(2127616.0), "2 127 616");
        assert_eq!(grouped(12.0), "12");
        assert_eq!(significant(0.5), "0.5000");
        assert_eq!(significant(34.567), "34.57");
        assert_eq!(significant(12345.6), "12346");
        assert_eq!(significant(0.00001), "1.000e-5");
    }
}
