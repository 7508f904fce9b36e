//! The surface-area heuristic at a few equally spaced planes, after Octree-R.
//!
//! Octree-R is an octree in which the three planes of a node are not in the middle, but where the
//! estimated number of tests is lowest. This method does the same for one plane at a time, along
//! the cheapest axis or along the axes in cyclic order.

use super::rule::{Cell, Decision, SplitRule};
use super::sweep::{Areas, compare_costs};
use crate::geometry::Axis;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};
use std::cmp::Ordering;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "sah-sampled",
    summary: "surface-area heuristic with sampled planes, as in Octree-R",
    about: "Tries a few equally spaced planes and splits at the one with the lowest expected cost by the \
            surface-area heuristic.",
    source: "K.-Y. Whang, J.-W. Song, J.-W. Chang, J.-Y. Kim, W.-S. Cho, C.-M. Park and I.-Y. Song, \
             Octree-R: an adaptive octree for efficient ray tracing, 1995",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[
        Constant {
            name: "samples",
            default: 7.0,
            lowest: 1.0,
            highest: 255.0,
            step: 1.0,
            unit: "planes",
            about: "Number of planes to try along an axis; 1 tries only the middle.",
            source: "ours: eighths of the cell",
        },
        Constant {
            name: "in-turn",
            default: 0.0,
            lowest: 0.0,
            highest: 1.0,
            step: 1.0,
            unit: "",
            about: "1 uses the axes in cyclic order, so that three levels split all three axes, like a \
                    node of Octree-R; 0 uses the cheapest plane of all axes.",
            source: "ours: a bintree splits by one plane at a time",
        },
        Constant {
            name: "cost-stop",
            default: 1.0,
            lowest: 0.0,
            highest: 1.0,
            step: 1.0,
            unit: "",
            about: "1 makes a leaf if no sampled plane costs less than the leaf, 0 splits anyway.",
            source: "ours, as in sah-cut; with 0 only D_MAX and N_OILF stop splitting, as in Octree-R",
        },
    ],
    builder: Builder::Cells(|settings| Box::new(SahSampled::new(settings))),
};

struct SahSampled {
    samples: u32,
    in_turn: Option<Axis>,
    cost_stop: bool,
}

/// A plane with its cost: the objects on each side, weighted by the area of the side.
#[derive(Clone, Copy)]
struct Candidate {
    axis: Axis,
    plane: f32,
    cost: f64,
    /// Distance from the middle plane, in samples.
    off_center: u32,
}

impl SahSampled {
    fn new(settings: &BuildSettings) -> Self {
        SahSampled {
            samples: settings.constant("samples") as u32,
            in_turn: (settings.constant("in-turn") > 0.5).then_some(settings.first_axis),
            cost_stop: settings.constant("cost-stop") > 0.5,
        }
    }

    fn candidates(&self, cell: &Cell<'_>, axis: Axis) -> impl Iterator<Item = Candidate> {
        let k = axis.index();
        let [lo, hi] = cell.local[k];
        let areas = Areas::new(&cell.bounds, axis);
        let parts = self.samples + 1;
        (1..parts).map(move |sample| {
            let plane = lo + (hi - lo) * (sample as f32 / parts as f32);
            // As in the driver, up to rounding: an object that touches the plane counts on both
            // sides.
            let (mut below, mut above) = (0, 0);
            for object in cell.objects() {
                let [begin, end] = cell.object_planes[object as usize][k];
                below += usize::from(begin <= plane);
                above += usize::from(end >= plane);
            }
            let world = cell.frame.to_world(axis, f64::from(plane));
            Candidate {
                axis,
                plane,
                cost: areas.weigh(world, below, above),
                off_center: (2 * sample).abs_diff(parts),
            }
        })
    }
}

impl SplitRule for SahSampled {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axes = match self.in_turn {
            Some(first) => vec![Axis::from_index(first.index() + cell.depth as usize)],
            None => Axis::ALL.to_vec(),
        };
        // Among equal costs, the plane nearest to the middle.
        let best = axes
            .into_iter()
            .flat_map(|axis| self.candidates(cell, axis))
            .filter(|c| cell.divides(c.axis, c.plane))
            .reduce(|best, other| {
                let by_cost = compare_costs(other.cost, best.cost);
                match by_cost.then(other.off_center.cmp(&best.off_center)) {
                    Ordering::Less => other,
                    _ => best,
                }
            });
        let Some(best) = best else {
            return Decision::Leaf(StopReason::NoCandidate);
        };
        let leaf_cost = cell.object_count() as f64 * cell.bounds.surface_area();
        if self.cost_stop && best.cost >= leaf_cost {
            return Decision::Leaf(StopReason::LeafIsCheaper);
        }
        Decision::Split {
            axis: best.axis,
            plane: best.plane,
        }
    }
}
