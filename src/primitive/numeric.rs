//! Robust arithmetic that the primitives share.

use crate::geometry::{Aabb, Axis, Vec3};

/// Enlarges a box by four units of relative precision of its coordinates, axis by axis, so that points
/// computed on the surface inside stay inside. A coordinate of 0 does not move.
pub(super) fn grown(tight: Aabb) -> Aabb {
    let margin = 4.0 * f64::EPSILON * tight.lo.abs().max(tight.hi.abs());
    Aabb::new(tight.lo - margin, tight.hi + margin)
}

/// Returns whether squares of a direction with this length (or squared length) neither overflow nor
/// underflow.
#[inline]
pub(super) fn is_workable(length: f64) -> bool {
    (1e-200..=1e200).contains(&length)
}

/// Returns whether a plane perpendicular to `axis`, which may be any, certainly lies between the points
/// and the cell; `false` where rounding leaves it open.
pub(super) fn separates(axis: Vec3, points: &[Vec3], cell: &Aabb) -> bool {
    let near = Vec3::select(axis.cmpge(Vec3::ZERO), cell.lo, cell.hi).dot(axis);
    let far = Vec3::select(axis.cmpge(Vec3::ZERO), cell.hi, cell.lo).dot(axis);
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut magnitude = cell.lo.abs().max(cell.hi.abs());
    for &point in points {
        let along = point.dot(axis);
        (lo, hi) = (lo.min(along), hi.max(along));
        magnitude = magnitude.max(point.abs());
    }
    let slack = 8.0 * f64::EPSILON * axis.abs().dot(magnitude);
    lo - far > slack || near - hi > slack
}

/// Returns whether some plane spanned by a coordinate axis and the edge `from`–`to` certainly lies between
/// the points and the cell.
pub(super) fn edge_separates(from: Vec3, to: Vec3, points: &[Vec3], cell: &Aabb) -> bool {
    let edge = to - from;
    [Vec3::X, Vec3::Y, Vec3::Z]
        .into_iter()
        .any(|axis| separates(axis.cross(edge), points, cell))
}

/// Normalizes normals; a zero one becomes the surface's own. `None` if one is not finite.
pub(super) fn unit_normals(normals: &[Vec3], own: Vec3) -> Option<Vec<Vec3>> {
    normals
        .iter()
        .map(|n| {
            // Unit vectors are kept, so that a scene that was written reads back the same.
            if (n.length_squared() - 1.0).abs() <= 16.0 * f64::EPSILON {
                return Some(*n);
            }
            let scale = n.abs().max_element();
            n.is_finite().then(|| (n / scale).normalize_or(own))
        })
        .collect()
}

/// Coordinates in which the ray is the third axis: shearing and scaling make its direction (0, 0, 1).
/// After Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2(1), 2013). Two primitives
/// that share an edge compute identical coordinates of it.
#[derive(Clone, Copy)]
pub(super) struct Shear {
    /// The axis of the direction's largest component.
    axis: Axis,
    x: f64,
    y: f64,
    z: f64,
}

impl Shear {
    /// Returns the shear of a direction; `None` if the direction is so short or long
    /// that this loses precision.
    #[inline]
    pub(super) fn of(direction: Vec3) -> Option<Shear> {
        let axis = Axis::of_largest(direction.abs().to_array());
        let rotated = rotated(direction, axis);
        let shear = Shear::of_rotated(rotated);
        is_workable(rotated.z.abs()).then_some(Shear { axis, ..shear })
    }

    /// Returns the shear of a [`rotated`] direction whose largest component is about 1.
    #[inline(always)]
    pub(super) fn of_rotated(rotated: Vec3) -> Shear {
        let z = 1.0 / rotated.z;
        Shear {
            axis: Axis::Z,
            x: rotated.x * z,
            y: rotated.y * z,
            z,
        }
    }

    /// Rotates coordinates cyclically so that the one along the direction's axis is the last.
    #[inline]
    pub(super) fn rotate(&self, v: Vec3) -> Vec3 {
        rotated(v, self.axis)
    }

    /// Transforms a vector from the ray's origin that is [rotated](Shear::rotate). The third coordinate is
    /// its `t`.
    #[inline(always)]
    pub(super) fn apply_rotated(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.x - self.x * v.z, v.y - self.y * v.z, self.z * v.z)
    }
}

/// Rotates coordinates cyclically so that the one along `axis` is the last.
#[inline]
pub(crate) fn rotated(v: Vec3, axis: Axis) -> Vec3 {
    match axis {
        Axis::X => Vec3::new(v.y, v.z, v.x),
        Axis::Y => Vec3::new(v.z, v.x, v.y),
        Axis::Z => v,
    }
}
