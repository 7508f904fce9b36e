//! Bins: references are sorted into intervals of equal width by their centers, and splits between these are tried.

use super::costs::Costs;
use super::reference::Reference;
use crate::geometry::Aabb;
use rayon::prelude::*;

/// The bins of a node along one axis.
#[derive(Clone, Copy, Debug)]
pub struct Bins {
    pub axis: usize,
    lo: f64,
    per_length: f64,
    count: usize,
}

impl Bins {
    /// Divides the range from `lo` to `hi`; `None` if it is too short to be divided.
    pub fn new(axis: usize, [lo, hi]: [f64; 2], count: usize) -> Option<Self> {
        let bins = Bins::or_one(axis, [lo, hi], count);
        (bins.per_length > 0.0).then_some(bins)
    }

    /// Does the same, but puts everything into the first bin if the range is too short.
    fn or_one(axis: usize, [lo, hi]: [f64; 2], count: usize) -> Self {
        let per_length = count as f64 / (hi - lo);
        let is_long = lo < hi && per_length.is_finite();
        Bins {
            axis,
            lo,
            per_length: if is_long { per_length } else { 0.0 },
            count,
        }
    }

    /// Returns the bin of a coordinate.
    pub fn of(&self, coordinate: f64) -> usize {
        // There are at most 1024 bins, and `i32` converts fastest.
        let bin = ((coordinate - self.lo) * self.per_length) as i32;
        (bin.max(0) as usize).min(self.count - 1)
    }

    /// Returns the bin of a reference by its center.
    pub fn of_center(&self, reference: &Reference) -> usize {
        self.of(reference.center()[self.axis])
    }
}

/// The cheapest split of references between bins.
#[derive(Clone, Copy, Debug)]
pub struct Between {
    pub bins: Bins,
    /// The references in the bins before this one are on the left.
    pub first_right: usize,
    pub cost: f64,
    /// The bounds on the left and on the right.
    pub sides: [Aabb; 2],
}

/// What a bin holds: the bounds and the number of its references.
type Bin = (Aabb, usize);

/// The bins of the three axes. Memory for many nodes.
#[derive(Clone, Default)]
pub struct Held([Vec<Bin>; 3]);

impl Held {
    fn clear(&mut self, bins: usize) {
        for held in &mut self.0 {
            held.clear();
            held.resize(bins, (Aabb::EMPTY, 0));
        }
    }

    fn add(&mut self, all: &[Bins; 3], list: &[Reference]) {
        for reference in list {
            let center = reference.center();
            for (held, bins) in self.0.iter_mut().zip(all) {
                let (bounds, count) = &mut held[bins.of(center[bins.axis])];
                *bounds = bounds.union(&reference.bounds);
                *count += 1;
            }
        }
    }

    /// Adds what others hold.
    fn merge(mut self, others: &Held) -> Held {
        for (held, others) in self.0.iter_mut().zip(&others.0) {
            for (bin, more) in held.iter_mut().zip(others) {
                *bin = (bin.0.union(&more.0), bin.1 + more.1);
            }
        }
        self
    }
}

/// Returns the cheapest split between `count` bins per axis of the range `centers`, which holds the centers of
/// all references. Of equal costs, the first axis and bin is taken. `None` if no axis can be divided.
pub fn cheapest_between(
    list: &[Reference],
    centers: &Aabb,
    count: usize,
    costs: &Costs,
    held: &mut Held,
) -> Option<Between> {
    /// References that one thread sorts into bins.
    const CHUNK: usize = 1 << 15;
    let all = [0, 1, 2].map(|axis| Bins::or_one(axis, [centers.lo[axis], centers.hi[axis]], count));
    held.clear(count);
    if list.len() > 2 * CHUNK && rayon::current_num_threads() > 1 {
        let empty = held.clone();
        let parts = list.par_chunks(CHUNK).map(|part| {
            let mut held = empty.clone();
            held.add(&all, part);
            held
        });
        // Least, greatest and sum of numbers do not depend on their order.
        *held = parts.reduce(|| empty.clone(), |a, b| a.merge(&b));
    } else {
        held.add(&all, list);
    }
    let mut best: Option<Between> = None;
    // By the last bin on the left that holds references: bounds and costs of the bins behind it.
    let mut rest: Vec<(usize, Aabb, f64)> = Vec::with_capacity(count);
    for (bins, held) in all.into_iter().zip(&held.0) {
        rest.clear();
        let (mut right, mut on_right) = (Aabb::EMPTY, 0);
        for (bin, (bounds, number)) in held.iter().enumerate().rev() {
            if *number > 0 {
                let cost = costs.of_part((right, on_right));
                rest.push((bin, right, cost));
                right = right.union(bounds);
                on_right += number;
            }
        }
        let (mut left, mut on_left) = (Aabb::EMPTY, 0);
        // Behind the last one there is nothing.
        for &(bin, right, cost_of_right) in rest.iter().skip(1).rev() {
            left = left.union(&held[bin].0);
            on_left += held[bin].1;
            let cost = costs.of_part((left, on_left)) + cost_of_right;
            if best.is_none_or(|best| cost < best.cost) {
                best = Some(Between {
                    bins,
                    first_right: bin + 1,
                    cost,
                    sides: [left, right],
                });
            }
        }
    }
    best
}
