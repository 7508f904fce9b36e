//! Results of [`crate::measure`] in words: titles, marks, sentences.

use crate::measure::paper::{Cell, Mark, decimals};
use crate::measure::sweep::{Answer, Row};
use crate::measure::{Measurement, Parameter, Table, Unequal, Unit, parameter};
use crate::present::number::{NO_VALUE, counted};
use crate::structure::MaxDepth;
use std::fmt;

impl Table {
    pub const fn title(self) -> &'static str {
        match self {
            Table::Scene => "Scene and image (Table 1)",
            Table::Static => "Static properties of the tree (Table 2)",
            Table::Dynamic => "Dynamic properties of the tree (Table 3)",
            Table::Ours => "Not in the tables",
        }
    }
}

impl Measurement {
    /// Returns `D_MAX` in words, and whether it was automatic.
    pub fn depth_in_words(&self) -> String {
        match self.build.d_max {
            MaxDepth::Fixed(depth) => depth.to_string(),
            MaxDepth::Automatic => format!("{} (automatic)", self.depth_limit),
        }
    }
}

impl fmt::Display for Unequal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unequal::Parameter { symbol, a, b } => {
                let parameter = parameter(symbol);
                write!(
                    f,
                    "{symbol} ({}, class {:?}) is {} in A and {} in B",
                    parameter.name,
                    parameter.class,
                    parameter.format(*a),
                    parameter.format(*b)
                )
            }
            Unequal::Setting { name, a, b } => write!(f, "{name} is {a} in A and {b} in B"),
            Unequal::Camera => f.write_str("the cameras differ"),
            Unequal::Size => f.write_str("the pictures have different sizes"),
            Unequal::Pixels { count, first } => {
                let places: Vec<_> = first.iter().map(|[x, y]| format!("{x},{y}")).collect();
                let more = if *count > first.len() { ", …" } else { "" };
                let pixels = counted(*count, "pixel");
                let verb = if *count == 1 { "differs" } else { "differ" };
                write!(f, "{pixels} {verb}: {}{more}", places.join(" "))
            }
        }
    }
}

impl Mark {
    pub const fn name(self) -> &'static str {
        match self {
            Mark::Equal => "equal after rounding",
            Mark::SameDirection => "same direction",
            Mark::Differs => "differs",
        }
    }

    /// Returns the mark as one character for tables.
    pub const fn sign(self) -> &'static str {
        match self {
            Mark::Equal => "=",
            Mark::SameDirection => "~",
            Mark::Differs => "≠",
        }
    }
}

impl Cell {
    /// Formats the computed figure. If it differs from the printed one and is not an integer, it
    /// has one digit more. `–` if there is no figure.
    pub fn computed_text(&self) -> String {
        let more = usize::from(self.mark != Some(Mark::Equal));
        match self.computed {
            Some(value) if value.fract() == 0.0 && self.mark != Some(Mark::Equal) => {
                format!("{value}")
            }
            Some(value) => format!("{value:.*}", decimals(self.printed) + more),
            None => NO_VALUE.into(),
        }
    }
}

/// Returns the unit of a printed figure of a parameter; `ratio` for the column 2/1.
pub fn printed_unit(parameter: &Parameter, ratio: bool) -> &'static str {
    match (parameter.unit, ratio) {
        (Unit::Percent, true) => "points",
        (_, true) => "%",
        (unit, false) => unit.suffix().trim_start(),
    }
}

impl Answer<'_> {
    /// Returns the answer as a sentence.
    pub fn sentence(&self, shown: &Parameter) -> String {
        let of = |row: &Row| {
            let depth = parameter("D_MAX");
            format!(
                "D_MAX {}, N_OILF {}{}: {}",
                depth.format(row.value(depth)),
                row.key.n_oilf,
                match row.key.varied() {
                    varied if varied.is_empty() => varied,
                    varied => format!(", {varied}"),
                },
                shown.format(row.value(shown))
            )
        };
        let mut text = format!(
            "{}: least {} at {}",
            self.best.key.method,
            shown.symbol,
            of(self.best)
        );
        text += &format!("; the rule 1.2 log2 N + 2 gives D_MAX {}", self.rule);
        match self.at_rule {
            None => text += ", which is not among the points",
            Some(row) => {
                text += &format!(", where the least is at {}", of(row));
                let change = shown.change_text(self.best.value(shown), row.value(shown));
                if let Some(change) = change {
                    text += &format!(" ({})", change.text);
                }
            }
        }
        text
    }
}
