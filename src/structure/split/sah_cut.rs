//! The paper's method 2: the surface-area heuristic, and cutting off empty space.
//!
//! The paper gives no details. This is rule Q, which came closest to the paper's figures in a
//! search over many variants; every choice of that search is a setting here. Candidates are planes
//! just outside the bounds of the objects, clipped to the cell. A gap is cut only if the best split
//! is cheaper than a leaf. A cut takes out the gap with two planes and counts as one level.

use super::rule::{Cell, Decision, SplitRule};
use super::sweep::{Areas, CandidatePlane, Sweep, compare_costs};
use crate::geometry::Axis;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use std::cmp::Ordering;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah-cut",
    summary: "surface-area heuristic, cuts off empty space (the paper's method 2)",
    about: "Splits at the plane with the lowest expected cost by the surface-area heuristic, and cuts off \
            empty space around and between the objects of the node.",
    source: "J. D. MacDonald and K. S. Booth, Heuristics for ray tracing using space subdivision, \
             1990; the paper's method 2",
    paper: Some(2),
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[
        Constant {
            name: "epsilon",
            default: 1e-6,
            lowest: 0.0,
            highest: 0.1,
            step: 0.0,
            unit: "of 1000 root margins",
            about: "Distance of planes from the bounds of an object. With the paper's root margin of 0.001 \
                    it is a length in the scene's units.",
            source: "search for method 2: 1e-7 to 1e-5 fit the paper's figures",
        },
        Constant {
            name: "median-interval",
            default: 0.3,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "of the cell's width",
            about: "Candidate planes are limited to the interval between the spatial and the object \
                    median, extended by this on both sides; 1 allows all.",
            source: "rule Q of the search; MacDonald and Booth 1990: the best plane lies between \
                     the medians, the object median being the upper median of all bounds",
        },
        Constant {
            name: "gap-fraction",
            default: 0.2,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "of the cell's width",
            about: "The widest gap between objects is cut out if it is wider than this; 1 cuts none.",
            source: "rule Q of the search",
        },
        Constant {
            name: "empty-factor",
            default: 1.0,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "Factor on the cost of a split with an empty side; below 1 favors cutting off empty \
                    space.",
            source: "1 in rule Q, 0.85 in rule R of the search",
        },
        Constant {
            name: "cost-stop",
            default: 1.0,
            lowest: 0.0,
            highest: 1.0,
            step: 1.0,
            unit: "",
            about: "1 makes a leaf if no split costs less than the leaf, 0 splits anyway.",
            source: "rule Q of the search: in tetra, cost stops splitting before depth does",
        },
    ],
    builder: Builder::Cells(|settings| Box::new(SahCut::new(settings))),
};

struct SahCut {
    /// In units of 1000 root margins.
    epsilon: f64,
    median_interval: f64,
    gap_fraction: f64,
    empty_factor: f64,
    cost_stop: bool,
}

/// A plane with the expected cost of a ray if the cell is split there.
#[derive(Clone, Copy)]
struct Candidate {
    axis: Axis,
    plane: f32,
    /// Number of objects times area, summed over both sides.
    cost: f64,
    /// Distance from the middle of the cell, as a fraction of its width.
    off_center: f64,
}

impl SahCut {
    fn new(settings: &BuildSettings) -> Self {
        SahCut {
            epsilon: settings.constant("epsilon"),
            median_interval: settings.constant("median-interval"),
            gap_fraction: settings.constant("gap-fraction"),
            empty_factor: settings.constant("empty-factor"),
            cost_stop: settings.constant("cost-stop") > 0.5,
        }
    }

    /// Returns the distance of planes from the bounds of an object, as a length.
    fn plane_distance(&self, cell: &Cell<'_>) -> f64 {
        self.epsilon * (1000.0 * cell.frame.margin())
    }

