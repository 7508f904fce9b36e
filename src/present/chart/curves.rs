//! The curves of a sweep: a parameter over the maximum depth, one curve per method and leaf size.

use crate::measure::sweep::Row;
use crate::measure::{Parameter, Unit, parameter};

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Method and leaf size.
    pub name: String,
    /// Index of the method, in the order of rows.
    pub method: usize,
    /// Distinguishes the curves of one method, from 0.
    pub mark: usize,
    /// Points in order of depth; at least one.
    pub points: Vec<CurvePoint>,
}

/// A point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The maximum depth, `D_MAX`.
    pub depth: f64,
    /// The value; shares are in percent.
    pub value: f64,
    /// Index of the row.
    pub row: usize,
}

/// Returns the curves in the order of rows, without the rows that have no value.
pub fn curves(rows: &[Row], shown: &Parameter) -> Vec<Curve> {
    let factor = if shown.unit == Unit::Percent {
        100.0
    } else {
        1.0
    };
    let depth = parameter("D_MAX");
    let mut methods: Vec<&str> = Vec::new();
    let mut curves: Vec<Curve> = Vec::new();
    for (place, row) in rows.iter().enumerate() {
        let (Some(depth), Some(value)) = (row.value(depth), row.value(shown)) else {
            continue;
        };
        let method = row.key.method.as_str();
        let known = methods.iter().position(|known| *known == method);
        let method_place = known.unwrap_or_else(|| {
            methods.push(method);
            methods.len() - 1
        });
        let mut name = format!("{method}, N_OILF {}", row.key.n_oilf);
        let varied = row.key.varied();
        if !varied.is_empty() {
            name += &format!(", {varied}");
        }
        let point = CurvePoint {
            depth,
            value: value * factor,
            row: place,
        };
        match curves.iter_mut().find(|curve| curve.name == name) {
            Some(curve) => curve.points.push(point),
            None => curves.push(Curve {
                name,
                method: method_place,
                mark: curves.iter().filter(|c| c.method == method_place).count(),
                points: vec![point],
            }),
        }
    }
    for curve in &mut curves {
        curve.points.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    }
    curves
}

/// If values differ by more than this factor, the axis is logarithmic.
const WIDE: f64 = 20.0;

/// Returns whether an axis from `least` to `most` is logarithmic.
pub fn is_wide(least: f64, most: f64) -> bool {
    least > 0.0 && most > WIDE * least
}
