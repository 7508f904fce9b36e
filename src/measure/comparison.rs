//! Whether two measurements are comparable, and what changes from one to the other.
//!
//! The paper's precondition (section 4) is that the parameters of class S, and thus of class D, are
//! equal, and that the images are equal. Everything else is the result.

use super::{Class, Measurement, Parameter, RayFigure, Unit, parameters};
use crate::setup::{Affects, Group, SETTINGS, Setting, Setup};
use crate::trace::{Picture, RayKind};

/// A reason why two measurements are not comparable.
#[derive(Clone, Debug, PartialEq)]
pub enum Unequal {
    /// A parameter of class S or D, with both values.
    Parameter {
        symbol: &'static str,
        a: Option<f64>,
        b: Option<f64>,
    },
    /// A setting that affects the picture, with both values as text.
    Setting {
        name: &'static str,
        a: String,
        b: String,
    },
    /// The camera (`OP_CAMERA`).
    Camera,
    /// Number of pixels with different colors, and the column and row of the first few.
    Pixels { count: usize, first: Vec<[u32; 2]> },
    /// The pictures have different sizes.
    Size,
}

/// Parameters of class S that not every structure has.
const TREE_SETTINGS: [&str; 2] = ["D_MAX", "N_OILF"];

/// Settings that are compared as parameters: `N_X`, `N_Y` and `W_CUT`.
const PARAMETERS_TOO: [&str; 2] = ["resolution", "min-contribution"];

/// The most unequal pixels that are listed.
const PIXELS_NAMED: usize = 5;

/// Returns why `a` and `b` are not comparable; empty if they are.
pub fn unequal(a: (&Measurement, &Picture), b: (&Measurement, &Picture)) -> Vec<Unequal> {
    let mut found: Vec<Unequal> = parameters()
        .iter()
        .filter(|p| matches!(p.class, Class::S | Class::D))
        .filter_map(|p| {
            let (a, b) = (p.value(a.0), p.value(b.0));
            // A setting of the tree that one of the structures does not have cannot differ.
            let applies = !TREE_SETTINGS.contains(&p.symbol) || a.is_some() && b.is_some();
            (applies && a != b).then_some(Unequal::Parameter {
                symbol: p.symbol,
                a,
                b,
            })
        })
        .collect();
    let [of_a, of_b] = [a.0, b.0].map(|run| Setup {
        build: run.build.clone(),
        render: run.render,
        ..Setup::default()
    });
    // Settings with a symbol are compared as parameters. The camera is compared as it was used.
    let decides = |s: &Setting| {
        s.affects == Affects::Image
            && s.group != Group::Camera
            && s.symbol.is_none()
            && !PARAMETERS_TOO.contains(&s.name)
    };
    for setting in SETTINGS.iter().filter(|s| decides(s)) {
        let (a, b) = (setting.text(&of_a), setting.text(&of_b));
        if a != b {
            let name = setting.name;
            found.push(Unequal::Setting { name, a, b });
        }
    }
    if a.0.camera != b.0.camera {
        found.push(Unequal::Camera);
    }
    if (a.1.width, a.1.height) != (b.1.width, b.1.height) {
        found.push(Unequal::Size);
    }
    let differ = differing_pixels(a.1, b.1);
    if !differ.is_empty() {
        let place = |&i: &u32| [i % a.1.width, i / a.1.width];
        found.push(Unequal::Pixels {
            count: differ.len(),
            first: differ.iter().take(PIXELS_NAMED).map(place).collect(),
        });
    }
    found
}

/// Returns the pixels whose colors differ, as indices row by row. Empty if the pictures have
/// different sizes.
pub fn differing_pixels(a: &Picture, b: &Picture) -> Vec<u32> {
    if (a.width, a.height) != (b.width, b.height) {
        return Vec::new();
    }
    let pairs = a.pixels().iter().zip(b.pixels()).enumerate();
    pairs
        .filter(|(_, (a, b))| a != b)
        .map(|(i, _)| i as u32)
        .collect()
}

/// The change of a value relative to another value of the same parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// The second as a share of the first.
    Ratio(f64),
    /// For shares: the second minus the first, in percentage points.
    Points(f64),
}

/// Returns the second value relative to the first, as in the paper's Tables 5 and 6. `None` if a
/// value is missing or the first is zero.
pub fn change(unit: Unit, first: Option<f64>, second: Option<f64>) -> Option<Change> {
    let (first, second) = (first?, second?);
    match unit {
        Unit::Percent => Some(Change::Points((second - first) * 100.0)),
        _ if first == 0.0 => None,
        _ => Some(Change::Ratio(second / first)),
    }
}

/// How the values of two measurements compare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comparison {
    Change(Change),
    /// A value is missing, or the first is zero.
    NoValue,
    /// The values count nodes of different structures.
    OtherUnit,
}

impl Comparison {
    /// Returns the change, if there is one.
    pub fn change(self) -> Option<Change> {
        match self {
            Comparison::Change(change) => Some(change),
            Comparison::NoValue | Comparison::OtherUnit => None,
        }
    }

    fn of(has_same_unit: bool, unit: Unit, first: Option<f64>, second: Option<f64>) -> Comparison {
        if !has_same_unit && first.is_some() && second.is_some() {
            return Comparison::OtherUnit;
        }
        change(unit, first, second).map_or(Comparison::NoValue, Comparison::Change)
    }
}

impl Parameter {
    /// Compares its value in a measurement with that in another one.
    pub fn compare(&self, first: &Measurement, second: &Measurement) -> Comparison {
        let same = self.has_same_unit(first, second);
        Comparison::of(same, self.unit, self.value(first), self.value(second))
    }
}

impl RayFigure {
    /// Compares its value for rays of a kind in a measurement with that in another one.
    pub fn compare(&self, first: &Measurement, second: &Measurement, kind: RayKind) -> Comparison {
        let [a, b] = [first, second].map(|measurement| self.of(measurement, kind));
        Comparison::of(self.has_same_unit(first, second), self.unit, a, b)
    }
}

/// How many rays must be traced until building another tree pays off, `N_BE`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BreakEven {
    /// After this many rays. 0 if the second tree takes no longer to build and rays are faster.
    Rays(f64),
    /// Rays are not faster with the second tree.
    Never,
}

impl BreakEven {
    /// Returns when the second tree pays off compared with the first one: the additional time of building it,
    /// divided by the time that each ray takes less, without shading. `None` without a timed render of both.
    pub fn of(first: &Measurement, second: &Measurement) -> Option<BreakEven> {
        let per_ray = |measurement: &Measurement| {
            let rendering = measurement.rendering.filter(|r| r.rays > 0)?;
            Some(rendering.tracing.as_secs_f64() / rendering.rays as f64)
        };
        let build = |measurement: &Measurement| measurement.building.cpu.as_secs_f64();
        let saved = per_ray(first)? - per_ray(second)?;
        let extra = build(second) - build(first);
        Some(match saved > 0.0 {
            true => BreakEven::Rays((extra / saved).max(0.0)),
            false => BreakEven::Never,
        })
    }

    /// Returns the number of rays, if it pays off.
    pub fn rays(self) -> Option<f64> {
        match self {
            BreakEven::Rays(rays) => Some(rays),
            BreakEven::Never => None,
        }
    }
}

impl Change {
    /// Returns the ratio, or the percentage points, as a plain number.
    pub fn value(self) -> f64 {
        match self {
            Change::Ratio(value) | Change::Points(value) => value,
        }
    }
}
