//! The points of a sweep: what is measured, in which order, and one of them measured.

use super::{Key, Row};
use crate::measure::{MeasureError, measure};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::setup::{Setting, Setup, Value, any_setting};

/// One point: its setup and what identifies it.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    pub setup: Setup,
    pub key: Key,
}

/// A setting and the values that a sweep gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The setting's name.
    pub name: &'static str,
    pub values: Vec<Value>,
}

/// The points of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The combinations of the axes; the values of the last axis follow each other.
    pub points: Vec<Point>,
}

impl Axis {
    /// Reads `NAME=VALUES`, such as `precision=f32,f64` or `d-max=8..24,auto`.
    ///
    /// # Errors
    /// No setting of this name, or values that it cannot have.
    pub fn parse(text: &str) -> Result<Axis, String> {
        let (name, values) = text
            .split_once('=')
            .ok_or_else(|| format!("expected NAME=VALUES, found '{text}'"))?;
        Axis::of(name.trim(), values)
    }

    /// The axis of a setting with these values.
    ///
    /// # Errors
    /// As [`Axis::parse`].
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
    /// Every combination of these setups, one for each method, with the values of the axes. A
    /// constant that a method does not have is no axis for that method.
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

    /// Measures a point, by its number, of the scene that its setup asks for.
    ///
    /// # Errors
    /// As [`measure`].
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
        let measured = measure(scene, &setup.build, &setup.render, progress)?;
        Ok(Row::of(
            point,
            self.points.len(),
            key.clone(),
            &measured.measurement,
        ))
    }
}

/// A setup with each value of an axis.
fn with_each(setup: &Setup, setting: &Setting, axis: &Axis) -> Vec<Setup> {
    let with = |&value: &Value| {
        let mut setup = setup.clone();
        setting.store(&mut setup, value);
        setup
    };
    axis.values.iter().map(with).collect()
}
