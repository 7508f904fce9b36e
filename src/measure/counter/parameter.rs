//! The counters that are parameters: the paper's Tables 1 to 3, Δ and Λ, and a few of our own.

use super::class::{Class, Table, Unit};
use super::declaration::{Counter, Value};
use super::list::COUNTERS;
use crate::measure::measurement::Measurement;
use crate::structure::split::MethodInfo;
use crate::trace::Tally;
use std::sync::LazyLock;

/// The septet Δ by symbol, in the paper's order (equation 2).
pub const DELTA: [&str; 7] = [
    "N_LS", "R_ETNLS", "N_ADL", "N_AOIFL", "R_FVWV", "N_RPRT", "N_AT",
];

/// The triplet Λ by symbol, in the paper's order (equation 3).
pub const LAMBDA: [&str; 3] = ["T_CB", "T_TR", "T_TT/T_TR"];

/// What takes the place of `N_AT` in comparisons of different structures, by symbol.
pub const ACROSS_STRUCTURES: [&str; 2] = ["N_PT", "B_RAY"];

/// A counter that has one value for a whole measurement.
pub struct Parameter {
    /// The paper's symbol, such as `N_LS`; the key in JSON and CSV.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    pub table: Table,
    pub class: Class,
    pub unit: Unit,
    /// What it means, in a sentence.
    pub meaning: &'static str,
    /// Its formula in terms of other parameters; empty if it is counted, measured or given.
    pub formula: &'static str,
    /// Whether a smaller value means less work.
    pub less_is_better: bool,
    value: Value,
    applies: fn(&MethodInfo) -> bool,
    counts_nodes: bool,
}

impl Parameter {
    /// Returns its view of a counter; `None` if the counter is no parameter.
    fn of(counter: &Counter) -> Option<Parameter> {
        let (table, class) = counter.parameter?;
        Some(Parameter {
            symbol: counter.symbol,
            name: counter.name,
            table,
            class,
            unit: counter.unit,
            meaning: counter.meaning,
            formula: counter.formula,
            less_is_better: counter.less_is_better,
            value: counter.value,
            applies: counter.applies,
            counts_nodes: counter.counts_nodes,
        })
    }

    /// Returns its value. `None` before it is measured, for a ratio whose denominator is 0, and if it
    /// does not apply to the structure.
    pub fn value(&self, measurement: &Measurement) -> Option<f64> {
        if !(self.applies)(&measurement.build.method) {
            return None;
        }
        match self.value {
            Value::Measured(value) => value(measurement),
            Value::Rays(rays, quantity) => {
                let counted = measurement.counted.as_ref()?;
                let kinds = rays.kinds().iter();
                let tally: Tally = kinds.map(|&kind| counted.tallies[kind as usize]).sum();
                quantity.of(&tally)
            }
            Value::LeafDeviation(rays) => measurement.counted?.leaf_deviation(rays.kinds()),
            Value::PixelTime => None,
        }
    }

    /// Returns whether its values have the same unit in both measurements. A node of one structure is not
    /// a node of another one.
    pub fn has_same_unit(&self, a: &Measurement, b: &Measurement) -> bool {
        !self.counts_nodes || a.kind_of_node() == b.kind_of_node()
    }
}

/// Returns all parameters, in the order of the paper's tables.
pub fn parameters() -> &'static [Parameter] {
    static PARAMETERS: LazyLock<Vec<Parameter>> =
        LazyLock::new(|| COUNTERS.iter().filter_map(Parameter::of).collect());
    &PARAMETERS
}

/// Returns the parameter with this symbol.
///
/// # Panics
/// If there is none: symbols are written in code, not by users.
pub fn parameter(symbol: &str) -> &'static Parameter {
    parameters()
        .iter()
        .find(|p| p.symbol == symbol)
        .unwrap_or_else(|| panic!("no parameter {symbol}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every symbol of the paper's Tables 1 to 3. `OP_CAMERA` is not a number; it stands in the
    /// settings of a measurement.
    const TABLES: [(&str, Table); 41] = [
        ("N_X", Table::Scene),
        ("N_Y", Table::Scene),
        ("N_O", Table::Scene),
        ("N_L", Table::Scene),
        ("S_COV", Table::Scene),
        ("D_COMPX", Table::Scene),
        ("V_SCENE", Table::Scene),
        ("V_BB", Table::Scene),
        ("R_BBSC", Table::Scene),
        ("D_AREC", Table::Scene),
        ("D_MAX", Table::Scene),
        ("N_OILF", Table::Scene),
        ("D_REACH", Table::Static),
        ("N_LS", Table::Static),
        ("N_IN", Table::Static),
        ("N_ELS", Table::Static),
        ("R_ETNLS", Table::Static),
        ("N_RO", Table::Static),
        ("N_ADL", Table::Static),
        ("N_AOIL", Table::Static),
        ("N_AOIFL", Table::Static),
        ("V_EMPTY", Table::Static),
        ("R_FVWV", Table::Static),
        ("T_CB", Table::Static),
        ("N_PR", Table::Dynamic),
        ("N_PRIT", Table::Dynamic),
        ("N_HPR", Table::Dynamic),
        ("N_SR", Table::Dynamic),
        ("N_SRIT", Table::Dynamic),
        ("N_HSR", Table::Dynamic),
        ("N_SECR", Table::Dynamic),
        ("N_SECRIT", Table::Dynamic),
        ("N_HSECR", Table::Dynamic),
        ("N_RPRT", Table::Dynamic),
        ("N_VLS", Table::Dynamic),
        ("N_VELS", Table::Dynamic),
        ("N_VFLS", Table::Dynamic),
        ("N_INODES", Table::Dynamic),
        ("N_NODES", Table::Dynamic),
        ("N_AT", Table::Dynamic),
        ("T_TR", Table::Dynamic),
    ];

    #[test]
    fn every_symbol_of_the_tables_is_there_exactly_once() {
        for (symbol, table) in TABLES {
            let found: Vec<_> = parameters().iter().filter(|p| p.symbol == symbol).collect();
            assert_eq!(found.len(), 1, "{symbol}");
            assert_eq!(found[0].table, table, "{symbol}");
        }
        let in_tables = parameters()
            .iter()
            .filter(|p| p.table != Table::Ours)
            .count();
        assert_eq!(in_tables, TABLES.len());
    }

    #[test]
    fn septet_and_triplet_name_parameters() {
        for symbol in DELTA.iter().chain(&LAMBDA) {
            assert!(!parameter(symbol).meaning.is_empty());
        }
    }
}
