//! Whether two measurements may be compared, and what changes from one to the other.
//!
//! The paper's precondition (section 4): parameters of class S, and thus of class D, are equal, and
//! so is the image. Everything else is the result.

use super::{Class, Measurement, Unit, parameters};
use crate::setup::{Affects, Group, SETTINGS, Setting, Setup};
use crate::trace::Picture;

/// What keeps two measurements from being compared.
#[derive(Clone, Debug, PartialEq)]
pub enum Unequal {
    /// A parameter of class S or D, with both values.
    Parameter {
        symbol: &'static str,
        a: Option<f64>,
        b: Option<f64>,
    },
    /// A setting that decides the picture, with both values as text.
    Setting {
        name: &'static str,
        a: String,
        b: String,
    },
    /// The camera (`OP_CAMERA`).
    Camera,
    /// So many pixels have another color; the first few by column and row.
    Pixels { count: usize, first: Vec<[u32; 2]> },
    /// The pictures have another size.
    Size,
}

/// Parameters of class S that not every structure has.
const TREE_SETTINGS: [&str; 2] = ["D_MAX", "N_OILF"];

/// Settings that are compared by parameters: `N_X`, `N_Y` and `W_CUT`.
const PARAMETERS_TOO: [&str; 2] = ["resolution", "min-contribution"];

/// How many unequal pixels are named.
const PIXELS_NAMED: usize = 5;

/// What keeps `a` and `b` from being compared; nothing if they may.
pub fn unequal(a: (&Measurement, &Picture), b: (&Measurement, &Picture)) -> Vec<Unequal> {
    let mut found: Vec<Unequal> = parameters()
        .iter()
        .filter(|p| matches!(p.class, Class::S | Class::D))
        .filter_map(|p| {
            let (a, b) = (p.value(a.0), p.value(b.0));
            // Where one of the two has no use for a setting of the tree, nothing of it can differ.
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
    // Settings with a symbol are among the parameters; the camera is compared as it was used.
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

/// The pixels whose colors differ, counted row by row; none if the pictures have another size.
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

/// How a value relates to another of the same parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// The second as a share of the first.
    Ratio(f64),
    /// For shares: the second less the first, in percentage points.
    Points(f64),
}

/// The second value relative to the first, as the paper's Tables 5 and 6 have it. `None` where
/// either has no value or the first is zero.
pub fn change(unit: Unit, first: Option<f64>, second: Option<f64>) -> Option<Change> {
    let (first, second) = (first?, second?);
    match unit {
        Unit::Percent => Some(Change::Points((second - first) * 100.0)),
        _ if first == 0.0 => None,
        _ => Some(Change::Ratio(second / first)),
    }
}

impl Change {
    /// The ratio, or the points, as a plain number.
    pub fn value(self) -> f64 {
        match self {
            Change::Ratio(value) | Change::Points(value) => value,
        }
    }
}
