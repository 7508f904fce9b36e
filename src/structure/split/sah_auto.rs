//! The surface-area heuristic with automatic termination.
//!
//! A split that does not lower the expected cost far enough counts as failed. It is made all the
//! same, for there may be better ones below it, but only so many on the way from the root to a leaf.
//! With no such allowance and a quality ratio of 1, a cell is a leaf where no split costs less: the
//! plain cost stop. The method's greatest depth is that of `D_MAX` automatic.

use super::rule::{Cell, Decision, SplitRule};
use super::sah::CLIP;
use super::sweep::{Areas, Sweep};
use crate::geometry::{Aabb, Axis};
use crate::primitive::Shape;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah-auto",
    title: "Surface area, automatic termination",
    about: "Splits where the surface-area heuristic expects rays to cost least, and ends where so \
            many splits gained too little; best with D_MAX automatic.",
    source: "V. Havran, Heuristic ray shooting algorithms, 2000, and V. Havran and J. Bittner, On \
             improving kd-trees for ray shooting, 2002; after K. R. Subramanian and D. S. Fussell, \
             Automatic termination criteria for ray tracing hierarchies, 1991",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    constants: &[
        Constant {
            name: "traversal-cost",
            default: 15.0,
            lowest: 0.0,
            highest: 1000.0,
            step: 0.0,
            unit: "",
            about: "Cost of passing an inner node. Only its ratio to intersection-cost counts.",
            source: "15, 20 and bonus 0.2 are one set in use, 1, 80 and bonus 0.5 another (M. Pharr \
                     and G. Humphreys, Physically Based Rendering)",
        },
        Constant {
            name: "intersection-cost",
            default: 20.0,
            lowest: 0.01,
            highest: 1000.0,
            step: 0.0,
            unit: "",
            about: "Cost of testing an object.",
            source: "as for traversal-cost",
        },
        Constant {
            name: "empty-bonus",
            default: 0.2,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "Share of its cost that a split with an empty side is let off; 0 favours none.",
            source: "as for traversal-cost",
        },
        Constant {
            name: "quality-ratio",
            default: 0.75,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "",
            about: "A split fails if it costs more than this share of what the leaf costs.",
            source: "V. Havran 2000, as commonly quoted",
        },
        Constant {
            name: "failures",
            default: 1.0,
            lowest: 0.0,
            highest: 100.0,
            step: 0.0,
            unit: "splits",
            about: "Failed splits allowed between the root and a leaf, whatever D_MAX is.",
            source: "V. Havran 2000, as commonly quoted",
        },
        Constant {
            name: "failures-per-level",
            default: 0.2,
            lowest: 0.0,
            highest: 1.0,
            step: 0.0,
            unit: "splits a level",
            about: "Failed splits allowed in addition to those per level of D_MAX.",
            source: "V. Havran 2000, as commonly quoted",
        },
        CLIP,
    ],
    rule: |settings| Box::new(SahAuto::new(settings)),
};

struct SahAuto {
    /// Cost of passing an inner node, in tests of an object.
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

    /// The cheapest plane with its expected cost, in tests of an object; of equal ones the first.
    fn cheapest(&self, cell: &Cell<'_>) -> Option<(f64, Axis, f32)> {
        let parts: Vec<Aabb> = cell
            .objects()
            .filter_map(|object| self.part(cell, object))
            .collect();
        let whole = cell.bounds.surface_area();
        let mut best: Option<(f64, Axis, f32)> = None;
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
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, axis, candidate.plane));
                }
            }
        }
        best
    }

    /// The bounds of an object's part within a cell.
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

    /// Whether there may be one more failed split above a cell's leaves.
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
