//! Clipping of outlines at the faces of a cell.

use crate::geometry::{Aabb, Axis, Vec3};

/// Cuts off the part of an outline below `limit` along an axis if `side` is 1, above it if `side` is −1
/// (I. E. Sutherland and G. W. Hodgman, Reentrant polygon clipping, 1974). Overwrites `cut`.
pub(crate) fn cut_off(
    outline: &mut Vec<Vec3>,
    cut: &mut Vec<Vec3>,
    axis: Axis,
    limit: f64,
    side: f64,
) {
    let k = axis.index();
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
    std::mem::swap(outline, cut);
}

/// Returns the bounds of the part of a convex or planar outline within a closed cell, if any.
pub(super) fn bounds_of_outline(vertices: &[Vec3], cell: &Aabb) -> Option<Aabb> {
    let mut outline = vertices.to_vec();
    let mut cut = Vec::new();
    for axis in Axis::ALL {
        let k = axis.index();
        for (limit, side) in [(cell.lo[k], 1.0), (cell.hi[k], -1.0)] {
            // Most faces cut nothing off.
            if !outline.iter().all(|v| (v[k] - limit) * side >= 0.0) {
                cut_off(&mut outline, &mut cut, axis, limit, side);
            }
        }
    }
    let part = Aabb::around(outline).intersection(cell);
    (!part.is_empty()).then_some(part)
}

/// Returns a box within a cell that certainly contains an object's part there. `part` returns the bounds of the
/// part within another cell up to rounding: every point of the part is within 64 ε M of them, where M is the
/// largest absolute coordinate of the object's `bounds`.
///
/// Let m be 256 ε M. `part` gets the cell enlarged by m, and its result is enlarged by m. So a point of the part
/// is in the result if intermediate results are within m of exact ones:
///
/// - Outlines. Each of the six cuts moves the vertices that it makes by at most 8 ε M: the distances to the
///   plane are rounded once each, their ratio and the products and sums with it less than 6 times. Let every
///   point of the exact part after i cuts be within 8 i ε M of the computed part, as is true for i = 0. A point
///   that is in the cell is then near a computed point that is at most 8 i ε M beyond the next plane, hence is
///   kept by a plane that is farther out by m. The next cut moves it by at most 8 ε M.
/// - Spheres. The squared reach s² along an axis has an error of at most 8 ε r². If s ≥ r / 8, then s has one of
///   at most 64 ε r. Otherwise the cell is more than 0.7 r from the center along another axis, so the enlarged
///   cell, which is closer by m, has a squared reach that is larger by 256 ε r².
/// - Cones. How far a disc reaches into a slab has an error of at most 8 ε M at both ends, hence between them, and
///   the rounding of the share at which it is 0 changes it by at most 16 ε M. A disc that reaches into the cell
///   reaches by m into the enlarged cell, so it is between the first and the last disc found, of which the boxes
///   have an error of at most 8 ε M.
///
/// Where squares could overflow or underflow, the result is the clipped bounds.
pub(super) fn certain(
    bounds: &Aabb,
    cell: &Aabb,
    part: impl Fn(&Aabb) -> Option<Aabb>,
) -> Option<Aabb> {
    let cell = bounds.intersection(cell);
    let magnitude = bounds.magnitude();
    let is_usual = (1e-140..1e140).contains(&magnitude);
    if cell.is_empty() {
        return None;
    }
    if cell == *bounds || !is_usual {
        return Some(cell);
    }
    let margin = 256.0 * f64::EPSILON * magnitude;
    let part = part(&cell.enlarged(margin))?
        .enlarged(margin)
        .intersection(&cell);
    (!part.is_empty()).then_some(part)
}
