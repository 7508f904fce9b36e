//! What the paper's symbols mean, and numbers in groups.

use crate::measure::{Measurement, Parameter, parameters};
use crate::present::number::Digits;

/// Shows the tooltip of a figure: name, meaning, formula, the formula with the current numbers, class and
/// table.
pub fn explain(ui: &mut egui::Ui, parameter: &Parameter, measurement: &Measurement) {
    ui.set_max_width(380.0);
    ui.strong(format!("{}: {}", parameter.symbol, parameter.name));
    ui.label(parameter.meaning);
    if !parameter.formula.is_empty() {
        ui.separator();
        ui.label(format!("{} = {}", parameter.symbol, parameter.formula));
        ui.label(format!(
            "= {} = {}",
            with_numbers(parameter.formula, measurement),
            parameter.text(parameter.value(measurement), Digits::All)
        ));
    } else if let Some(value) = parameter.value(measurement) {
        ui.label(format!("= {}", parameter.text(Some(value), Digits::All)));
    }
    ui.separator();
    ui.weak(format!(
        "Class {:?} · {}",
        parameter.class,
        parameter.table.title()
    ));
}

/// A formula with every symbol replaced by its number.
fn with_numbers(formula: &str, measurement: &Measurement) -> String {
    let mut out = String::new();
    let mut rest = formula;
    while let Some(first) = rest.chars().next() {
        let symbol = parameters()
            .iter()
            .filter(|p| rest.starts_with(p.symbol))
            .max_by_key(|p| p.symbol.len());
        if let Some(parameter) = symbol {
            out += &parameter.format(parameter.value(measurement));
            rest = &rest[parameter.symbol.len()..];
        } else {
            out.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    out
}

/// A whole number in groups of three digits.
pub fn grouped(number: usize) -> String {
    crate::present::number::grouped(number as f64)
}
