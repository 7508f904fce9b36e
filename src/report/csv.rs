//! CSV for spreadsheets and statistics: one line for every parameter of every run.

use super::{Report, Writer, exact_value};
use crate::measure::{DELTA, LAMBDA, PARAMETERS, Unit};
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
        for parameter in PARAMETERS {
            let set = if DELTA.contains(&parameter.symbol) {
                "delta"
            } else if LAMBDA.contains(&parameter.symbol) {
                "lambda"
            } else {
                ""
            };
            let value = match exact_value(parameter, run) {
                Value::Null => String::new(),
                value => value.to_string(),
            };
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
    csv.flush()
}

/// The unit of [`exact_value`], which is not always the one that people read.
const fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Count => "count",
        Unit::Ratio => "ratio",
        Unit::Percent => "fraction",
        Unit::Volume => "units^3",
        Unit::Seconds => "seconds",
        Unit::Bytes => "bytes",
    }
}
