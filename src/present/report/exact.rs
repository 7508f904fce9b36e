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
        (Some(value), Unit::Count) => Value::from(value as u64),
        // A mean of bytes has a fraction.
        (Some(value), Unit::Bytes) if value.fract() == 0.0 => Value::from(value as u64),
        (Some(value), _) => Value::from(value),
    }
}
