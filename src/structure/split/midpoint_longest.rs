//! The middle of the cell's longest axis.

use super::rule::{Cell, Decision, SplitRule};
use crate::structure::method::Structure;
use crate::structure::settings::MethodInfo;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "midpoint-longest",
    summary: "splits the longest axis in the middle",
    about: "Splits every cell in the middle of its longest axis, or of the first one if several are \
            equally long.",
    source: "I. Wald and V. Havran, On building fast kd-trees for ray tracing, 2006 (spatial median)",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Bintree,
    constants: &[],
    rule: |_| Box::new(MidpointLongest),
};

struct MidpointLongest;

impl SplitRule for MidpointLongest {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = cell.bounds.longest_axis();
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }
}
