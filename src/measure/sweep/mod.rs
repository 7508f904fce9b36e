//! The parameters over a grid of settings: every combination of build methods, greatest depths and
//! leaf sizes is a point, measured once and written as one row. A sweep can be broken off and goes
//! on where it was; points can be spread over machines.

mod plan;
mod rows;

pub use plan::{Plan, Point};
pub use rows::{Form, Key, MergeError, Row, RowError, header, line, merge, read_rows};

use super::{Measurement, Parameter, parameters};
use crate::structure::{BuildSettings, MaxDepth};

/// A part of a sweep's points: those whose number leaves `index` when divided by `count`.
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

    /// `I/N`, with I from 1 to N.
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

/// How many of the rows that are there stand at the beginning of a sweep's part: its first points,
/// in order, under the same conditions.
///
/// # Errors
/// The first row that does not belong there.
pub fn done(rows: &[Row], keys: &[(usize, Key)], points: usize) -> Result<usize, RowError> {
    for (i, row) in rows.iter().enumerate() {
        let belongs = keys
            .get(i)
            .is_some_and(|(point, key)| row.point == *point && row.key == *key);
        if !belongs || row.points != points {
            return Err(RowError::Foreign { row: i + 1 });
        }
    }
    Ok(rows.len())
}

impl Row {
    /// The row of a measured point.
    pub fn of(point: usize, points: usize, key: Key, measurement: &Measurement) -> Row {
        Row {
            point,
            points,
            key,
            values: parameters().iter().map(|p| p.value(measurement)).collect(),
        }
    }

    /// The value of a parameter.
    pub fn value(&self, parameter: &Parameter) -> Option<f64> {
        let place = parameters()
            .iter()
            .position(|p| p.symbol == parameter.symbol)?;
        self.values[place]
    }
}

impl Key {
    /// What identifies a point beside its number: the scene, the tree's settings, the picture.
    pub fn of(scene: &str, build: &BuildSettings, picture: &str) -> Key {
        let mut settings = format!(
            "overlap={} root-margin={} first-axis={}",
            build.overlap.name(),
            build.root_margin,
            build.first_axis
        );
        for constant in build.method.constants {
            settings += &format!(" {}={}", constant.name, build.constant(constant.name));
        }
        Key {
            scene: scene.to_owned(),
            method: build.method.name.to_owned(),
            d_max: build.d_max.to_string(),
            n_oilf: build.n_oilf,
            settings,
            picture: picture.to_owned(),
        }
    }
}

/// Which depth and leaf size are best for a method, and how the automatic rule does beside that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer<'a> {
    /// The row with the least value.
    pub best: &'a Row,
    /// The depth by the rule 1.2 · log₂ `N_O` + 2.
    pub rule: u32,
    /// The row with the least value among those of that depth; `None` where the sweep has none.
    pub at_rule: Option<&'a Row>,
}

/// The best settings of every method, by the least value of a parameter; methods in the order of
/// their first rows. Rows without a value are passed over.
pub fn answers<'a>(rows: &'a [Row], parameter: &Parameter) -> Vec<Answer<'a>> {
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
    methods
        .into_iter()
        .filter_map(|method| {
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
        })
        .collect()
}

/// The automatic depth, 1.2 · log₂ `N_O` + 2, for a row's scene.
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
