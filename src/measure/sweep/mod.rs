//! A sweep measures the parameters over a grid of settings. Every combination of build methods and
//! of the values of any other settings is a point. Each point is measured once and written as one
//! row. An interrupted sweep can be resumed, and points can be distributed over machines.

mod comparable;
mod merge;
mod origin;
mod plan;
mod rows;

pub use comparable::{OtherOrigin, check_comparable};
pub use merge::{MergeError, merge};
pub use origin::Origin;
pub use plan::{Axis, Plan, Point};
pub use rows::{Form, Key, Row, RowError, header, line, read_rows};

use super::{Measurement, Parameter, parameters};
use crate::setup::{Group, Setting, Setup};
use crate::structure::MaxDepth;

/// A part of a sweep: the points whose number, divided by `count`, leaves the remainder `index`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 0, below `count`.
    pub index: usize,
    /// At least 1.
    pub count: usize,
}

impl Shard {
    /// All points.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    pub fn contains(&self, point: usize) -> bool {
        point % self.count == self.index
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    /// Parses `I/N`, with I from 1 to N.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        text.split_once('/')
            .and_then(|(i, n)| Some((i.parse::<usize>().ok()?, n.parse::<usize>().ok()?)))
            .filter(|(i, n)| (1..=*n).contains(i))
            .map(|(i, count)| Shard {
                index: i - 1,
                count,
            })
            .ok_or_else(|| format!("expected I/N with I from 1 to N, such as 2/4, found '{text}'"))
    }
}

/// Returns how many points of a sweep's part are already measured. The existing rows must be the
/// part's first points, in order, under the same conditions.
///
/// # Errors
/// The first row that does not match.
pub fn done(rows: &[Row], keys: &[(usize, Key)], points: usize) -> Result<usize, RowError> {
    for (i, row) in rows.iter().enumerate() {
        let belongs = keys
            .get(i)
            .is_some_and(|(point, key)| row.point == *point && row.key == *key);
        if !belongs || row.points != points {
            let expected = keys.get(i).map(|(_, key)| row.key.differences(key));
            return Err(RowError::foreign(i + 1, &expected.unwrap_or_default()));
        }
    }
    Ok(rows.len())
}

impl Row {
    /// Returns the row of a measured point.
    pub fn of(
        point: usize,
        points: usize,
        key: Key,
        origin: Origin,
        measurement: &Measurement,
    ) -> Row {
        Row {
            point,
            points,
            key,
            origin,
            values: parameters().iter().map(|p| p.value(measurement)).collect(),
            failure: None,
        }
    }

    /// Returns the row of a point that could not be measured.
    pub fn without_values(
        point: usize,
        points: usize,
        key: Key,
        origin: Origin,
        failure: String,
    ) -> Row {
        Row {
            point,
            points,
            key,
            origin,
            values: vec![None; parameters().len()],
            failure: Some(failure),
        }
    }

    /// Returns the value of a parameter.
    pub fn value(&self, parameter: &Parameter) -> Option<f64> {
        let place = parameters()
            .iter()
            .position(|p| p.symbol == parameter.symbol)?;
        self.values[place]
    }
}

impl Key {
    /// Returns the key of the point with this setup, in a sweep over these axes.
    pub fn of(setup: &Setup, axes: &[&str]) -> Key {
        let titles = ["method", "d-max", "n-oilf", "cylinders"];
        let pairs = |is_part: fn(&Setting) -> bool| {
            let settings = setup.settings();
            let pairs = settings
                .filter(|s| !titles.contains(&s.name) && is_part(s))
                .map(|s| format!("{}={}", s.name, s.text(setup)));
            pairs.collect::<Vec<_>>().join(" ")
        };
        Key {
            axes: axes.join(" "),
            scene: format!(
                "{}, cylinders {}",
                setup.scene.source, setup.scene.cylinders
            ),
            method: setup.build.method.name.to_owned(),
            d_max: setup.build.d_max.to_string(),
            n_oilf: setup.build.n_oilf,
            settings: pairs(|s| s.group == Group::Structure),
            picture: pairs(|s| s.group != Group::Structure),
        }
    }

    /// Returns the file or the generator, and how cylinders are represented.
    fn scene_parts(&self) -> (&str, &str) {
        let parts = self.scene.rsplit_once(", cylinders ");
        parts.unwrap_or((&self.scene, ""))
    }

