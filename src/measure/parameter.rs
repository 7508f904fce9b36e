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
