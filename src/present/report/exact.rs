//! Values for programs.

use crate::measure::{Measurement, Parameter, Unit};
use serde_json::Value;

/// A parameter's value for machines, as [`exact`].
pub fn exact_value(parameter: &Parameter, measurement: &Measurement) -> Value {
    exact(parameter.value(measurement), parameter.unit)
}

/// A value for machines: whole numbers for what is counted, fractions for shares; null where there is
/// no value.
pub fn exact(value: Option<f64>, unit: Unit) -> Value {
    match (value, unit) {
        (None, _) => Value::Null,
        (Some(value), Unit::Count | Unit::Bytes) => Value::from(value as u64),
        (Some(value), Unit::Ratio | Unit::Percent | Unit::Volume | Unit::Seconds) => {
            Value::from(value)
        }
    }
}
