//! The object median: as many objects below the plane as above it.

use super::axis_order::{AxisOrder, LONGEST_AXIS};
use super::{Cell, Decision, MethodInfo, SplitRule, Structure};
use crate::tree::StopReason;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "object-median",
    title: "Object median",
    about: "Splits at the median of the objects' centres, so that both halves hold about as many.",
    source: "M. R. Kaplan, Space-tracing: a constant time ray-tracer, 1985; J. D. MacDonald and \
             K. S. Booth, Heuristics for ray tracing using space subdivision, 1990, section 3",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    constants: &[LONGEST_AXIS],
    rule: |settings| Box::new(ObjectMedian(AxisOrder::new(settings))),
};

struct ObjectMedian(AxisOrder);

impl SplitRule for ObjectMedian {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = self.0.axis(cell);
        let mut centers: Vec<f64> = cell
            .objects
            .iter()
            .map(|&object| {
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