    /// Updates `best` with the planes of an axis. Returns the widest gap between objects, if it is
    /// wide enough to cut: its fraction of the cell's width, and its ends.
    fn search(
        &self,
        cell: &Cell<'_>,
        axis: Axis,
        best: &mut Option<Candidate>,
    ) -> Option<(f64, [f64; 2])> {
        let (k, epsilon) = (axis.index(), self.plane_distance(cell));
        let (cell_lo, cell_hi) = (cell.bounds.lo[k], cell.bounds.hi[k]);
        let width = cell_hi - cell_lo;
        let mut extents: Vec<[f64; 2]> = cell
            .objects()
            .map(|object| cell.clipped(object, axis))
            .collect();
        extents.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let sweep = Sweep::new(extents.iter().copied());

        let spatial_median = cell_lo * 0.5 + cell_hi * 0.5;
        let object_median = upper_median(&sweep.lows, &sweep.highs);
        let reach = self.median_interval * width;
        let from = spatial_median.min(object_median) - reach;
        let to = spatial_median.max(object_median) + reach;

        let areas = Areas::new(&cell.bounds, axis);
        for CandidatePlane {
            plane,
            world,
            below,
            above,
        } in sweep.planes(cell, axis, epsilon)
        {
            if world < from || world > to {
                continue;
            }
            let mut cost = areas.weigh(world, below, above);
            if below == 0 || above == 0 {
                cost *= self.empty_factor;
            }
            let candidate = Candidate {
                axis,
                plane,
                cost,
                off_center: ((world - spatial_median) / width).abs(),
            };
            if best.is_none_or(|best| candidate.beats(&best)) {
                *best = Some(candidate);
            }
        }
        widest_gap(&extents)
            .map(|ends| ((ends[1] - ends[0]) / width, ends))
            .filter(|&(share, _)| share > self.gap_fraction)
    }
}

impl Candidate {
    /// Returns whether this candidate is cheaper, or equally cheap and nearer to the middle of the
    /// cell.
    fn beats(&self, other: &Candidate) -> bool {
        match compare_costs(self.cost, other.cost) {
            Ordering::Less => true,
            Ordering::Equal => self.off_center < other.off_center,
            Ordering::Greater => false,
        }
    }
}

impl SplitRule for SahCut {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let mut best = None;
        let mut gap: Option<(f64, Axis, [f64; 2])> = None;
        for axis in Axis::ALL {
            if let Some((share, ends)) = self.search(cell, axis, &mut best)
                && gap.is_none_or(|(widest, ..)| share > widest)
            {
                gap = Some((share, axis, ends));
            }
        }
        let Some(best) = best else {
            return Decision::Leaf(StopReason::NoCandidate);
        };
        let leaf_cost = cell.object_count() as f64 * cell.bounds.surface_area();
        if self.cost_stop && best.cost >= leaf_cost {
            return Decision::Leaf(StopReason::LeafIsCheaper);
        }
        if let Some((_, axis, [lower, upper])) = gap {
            let epsilon = self.plane_distance(cell);
            let slab = [
                cell.frame.plane_above(axis, lower + epsilon),
                cell.frame.plane_below(axis, upper - epsilon),
            ];
            if slab[0] < slab[1] && slab.iter().all(|&plane| cell.divides(axis, plane)) {
                return Decision::Cut { axis, slab };
            }
        }
        Decision::Split {
            axis: best.axis,
            plane: best.plane,
        }
    }
}

/// Returns the upper median of all bounds, given as two sorted lists of equal length.
fn upper_median(lows: &[f64], highs: &[f64]) -> f64 {
    let (mut i, mut k) = (0, 0);
    let mut median = f64::NAN;
    for _ in 0..=lows.len() {
        median = if k >= highs.len() || (i < lows.len() && lows[i] <= highs[k]) {
            i += 1;
            lows[i - 1]
        } else {
            k += 1;
            highs[k - 1]
        };
    }
    median
}

/// Returns the widest gap between objects; extents are sorted by their lower ends.
fn widest_gap(extents: &[[f64; 2]]) -> Option<[f64; 2]> {
    let mut widest: Option<[f64; 2]> = None;
    let mut covered = extents.first()?[1];
    for &[lo, hi] in extents {
        if lo - covered > widest.map_or(0.0, |[from, to]| to - from) {
            widest = Some([covered, lo]);
        }
        covered = covered.max(hi);
    }
    widest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_of_all_bounds_is_the_upper_of_the_middle_two() {
        assert_eq!(upper_median(&[0.0, 1.0], &[2.0, 3.0]), 2.0);
        assert_eq!(upper_median(&[0.0], &[4.0]), 4.0);
        assert_eq!(upper_median(&[0.0, 5.0, 6.0], &[1.0, 8.0, 9.0]), 6.0);
    }

    #[test]
    fn the_widest_gap_lies_between_objects_and_is_not_covered_by_a_long_one() {
        assert_eq!(
            widest_gap(&[[0.0, 1.0], [3.0, 4.0], [4.5, 5.0]]),
            Some([1.0, 3.0])
        );
        assert_eq!(widest_gap(&[[0.0, 4.0], [1.0, 2.0], [3.5, 5.0]]), None);
        assert_eq!(widest_gap(&[]), None);
    }
}
