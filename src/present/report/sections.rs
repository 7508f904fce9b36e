//! The tables of a report that all writers for people share.

use super::content::Report;
use crate::measure::{
    ACROSS_STRUCTURES, Class, DELTA, LAMBDA, Parameter, Table, parameter, parameters,
};
use crate::present::number::NO_VALUE;

/// One table.
pub struct Section {
    pub title: &'static str,
    pub parameters: Vec<&'static Parameter>,
}

/// A row of a table: a value for every run. If there are exactly two runs, also the second relative
/// to the first.
pub struct Row {
    pub parameter: &'static Parameter,
    /// Without units; those are [`Row::unit`].
    pub values: Vec<String>,
    pub second_to_first: Option<String>,
}

impl Row {
    /// Returns the unit of the values; empty for plain numbers.
    pub fn unit(&self) -> &'static str {
        self.parameter.unit.suffix().trim_start()
    }
}

/// Returns Δ and Λ, as in the paper's Tables 5 and 6. If the nodes of the runs are of different kinds, what
/// compares across structures follows N_AT.
pub fn delta_and_lambda(report: &Report) -> [Section; 2] {
    let section = |title, symbols: &[&str]| Section {
        title,
        parameters: symbols.iter().map(|symbol| parameter(symbol)).collect(),
    };
    let mut delta = section("Δ: the tree", &DELTA);
    let mut pairs = report.runs.windows(2);
    if pairs.any(|pair| pair[0].kind_of_node() != pair[1].kind_of_node()) {
        let across = ACROSS_STRUCTURES.map(parameter);
        delta.parameters.extend(across);
    }
    [delta, section("Λ: the implementation", &LAMBDA)]
}

/// Returns all parameters, grouped by the paper's tables.
pub fn tables() -> [Section; 4] {
    [Table::Scene, Table::Static, Table::Dynamic, Table::Ours].map(|table| Section {
        title: table.title(),
        parameters: parameters().iter().filter(|p| p.table == table).collect(),
    })
}

/// Returns the rows of a table for these runs.
pub fn rows(section: &Section, report: &Report) -> Vec<Row> {
    section
        .parameters
        .iter()
        .map(|&parameter| {
            let values: Vec<_> = report.runs.iter().map(|run| parameter.value(run)).collect();
            Row {
                parameter,
                second_to_first: match &report.runs[..] {
                    // Given parameters are the same for both.
                    [_, _] if parameter.class == Class::S => Some(String::new()),
                    [first, second] => Some(parameter.compare(first, second).to_string()),
                    _ => None,
                },
                values: values
                    .into_iter()
                    .map(|v| v.map_or_else(|| NO_VALUE.into(), |v| parameter.number(v)))
                    .collect(),
            }
        })
        .collect()
}

/// Returns the titles of the value columns: the methods, and `2/1` if there are exactly two.
pub fn value_titles(report: &Report) -> Vec<String> {
    let mut titles: Vec<String> = report
        .runs
        .iter()
        .map(|run| run.build.method.name.into())
        .collect();
    if titles.len() == 2 {
        titles.push("2/1".into());
    }
    titles
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_hold_every_parameter_once() {
        let shown: usize = tables().iter().map(|t| t.parameters.len()).sum();
        assert_eq!(shown, parameters().len());
    }
}
