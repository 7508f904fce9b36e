//! The coordinates of the root cell, in which split planes are stored.
//!
//! In them the root cell is the cube from −1 to 1. Halving it twenty times needs 20 bits, so
//! midpoints are exact in `f32`; a scene that is moved or scaled as a whole keeps its tree; and a
//! node needs only 8 bytes while scenes and rays stay `f64`. Rays are taken into these coordinates
//! once; their parameter `t` stays the same.

use crate::geometry::{Aabb, Axis, Vec3};

/// The lower and upper end of an object by axis, each as the nearest storable plane.
pub type ObjectPlanes = [[f32; 2]; 3];

/// Maps between the world and the coordinates of a root cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    center: Vec3,
    half: Vec3,
    slack: f64,
}

impl Frame {
    /// The frame of a root cell around `bounds`, enlarged by the length `margin` on every side.
    ///
    /// Flat and empty bounds are given the least extent that arithmetic can tell from none.
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
            slack,
        }
    }

    /// The root cell in the world.
    pub fn cell(&self) -> Aabb {
        Aabb::new(self.center - self.half, self.center + self.half)
    }

    /// The centre of the root cell and half its edges, in the world.
    #[inline]
    pub fn center_and_half(&self) -> (Vec3, Vec3) {
        (self.center, self.half)
    }

    /// How far apart (a length) rounding can put equal coordinates inside the root cell. An object
    /// this near to a plane belongs to both sides.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// World coordinate of a plane.
    #[inline]
    pub fn to_world(&self, axis: Axis, plane: f64) -> f64 {
        self.center[axis.index()] + self.half[axis.index()] * plane
    }

    /// A point in the coordinates of the root cell.
    #[inline]
    pub fn point_to_local(&self, point: Vec3) -> Vec3 {
        (point - self.center) / self.half
    }

    /// A direction in the coordinates of the root cell; its length changes, `t` does not.
    #[inline]
    pub fn direction_to_local(&self, direction: Vec3) -> Vec3 {
        direction / self.half
    }

    /// The storable plane nearest to a world coordinate.
    pub fn nearest_plane(&self, axis: Axis, world: f64) -> f32 {
        ((world - self.center[axis.index()]) / self.half[axis.index()]) as f32
    }

    /// The storable planes nearest to the lower and upper ends of a box, by axis.
    #[inline]
    pub fn planes_around(&self, bounds: &Aabb) -> ObjectPlanes {
        let lo = self.point_to_local(bounds.lo).as_vec3();
        let hi = self.point_to_local(bounds.hi).as_vec3();
        std::array::from_fn(|k| [lo[k], hi[k]])
    }

    /// The highest storable plane strictly below a world coordinate, by more than [`Frame::slack`].
    pub fn plane_below(&self, axis: Axis, world: f64) -> f32 {
        // Starting two slacks away takes few steps even where `f32` is finest, around zero.
        let mut plane = self.nearest_plane(axis, world - 2.0 * self.slack);
        while self.to_world(axis, f64::from(plane)) >= world - self.slack && plane.is_finite() {
            plane = plane.next_down();
        }
        plane
    }

    /// The lowest storable plane strictly above a world coordinate, by more than [`Frame::slack`].
    pub fn plane_above(&self, axis: Axis, world: f64) -> f32 {
        let mut plane = self.nearest_plane(axis, world + 2.0 * self.slack);
        while self.to_world(axis, f64::from(plane)) <= world + self.slack && plane.is_finite() {
            plane = plane.next_up();
        }
        plane
    }
}

/// Whether a box does more than touch a cell from outside; both are given by their planes. A flat box
/// in the plane between two cells is inside both.
#[inline]
pub fn is_inside(planes: &ObjectPlanes, cell: &[[f32; 2]; 3]) -> bool {
    // Without branches: which objects only touch is hard to foresee.
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
