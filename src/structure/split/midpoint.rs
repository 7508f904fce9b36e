//! The paper's method 1: the middle of the cell, axes in cyclic order.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::Axis;
use crate::structure::method::Structure;
use crate::structure::settings::{Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "midpoint",
    summary: "splits in the middle, axes in cyclic order (the paper's method 1)",
    about: "Splits every cell in the middle, with the axes in cyclic order x, y, z.",
    source: "A. S. Glassner, Space subdivision for fast ray tracing, 1984; K. Sung and P. Shirley, \
             Ray tracing with the BSP tree, Graphics Gems III, 1992; the paper's method 1",
    paper: Some(1),
    paper_spheres_exactly: true,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[],
    builder: Builder::Cells(|settings| Box::new(Midpoint(settings.first_axis))),
};

/// Splits in the middle, with the axes in cyclic order from this one.
pub(super) struct Midpoint(pub(super) Axis);

impl SplitRule for Midpoint {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = Axis::from_index(self.0.index() + cell.depth as usize);
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }

    fn slices(&self, cell: &Cell<'_>, levels: u32) -> Option<[f64; 3]> {
        let mut slices = [1.0; 3];
        for depth in cell.depth..cell.depth + levels {
            slices[Axis::from_index(self.0.index() + depth as usize).index()] *= 2.0;
        }
        Some(slices)
    }
}
