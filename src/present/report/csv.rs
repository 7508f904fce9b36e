//! CSV for spreadsheets and statistics: one line per parameter and run.

use super::content::Report;
use super::exact::exact_value;
use super::per_kind;
use super::writer::Writer;
use crate::measure::{DELTA, LAMBDA, Unit, parameters};
use serde_json::Value;
use std::io::{Result, Write};

pub(super) const WRITER: Writer = Writer {
    name: "csv",
    about: "one line for every parameter and method; shares as fractions",
    extension: "csv",
    write,
};

fn write(report: &Report, out: &mut dyn Write) -> Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "scene", "method", "symbol", "name", "set", "class", "unit", "value",
    ])?;
    for run in &report.runs {
        for parameter in parameters() {
            let set = if DELTA.contains(&parameter.symbol) {
                "delta"
            } else if LAMBDA.contains(&parameter.symbol) {
                "lambda"
            } else {
                ""
            };
            let value = text(&exact_value(parameter, run));
            csv.write_record([
                report.scene.name.as_str(),
                run.build.method.name,
                parameter.symbol,
                parameter.name,
                set,
                &format!("{:?}", parameter.class),
                unit(parameter.unit),
                &value,
            ])?;
        }
    }
    for line in per_kind::lines(report) {
        let figure = line.figure;
        let (method, unit) = match line.run {
            Some(run) => (report.runs[run].build.method.name, unit(figure.unit)),
            None => ("2/1", "ratio"),
        };
        csv.write_record([
            report.scene.name.as_str(),
            method,
            &figure.key,
            &figure.name,
            line.kind.name(),
            "R",
            unit,
            &text(&line.value),
        ])?;
    }
    csv.flush()
}

/// Returns a value as a cell; empty if there is none.
fn text(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        value => value.to_string(),
    }
}

/// Returns the unit of [`exact_value`], which is not always the unit in tables for people.
const fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Count => "count",
        Unit::Ratio => "ratio",
        Unit::Percent => "fraction",
        Unit::Volume => "units^3",
        Unit::Seconds => "seconds",
        Unit::Bytes => "bytes",
        Unit::Rate => "rays/second",
    }
}