    /// Returns all settings by name, each with its value as text.
    fn pairs(&self) -> Vec<(&str, String)> {
        let mut pairs = vec![
            ("scene", self.scene_parts().0.to_owned()),
            ("cylinders", self.scene_parts().1.to_owned()),
            ("method", self.method.clone()),
            ("d-max", self.d_max.clone()),
            ("n-oilf", self.n_oilf.to_string()),
        ];
        let words = self.settings.split(' ').chain(self.picture.split(' '));
        let words = words.filter_map(|word| word.split_once('='));
        pairs.extend(words.map(|(name, value)| (name, value.to_owned())));
        pairs
    }

    /// Returns the settings that differ, other than the axes of the sweep. Each is a phrase such as
    /// `kernel: scalar vs stream`.
    pub fn differences(&self, other: &Key) -> Vec<String> {
        let others = other.pairs();
        let mut differ = Vec::new();
        if self.axes != other.axes {
            differ.push(format!("axes: {} vs {}", self.axes, other.axes));
        }
        for (name, value) in self.pairs() {
            let is_axis = self.axes.split(' ').any(|axis| axis == name);
            let theirs = others.iter().find(|(known, _)| *known == name);
            if let Some((_, theirs)) = theirs.filter(|(_, theirs)| !is_axis && *theirs != value) {
                differ.push(format!("{name}: {value} vs {theirs}"));
            }
        }
        differ
    }

    /// Returns the values of the axes other than method, depth and leaf size, such as `precision
    /// f32`. Empty if there are no such axes.
    pub fn varied(&self) -> String {
        let pairs = self.pairs();
        let axes = self.axes.split(' ');
        let others = axes.filter(|axis| !["method", "d-max", "n-oilf"].contains(axis));
        let words = others.filter_map(|axis| {
            let (name, value) = pairs.iter().find(|(name, _)| *name == axis)?;
            Some(format!("{name} {value}"))
        });
        words.collect::<Vec<_>>().join(", ")
    }
}

/// The best depth and leaf size for a method, compared with the automatic depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<'a> {
    /// The row with the least value.
    pub best: &'a Row,
    /// The automatic depth, by the rule 1.2 · log₂ `N_O` + 2.
    pub rule: u32,
    /// The row with the least value at that depth; `None` if the sweep has none.
    pub at_rule: Option<&'a Row>,
}

/// Returns the best settings of every method: those with the least value of a parameter. Methods
/// are in the order of their first rows. Rows without a value are ignored.
///
/// # Errors
/// The same as those of [`check_comparable`].
pub fn answers<'a>(rows: &'a [Row], parameter: &Parameter) -> Result<Vec<Answer<'a>>, OtherOrigin> {
    check_comparable(rows, parameter)?;
    let mut methods: Vec<&str> = Vec::new();
    for row in rows {
        if !methods.contains(&row.key.method.as_str()) {
            methods.push(&row.key.method);
        }
    }
    let least = |rows: &mut dyn Iterator<Item = &'a Row>| {
        rows.filter_map(|row| Some((row, row.value(parameter)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(row, _)| row)
    };
    let answers = methods.into_iter().filter_map(|method| {
        let of_method = || rows.iter().filter(move |row| row.key.method == method);
        let best = least(&mut of_method())?;
        let rule = rule_depth(best)?;
        let depth = super::parameter("D_MAX");
        let at_depth = |row: &&Row| row.value(depth) == Some(f64::from(rule));
        Some(Answer {
            best,
            rule,
            at_rule: least(&mut of_method().filter(at_depth)),
        })
    });
    Ok(answers.collect())
}

/// Returns the automatic depth, 1.2 · log₂ `N_O` + 2, for a row's scene.
pub fn rule_depth(row: &Row) -> Option<u32> {
    let objects = row.value(super::parameter("N_O"))?;
    Some(MaxDepth::Automatic.resolve(objects as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_part_the_points() {
        let shards: Vec<Shard> = ["1/3", "2/3", "3/3"].map(|s| s.parse().unwrap()).to_vec();
        for point in 0..20 {
            assert_eq!(shards.iter().filter(|s| s.contains(point)).count(), 1);
        }
        for wrong in ["0/3", "4/3", "1/0", "1", "a/b"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
