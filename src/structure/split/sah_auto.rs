//! The surface-area heuristic with automatic termination.
//!
//! A split that does not lower the expected cost enough counts as failed. It is made anyway,
//! because there may be better splits below it, but only a limited number of times on the path from
//! the root to a leaf. With a limit of 0 and a quality ratio of 1, a cell becomes a leaf if no
//! split costs less than the leaf. The method is meant for automatic `D_MAX`.

use super::rule::{Cell, Decision, SplitRule};
use super::sah::CLIP;
use super::sweep::{Areas, Sweep, compare_costs};
use crate::geometry::{Aabb, Axis};
use crate::primitive::Shape;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use std::cmp::Ordering;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah-auto",
    summary: "surface-area heuristic that decides when to stop",
    about: "Splits at the plane with the lowest expected cost by the surface-area heuristic, and stops \
            after a limited number of splits that gained too little. Best with automatic D_MAX.",
    source: "V. Havran, Heuristic ray shooting algorithms, 2000, and V. Havran and J. Bittner, On \
             improving kd-trees for ray shooting, 2002; after K. R. Subramanian and D. S. Fussell, \
             Automatic termination criteria for ray tracing hierarchies, 1991",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[
        Constant {
            name: "traversal-cost",
            default: 15.0,
            lowest: 0.0,
            highest: 1000.0,
            step: 0.0,
            unit: "",
            about: "Cost of traversing an inner node. Only its ratio to intersection-cost matters.",
            source: "15, 20 and bonus 0.2 are one common set; 1, 80 and bonus 0.5 another (M. Pharr \
                     and G. Humphreys, Physically Based Rendering)",
        },
        Constant {
            name: "intersection-cost",
            default: 20.0,
            lowest: 0.01,
            highest: 1000.0,
            step: 0.0,
            unit: "",
            about: "Cost of an intersection test.",
            source: "as for traversal-cost",
        },
        Constant {
            name: "empty-bonus",
            default: 0.2,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "Fraction by which the cost of a split with an empty side is reduced; 0 for no bonus.",
            source: "as for traversal-cost",
        },
        Constant {
            name: "quality-ratio",
            default: 0.75,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "A split counts as failed if it costs more than this fraction of the cost of a leaf.",
            source: "V. Havran 2000, as commonly quoted",
        },
        Constant {
            name: "failures",
            default: 1.0,
            lowest: 0.0,
            highest: 100.0,
            step: 0.0,
            unit: "splits",
            about: "Failed splits allowed between the root and a leaf, independent of D_MAX.",
            source: "V. Havran 2000, as commonly quoted",
        },
        Constant {
            name: "failures-per-level",
            default: 0.2,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "splits per level",
            about: "Additional failed splits allowed per level of D_MAX.",
            source: "V. Havran 2000, as commonly quoted",
        },
        CLIP,
    ],
    builder: Builder::Cells(|settings| Box::new(SahAuto::new(settings))),
};

struct SahAuto {
    /// Cost of traversing an inner node, in intersection tests.
    traversal_cost: f64,
    /// Factor on the cost of a split with an empty side.
    empty_factor: f64,
    quality_ratio: f64,
    failures: f64,
    failures_per_level: f64,
    clip: bool,
}

impl SahAuto {
    fn new(settings: &BuildSettings) -> Self {
        let constant = |name| settings.constant(name);
        SahAuto {
            traversal_cost: constant("traversal-cost") / constant("intersection-cost"),
            empty_factor: 1.0 - constant("empty-bonus"),
            quality_ratio: constant("quality-ratio"),
            failures: constant("failures"),
            failures_per_level: constant("failures-per-level"),
            clip: constant(CLIP.name) > 0.5,
        }
    }

    /// Returns the cheapest plane with its expected cost in intersection tests; of several, the one nearest
    /// to the middle of the cell.
    fn cheapest(&self, cell: &Cell<'_>) -> Option<(f64, Axis, f32)> {
        let parts: Vec<Aabb> = cell
            .objects()
            .filter_map(|object| self.part(cell, object))
            .collect();
        let whole = cell.bounds.surface_area();
        let mut best: Option<(f64, Axis, f32)> = None;
        let mut best_off_center = f64::INFINITY;
        for axis in Axis::ALL {
            let areas = Areas::new(&cell.bounds, axis);
            let k = axis.index();
            let sweep = Sweep::new(parts.iter().map(|part| [part.lo[k], part.hi[k]]));
            for candidate in sweep.planes(cell, axis, 0.0) {
                let work = areas.weigh(candidate.world, candidate.below, candidate.above) / whole;
                let mut cost = self.traversal_cost + work;
                if candidate.below == 0 || candidate.above == 0 {
                    cost *= self.empty_factor;
                }
                let middle = cell.bounds.center()[k];
                let off_center = ((candidate.world - middle) / cell.bounds.size()[k]).abs();
                let is_better = best.is_none_or(|(least, ..)| match compare_costs(cost, least) {
                    Ordering::Less => true,
                    Ordering::Equal => off_center < best_off_center,
                    Ordering::Greater => false,
                });
                if is_better {
                    best_off_center = off_center;
                    best = Some((cost, axis, candidate.plane));
                }
            }
        }
        best
    }

    /// Returns the bounds of the part of an object within a cell.
    fn part(&self, cell: &Cell<'_>, object: u32) -> Option<Aabb> {
        if self.clip {
            return cell.primitives[object as usize].bounds_within(&cell.bounds);
        }
        let bounds = &cell.object_bounds[object as usize];
        Some(Aabb::new(
            bounds.lo.max(cell.bounds.lo),
            bounds.hi.min(cell.bounds.hi),
        ))
    }

    /// Returns whether one more failed split is allowed in this cell.
    fn may_fail(&self, cell: &Cell<'_>) -> bool {
        let allowed = self.failures + self.failures_per_level * f64::from(cell.depth_limit);
        f64::from(cell.failed_splits) + 1.0 <= allowed
    }
}

impl SplitRule for SahAuto {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let Some((cost, axis, plane)) = self.cheapest(cell) else {
            return Decision::Leaf(StopReason::NoCandidate);
        };
        if cost < self.quality_ratio * cell.object_count() as f64 {
            Decision::Split { axis, plane }
        } else if self.may_fail(cell) {
            Decision::FailedSplit { axis, plane }
        } else {
            Decision::Leaf(StopReason::LeafIsCheaper)
        }
    }
}
