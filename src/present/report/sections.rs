//! The tables of a report that all writers for people share.

use super::content::Report;
use crate::measure::{Class, DELTA, LAMBDA, Parameter, Table, change, parameter, parameters};
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

/// Returns Δ and Λ, as in the paper's Tables 5 and 6.
pub fn delta_and_lambda() -> [Section; 2] {
    let section = |title, symbols: &[&str]| Section {
        title,
        parameters: symbols.iter().map(|symbol| parameter(symbol)).collect(),
    };
    [
        section("Δ: the tree", &DELTA),
        section("Λ: the implementation", &LAMBDA),
    ]
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
                second_to_first: match values[..] {
                    // Given parameters are the same for both.
                    [_, _] if parameter.class == Class::S => Some(String::new()),
                    [first, second] => {
                        let change = change(parameter.unit, first, second);
                        Some(change.map_or_else(|| NO_VALUE.into(), |c| c.to_string()))
                    }
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
