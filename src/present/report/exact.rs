//! Exact values for programs.

use crate::measure::{Measurement, Parameter, Unit};
use serde_json::Value;

/// Returns a parameter's value for programs, as [`exact`] does.
pub fn exact_value(parameter: &Parameter, measurement: &Measurement) -> Value {
    exact(parameter.value(measurement), parameter.unit)
}

/// Returns a value for programs: counts as integers, shares as fractions; null if there is no
/// value.
pub fn exact(value: Option<f64>, unit: Unit) -> Value {
    match (value, unit) {
        (None, _) => Value::Null,
        (Some(value), Unit::Count | Unit::Bytes) => Value::from(value as u64),
        (Some(value), Unit::Ratio | Unit::Percent | Unit::Volume | Unit::Seconds) => {
            Value::from(value)
        }
    }
}
