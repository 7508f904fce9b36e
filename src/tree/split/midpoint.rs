//! The paper's method 1: the middle of the cell, axes in cyclic order; or along the longest axis.

use super::axis_order::{AxisOrder, LONGEST_AXIS};
use super::{Cell, Decision, MethodInfo, SplitRule, Structure};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "midpoint",
    title: "Midpoint, axes in turn (method 1)",
    about: "Splits every cell in the middle, with axes in cyclic order x, y, z, or along its longest \
            axis.",
    source: "A. S. Glassner, Space subdivision for fast ray tracing, 1984; K. Sung and P. Shirley, \
             Ray tracing with the BSP tree, Graphics Gems III, 1992; the paper's method 1",
    paper: Some(1),
    paper_spheres_exactly: true,
    structure: Structure::Bintree,
    constants: &[LONGEST_AXIS],
    rule: |settings| Box::new(Midpoint(AxisOrder::new(settings))),
};

struct Midpoint(AxisOrder);

impl SplitRule for Midpoint {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = self.0.axis(cell);
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }
}
