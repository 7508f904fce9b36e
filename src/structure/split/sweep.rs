//! Candidate planes just outside the ends of the objects of a cell, with the objects on both sides.

use super::rule::Cell;
use crate::geometry::{Aabb, Axis};
use std::cmp::Ordering;

/// The lower and upper ends of the objects of a cell along an axis, both sorted.
pub(super) struct Sweep {
    pub(super) lows: Vec<f64>,
    pub(super) highs: Vec<f64>,
}

/// A plane, and the number of objects that the driver puts on each side.
#[derive(Clone, Copy)]
pub(super) struct CandidatePlane {
    pub(super) plane: f32,
    /// Its world coordinate.
    pub(super) world: f64,
    pub(super) below: usize,
    pub(super) above: usize,
}

impl Sweep {
    /// Sorts the ends of extents, which can be in any order.
    pub(super) fn new(extents: impl Iterator<Item = [f64; 2]>) -> Self {
        let (mut lows, mut highs): (Vec<f64>, Vec<f64>) = extents.map(|[lo, hi]| (lo, hi)).unzip();
        lows.sort_unstable_by(f64::total_cmp);
        highs.sort_unstable_by(f64::total_cmp);
        Sweep { lows, highs }
    }

    /// Returns the planes inside the cell that are more than the length `epsilon` below the start
    /// of an object, then those above the end of an object; both in ascending order.
    pub(super) fn planes<'a>(
        &'a self,
        cell: &'a Cell<'_>,
        axis: Axis,
        epsilon: f64,
    ) -> impl Iterator<Item = CandidatePlane> + 'a {
        let below_lows = self
            .lows
            .iter()
            .map(move |&lo| cell.frame.plane_below(axis, lo - epsilon));
        let above_highs = self
            .highs
            .iter()
            .map(move |&hi| cell.frame.plane_above(axis, hi + epsilon));
        let slack = cell.frame.slack();
        let mut last = f32::NAN;
        below_lows
            .chain(above_highs)
            .filter(move |&plane| {
                let new = plane != last;
                last = plane;
                new && cell.divides(axis, plane)
            })
            .map(move |plane| {
                let world = cell.frame.to_world(axis, f64::from(plane));
                // As in the driver, an object within the slack of the plane counts on both sides.
                CandidatePlane {
                    plane,
                    world,
                    below: self.lows.partition_point(|&lo| lo <= world + slack),
                    above: self.highs.len() - self.highs.partition_point(|&hi| hi < world - slack),
                }
            })
    }
}

/// Returns how `cost` compares with another cost. Costs that differ only by rounding are equal, or noise
/// would decide the many ties of symmetric scenes.
pub(super) fn compare_costs(cost: f64, other: f64) -> Ordering {
    let rounding = 1e-12 * other.abs();
    if cost < other - rounding {
        Ordering::Less
    } else if cost <= other + rounding {
        Ordering::Equal
    } else {
        Ordering::Greater
    }
}

/// Surface areas of the two parts of a cell, as linear functions of the plane.
pub(super) struct Areas {
    lo: f64,
    hi: f64,
    /// Area of the two faces parallel to the plane.
    faces: f64,
    /// Area of the other four faces per unit of length.
    rim: f64,
}

impl Areas {
    pub(super) fn new(bounds: &Aabb, axis: Axis) -> Self {
        let (k, size) = (axis.index(), bounds.size());
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        Areas {
            lo: bounds.lo[k],
            hi: bounds.hi[k],
            faces: 2.0 * u * v,
            rim: 2.0 * (u + v),
        }
    }

    /// Returns the number of objects on each side of a plane (world coordinate) times the area of
    /// that side, summed over both sides.
    pub(super) fn weigh(&self, plane: f64, below: usize, above: usize) -> f64 {
        below as f64 * self.below(plane) + above as f64 * self.above(plane)
    }

    fn below(&self, plane: f64) -> f64 {
        self.faces + self.rim * (plane - self.lo)
    }

    fn above(&self, plane: f64) -> f64 {
        self.faces + self.rim * (self.hi - plane)
    }
}
