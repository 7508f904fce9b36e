//! An octree: every node is split in the middle along all three axes.
//!
//! Its leaves, and so all that is counted of leaves, are those of an octree with children by eights.
//! Its inner nodes are the planes that part the children, seven a node: x, then y, then z.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::Axis;
use crate::structure::method::Structure;
use crate::structure::settings::MethodInfo;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "octree",
    title: "Octree",
    about: "Splits every node in the middle along all three axes into eight. It is held and walked as \
            planes, seven a node: D_MAX, D_REACH and the inner nodes count planes, three levels of \
            them for one of the octree.",
    source: "A. S. Glassner, Space subdivision for fast ray tracing, 1984; as planes: M. R. Kaplan, \
             Space-tracing: a constant time ray-tracer, 1985",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Octree,
    constants: &[],
    rule: |settings| Box::new(Octree(settings.first_axis)),
};

struct Octree(Axis);

impl SplitRule for Octree {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = Axis::from_index(self.0.index() + cell.depth as usize);
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }
}
