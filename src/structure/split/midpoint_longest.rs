//! The middle of the cell's longest axis.

use super::rule::{Cell, Decision, SplitRule};
use crate::geometry::{Axis, Vec3};
use crate::structure::method::Structure;
use crate::structure::settings::{Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "midpoint-longest",
    summary: "splits the longest axis in the middle",
    about: "Splits every cell in the middle of its longest axis, or of the first one if several are \
            equally long.",
    source: "I. Wald and V. Havran, On building fast kd-trees for ray tracing, 2006 (spatial median)",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Bintree,
    has_limits: true,
    constants: &[],
    builder: Builder::Cells(|_| Box::new(MidpointLongest)),
};

struct MidpointLongest;

impl SplitRule for MidpointLongest {
    fn decide(&self, cell: &Cell<'_>) -> Decision {
        let axis = longest_axis(cell.bounds.size());
        Decision::Split {
            axis,
            plane: cell.midpoint(axis),
        }
    }

    fn slices(&self, cell: &Cell<'_>, levels: u32) -> Option<[f64; 3]> {
        let (mut size, mut slices) = (cell.bounds.size(), [1.0_f64; 3]);
        for _ in 0..levels {
            let axis = longest_axis(size).index();
            size[axis] *= 0.5;
            slices[axis] *= 2.0;
        }
        // Rounding may decide between edges of equal length otherwise in some parts of the cell.
        Some(slices.map(|n| (n * 0.5).max(1.0)))
    }
}

/// Returns the axis of the longest edge; the first of equals. Edges that differ only by rounding are equal,
/// or a scene that is scaled or moved would get another tree.
fn longest_axis(size: Vec3) -> Axis {
    const ROUNDING: f64 = 1e-9;
    let longest = size.max_element() * (1.0 - ROUNDING);
    let mut axes = Axis::ALL.into_iter();
    axes.find(|axis| size[axis.index()] >= longest)
        .unwrap_or(Axis::X)
}
