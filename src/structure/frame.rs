//! Local coordinates, in which split planes are stored.
//!
//! In local coordinates the root cell is the cube from −1 to 1. This has three advantages.
//! Midpoints are exact in `f32`, because halving the cube twenty times needs only 20 bits. A scene
//! that is moved or scaled as a whole keeps its tree. And a node needs only 8 bytes, while scenes
//! and rays stay in `f64`. Rays are transformed to local coordinates once; their parameter `t` does
//! not change.

use crate::geometry::{Aabb, Axis, Vec3};

/// The lower and upper end of an object along each axis, as the nearest representable planes.
pub type ObjectPlanes = [[f32; 2]; 3];

/// Converts between world coordinates and the local coordinates of a root cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    center: Vec3,
    half: Vec3,
    margin: f64,
    slack: f64,
}

impl Frame {
    /// Returns the frame of the root cell around `bounds`, enlarged by the length `margin` on every
    /// side. Flat and empty bounds get the smallest extent that arithmetic can distinguish from
    /// zero.
    pub fn around(bounds: &Aabb, margin: f64) -> Self {
        let bounds = if bounds.is_empty() {
            Aabb::new(Vec3::ZERO, Vec3::ZERO)
        } else {
            *bounds
        };
        let slack = 4.0 * f64::EPSILON * (bounds.magnitude() + margin) + f64::MIN_POSITIVE;
        let half = bounds.hi * 0.5 - bounds.lo * 0.5 + margin;
        Frame {
            center: bounds.center(),
            half: half.max(Vec3::splat(4.0 * slack)),
            margin,
            slack,
        }
    }

    /// Returns the frame of a root cell with this center and half size around `bounds`, which extends beyond
    /// them by `margin`. `None` if arithmetic cannot distinguish its size from zero.
    pub(super) fn at(center: Vec3, half: Vec3, margin: f64, bounds: &Aabb) -> Option<Self> {
        let slack = Frame::around(bounds, margin).slack;
        let frame = Frame {
            center,
            half,
            margin,
            slack,
        };
        half.cmpge(Vec3::splat(4.0 * slack)).all().then_some(frame)
    }

    /// Returns the root cell in world coordinates.
    pub fn cell(&self) -> Aabb {
        Aabb::new(self.center - self.half, self.center + self.half)
    }

    /// Returns the center of the root cell and half its size, in world coordinates.
    #[inline]
    pub fn center_and_half(&self) -> (Vec3, Vec3) {
        (self.center, self.half)
    }

    /// Returns the length by which the root cell extends beyond the bounds on every side.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Returns the largest distance that rounding can put between equal coordinates inside the root
    /// cell. An object this close to a plane belongs to both sides.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// Returns the world coordinate of a plane.
    #[inline]
    pub fn to_world(&self, axis: Axis, plane: f64) -> f64 {
        self.center[axis.index()] + self.half[axis.index()] * plane
    }

    /// Converts a point to local coordinates.
    #[inline]
    pub fn point_to_local(&self, point: Vec3) -> Vec3 {
        (point - self.center) / self.half
    }

    /// Converts a direction to local coordinates. Its length changes, but `t` does not.
    #[inline]
    pub fn direction_to_local(&self, direction: Vec3) -> Vec3 {
        direction / self.half
    }

    /// Returns the representable plane nearest to a world coordinate.
    pub fn nearest_plane(&self, axis: Axis, world: f64) -> f32 {
        ((world - self.center[axis.index()]) / self.half[axis.index()]) as f32
    }

    /// Returns the representable planes nearest to the lower and upper ends of a box along each
    /// axis.
    #[inline]
    pub fn planes_around(&self, bounds: &Aabb) -> ObjectPlanes {
        let lo = self.point_to_local(bounds.lo).as_vec3();
        let hi = self.point_to_local(bounds.hi).as_vec3();
        std::array::from_fn(|k| [lo[k], hi[k]])
    }

    /// Returns the highest representable plane that is below a world coordinate by more than
    /// [`Frame::slack`].
    pub fn plane_below(&self, axis: Axis, world: f64) -> f32 {
        // Starting two slacks away needs few steps even around zero, where `f32` is densest.
        let mut plane = self.nearest_plane(axis, world - 2.0 * self.slack);
        while self.to_world(axis, f64::from(plane)) >= world - self.slack && plane.is_finite() {
            plane = plane.next_down();
        }
        plane
    }

    /// Returns the lowest representable plane that is above a world coordinate by more than
    /// [`Frame::slack`].
    pub fn plane_above(&self, axis: Axis, world: f64) -> f32 {
        let mut plane = self.nearest_plane(axis, world + 2.0 * self.slack);
        while self.to_world(axis, f64::from(plane)) <= world + self.slack && plane.is_finite() {
            plane = plane.next_up();
        }
        plane
    }
}

/// Returns whether a box overlaps a cell, as opposed to only touching it from outside. Both are
/// given by their planes. A flat box in the plane between two cells overlaps both.
#[inline]
pub fn is_inside(planes: &ObjectPlanes, cell: &[[f32; 2]; 3]) -> bool {
    // Branchless: whether an object only touches the cell is hard to predict.
    let mut only_touches = false;
    for k in 0..3 {
        let ([lo, hi], [cell_lo, cell_hi]) = (planes[k], cell[k]);
        only_touches |= (hi <= cell_lo) & (lo < cell_lo) | (lo >= cell_hi) & (hi > cell_hi);
    }
    !only_touches
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cell_is_the_bounds_and_the_margin() {
        let bounds = Aabb::new(Vec3::new(-1.0, 2.0, 0.0), Vec3::new(3.0, 2.0, 8.0));
        let cell = Frame::around(&bounds, 0.001).cell();
        assert!((cell.lo - Vec3::new(-1.001, 1.999, -0.001)).length() < 1e-12);
        assert!((cell.hi - Vec3::new(3.001, 2.001, 8.001)).length() < 1e-12);
    }

    #[test]
    fn flat_empty_and_huge_bounds_have_an_extent_that_can_be_divided() {
        let point = Vec3::splat(1e15);
        for bounds in [
            Aabb::EMPTY,
            Aabb::new(point, point),
            Aabb::new(Vec3::splat(-1e30), Vec3::splat(1e30)),
        ] {
            let frame = Frame::around(&bounds, 0.0);
            let cell = frame.cell();
            assert!(cell.lo.cmplt(cell.hi).all(), "{bounds:?}");
            assert!(frame.point_to_local(cell.hi).is_finite());
        }
    }

    #[test]
    fn planes_beside_a_coordinate_lie_strictly_beside_it() {
        let frame = Frame::around(&Aabb::new(Vec3::ZERO, Vec3::splat(3.0)), 0.001);
        for world in [0.0, 0.1, 1.5, 2.999] {
            let below = frame.to_world(Axis::X, f64::from(frame.plane_below(Axis::X, world)));
            let above = frame.to_world(Axis::X, f64::from(frame.plane_above(Axis::X, world)));
            assert!(below < world && world < above);
            assert!(above - below < 1e-6);
        }
    }
}
