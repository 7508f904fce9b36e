//! The object median: the same number of objects below and above the plane.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::Axis;
use crate::structure::method::{Constant, Structure};
use crate::structure::node::StopReason;
use crate::structure::settings::{BuildSettings, Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "object-median",
    summary: "splits at the median of the objects' centers",
    about: "Splits at the median of the objects' centers, so that both halves contain about the same \
            number of objects.",
    source: "M. R. Kaplan, Space-tracing: a constant time ray-tracer, 1985; J. D. MacDonald and \
             K. S. Booth, Heuristics for ray tracing using space subdivision, 1990, section 3",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[Constant {
        name: "longest-axis",
        default: 0.0,
        lowest: 0.0,
        highest: 1.0,
        step: 1.0,
        unit: "",
        about: "1 splits the longest axis of a cell, 0 uses the axes in cyclic order, as method 1 does.",
        source: "ours: with 0, the position of the plane is the only difference from midpoint",
    }],
    builder: Builder::Cells(|settings| Box::new(ObjectMedian::new(settings))),
};

struct ObjectMedian {
    first_axis: Axis,
    longest_axis: bool,
}

impl ObjectMedian {
    fn new(settings: &BuildSettings) -> Self {
        ObjectMedian {
            first_axis: settings.first_axis,
            longest_axis: settings.constant("longest-axis") > 0.5,
        }
    }
}

impl SplitRule for ObjectMedian {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = if self.longest_axis {
            cell.bounds.longest_axis()
        } else {
            Axis::from_index(self.first_axis.index() + cell.depth as usize)
        };
        let mut centers: Vec<f64> = cell
            .objects()
            .map(|object| {
                let [lo, hi] = cell.clipped(object, axis);
                lo * 0.5 + hi * 0.5
            })
            .collect();
        if centers.is_empty() {
            return Decision::Leaf(StopReason::NoCandidate);
        }
        let middle = centers.len() / 2;
        let (_, &mut median, _) = centers.select_nth_unstable_by(middle, f64::total_cmp);
        Decision::Split {
            axis,
            plane: cell.frame.nearest_plane(axis, median),
        }
    }
}
