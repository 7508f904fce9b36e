//! Formats of single values in the file.

use serde::{Deserialize, Deserializer, Serializer, de::Error};
use std::ops::RangeInclusive;

/// A name that must be known.
pub fn one_of<'de, D: Deserializer<'de>>(
    deserializer: D,
    what: &str,
    known: impl IntoIterator<Item = &'static str>,
) -> Result<String, D::Error> {
    one_of_or(deserializer, what, known, &[])
}

/// A name that must be known. Each pair of `renamed` is the name of an earlier version and its
/// name now.
pub fn one_of_or<'de, D: Deserializer<'de>>(
    deserializer: D,
    what: &str,
    known: impl IntoIterator<Item = &'static str>,
    renamed: &[(&str, &str)],
) -> Result<String, D::Error> {
    let found = String::deserialize(deserializer)?;
    if let Some((_, now)) = renamed.iter().find(|(before, _)| *before == found) {
        return Ok((*now).to_owned());
    }
    let known: Vec<_> = known.into_iter().collect();
    if known.contains(&found.as_str()) {
        return Ok(found);
    }
    let known = known.join(", ");
    Err(D::Error::custom(format!(
        "no {what} is called '{found}'; there are {known}"
    )))
}

/// A number from 0 to 1.
pub fn share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    within(deserializer, 0.0..=1.0)
}

/// A number in a range.
pub fn within<'de, D: Deserializer<'de>>(
    deserializer: D,
    range: RangeInclusive<f64>,
) -> Result<f64, D::Error> {
    let found = f64::deserialize(deserializer)?;
    if range.contains(&found) {
        return Ok(found);
    }
    let (least, most) = range.into_inner();
    Err(D::Error::custom(format!(
        "expected a number from {least} to {most}, found {found}"
    )))
}

/// A value as one line of JSON.
pub mod json {
    use super::{Deserialize, Deserializer, Error, Serializer};
    use serde_json::Value;

    pub fn serialize<S: Serializer>(value: &Option<Value>, to: S) -> Result<S::Ok, S::Error> {
        match value {
            Some(value) => to.collect_str(value),
            None => to.serialize_none(),
        }
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Value>, D::Error> {
        let text = String::deserialize(from)?;
        serde_json::from_str(&text)
            .map(Some)
            .map_err(D::Error::custom)
    }
}
