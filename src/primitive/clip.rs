//! Clipping of outlines at the faces of a cell.

use crate::geometry::{Aabb, Axis, Vec3};

/// Returns the bounds of the part of a convex or planar outline within a closed cell, if any
/// (I. E. Sutherland and G. W. Hodgman, Reentrant polygon clipping, 1974).
pub(super) fn bounds_of_outline(vertices: &[Vec3], cell: &Aabb) -> Option<Aabb> {
    let mut outline = vertices.to_vec();
    let mut cut = Vec::with_capacity(outline.len() + 6);
    for axis in Axis::ALL {
        let k = axis.index();
        for (limit, side) in [(cell.lo[k], 1.0), (cell.hi[k], -1.0)] {
            let inside = |v: Vec3| (v[k] - limit) * side;
            cut.clear();
            for (i, &from) in outline.iter().enumerate() {
                let to = outline[(i + 1) % outline.len()];
                let (a, b) = (inside(from), inside(to));
                if a >= 0.0 {
                    cut.push(from);
                }
                if (a < 0.0) != (b < 0.0) {
                    let mut point = from + (to - from) * (a / (a - b));
                    point[k] = limit;
                    cut.push(point);
                }
            }
            std::mem::swap(&mut outline, &mut cut);
        }
    }
    let part = Aabb::around(outline).intersection(cell);
    (!part.is_empty()).then_some(part)
}
