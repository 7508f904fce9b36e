//! The points of a sweep: which setups it measures, in which order, and the measurement of one
//! point.

use super::{Key, Origin, Row};
use crate::measure::{MeasureError, measure};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::setup::{Setting, Setup, Value, any_setting};

/// One point: its setup and its key.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub setup: Setup,
    pub key: Key,
}

/// A setting and its values in a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The setting's name.
    pub name: &'static str,
    pub values: Vec<Value>,
}

/// The points of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The combinations of the axes. The last axis varies fastest.
    pub points: Vec<Point>,
}

impl Axis {
    /// Reads `NAME=VALUES`, such as `precision=f32,f64` or `d-max=8..24,auto`.
    ///
    /// # Errors
    /// There is no setting with this name, or it cannot have these values.
    pub fn parse(text: &str) -> Result<Axis, String> {
        let (name, values) = text
            .split_once('=')
            .ok_or_else(|| format!("expected NAME=VALUES, found '{text}'"))?;
        Axis::of(name.trim(), values)
    }

    /// Creates the axis of a setting with these values.
    ///
    /// # Errors
    /// The same as those of [`Axis::parse`].
    pub fn of(name: &str, values: &str) -> Result<Axis, String> {
        let setting = any_setting(name)?;
        let values = setting.parse_list(values);
        Ok(Axis {
            name: setting.name,
            values: values.map_err(|reason| format!("{name}: {reason}"))?,
        })
    }
}

impl Plan {
    /// Combines these setups, one per method, with all values of the axes. A constant that a method
    /// does not have is ignored for that method.
    pub fn new(bases: &[Setup], axes: &[Axis]) -> Plan {
        let mut names = vec!["method"];
        names.extend(axes.iter().map(|axis| axis.name));
        let mut setups: Vec<Setup> = Vec::new();
        for base in bases {
            let mut some = vec![base.clone()];
            for axis in axes {
                let Ok(setting) = base.setting(axis.name) else {
                    continue;
                };
                some = some
                    .iter()
                    .flat_map(|s| with_each(s, &setting, axis))
                    .collect();
            }
            setups.extend(some);
        }
        let point = |setup: Setup| Point {
            key: Key::of(&setup, &names),
            setup,
        };
        Plan {
            points: setups.into_iter().map(point).collect(),
        }
    }

    /// Measures a point of the sweep, given by its number, in the scene of its setup. A point whose tree is
    /// too large has a row without values, so that it does not end the sweep.
    ///
    /// # Errors
    /// The others of [`measure`].
    ///
    /// # Panics
    /// If there is no such point.
    pub fn row(
        &self,
        scene: &Scene,
        point: usize,
        progress: &Progress,
    ) -> Result<Row, MeasureError> {
        let Point { setup, key } = &self.points[point];
        let (points, key, origin) = (self.points.len(), key.clone(), Origin::here(setup));
        match measure(scene, &setup.build, &setup.render, progress) {
            Ok(measured) => Ok(Row::of(point, points, key, origin, &measured.measurement)),
            Err(error) if error.is_too_large() => {
                let why = error.to_string();
                Ok(Row::without_values(point, points, key, origin, why))
            }
            Err(error) => Err(error),
        }
    }
}

/// Returns a setup with each value of an axis.
fn with_each(setup: &Setup, setting: &Setting, axis: &Axis) -> Vec<Setup> {
    let with = |&value: &Value| {
        let mut setup = setup.clone();
        setting.store(&mut setup, value);
        setup
    };
    axis.values.iter().map(with).collect()
}
