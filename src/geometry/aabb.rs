//! Axis-aligned boxes: bounds of objects and cells of trees.

use super::Axis;
use glam::DVec3 as Vec3;
use serde::{Deserialize, Serialize};

/// An axis-aligned closed box. Empty where `lo > hi` on any axis ([`Aabb::EMPTY`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aabb {
    pub lo: Vec3,
    pub hi: Vec3,
}

impl Aabb {
    /// The empty box: the neutral element of [`Aabb::union`].
    pub const EMPTY: Aabb = Aabb {
        lo: Vec3::INFINITY,
        hi: Vec3::NEG_INFINITY,
    };

    pub const fn new(lo: Vec3, hi: Vec3) -> Self {
        Aabb { lo, hi }
    }

    /// Returns the tight box around points; empty without points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points
            .into_iter()
            .fold(Aabb::EMPTY, |b, p| Aabb::new(b.lo.min(p), b.hi.max(p)))
    }

    pub fn is_empty(&self) -> bool {
        !self.lo.cmple(self.hi).all()
    }

    pub fn union(&self, other: &Aabb) -> Aabb {
        Aabb::new(self.lo.min(other.lo), self.hi.max(other.hi))
    }

    pub fn intersection(&self, other: &Aabb) -> Aabb {
        Aabb::new(self.lo.max(other.lo), self.hi.min(other.hi))
    }

    /// Returns whether two closed boxes share a point; touching counts.
    pub fn touches(&self, other: &Aabb) -> bool {
        self.lo.cmple(other.hi).all() && other.lo.cmple(self.hi).all()
    }

    pub fn contains(&self, point: Vec3) -> bool {
        self.lo.cmple(point).all() && point.cmple(self.hi).all()
    }

    /// Returns the box enlarged by `margin` (a length) on every side.
    pub fn enlarged(&self, margin: f64) -> Aabb {
        Aabb::new(self.lo - margin, self.hi + margin)
    }

    /// Returns the edge lengths; zero for an empty box.
    pub fn size(&self) -> Vec3 {
        if self.is_empty() {
            Vec3::ZERO
        } else {
            self.hi - self.lo
        }
    }

    pub fn center(&self) -> Vec3 {
        self.lo * 0.5 + self.hi * 0.5
    }

    /// Returns the volume; 0 for an empty or flat box.
    pub fn volume(&self) -> f64 {
        let size = self.size();
        size.x * size.y * size.z
    }

    /// Returns the surface area; 0 for an empty box.
    pub fn surface_area(&self) -> f64 {
        let size = self.size();
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Returns the largest absolute coordinate of any corner: the scale of rounding errors in the box.
    pub fn magnitude(&self) -> f64 {
        self.lo.abs().max(self.hi.abs()).max_element()
    }

    /// Returns the axis of the longest edge; the first of equals.
    pub fn longest_axis(&self) -> Axis {
        let size = self.size();
        if size.x >= size.y && size.x >= size.z {
            Axis::X
        } else if size.y >= size.z {
            Axis::Y
        } else {
            Axis::Z
        }
    }

    /// Returns the two closed parts below and above a plane, which is clamped to the box.
    pub fn split(&self, axis: Axis, plane: f64) -> (Aabb, Aabb) {
        let (mut below, mut above) = (*self, *self);
        let plane = plane.clamp(self.lo[axis.index()], self.hi[axis.index()]);
        below.hi[axis.index()] = plane;
        above.lo[axis.index()] = plane;
        (below, above)
    }

    /// Returns the eight corners; bit `k` of the index selects `hi` on axis `k`.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            Vec3::new(
                if i & 1 == 0 { self.lo.x } else { self.hi.x },
                if i & 2 == 0 { self.lo.y } else { self.hi.y },
                if i & 4 == 0 { self.lo.z } else { self.hi.z },
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_box_is_neutral_and_without_extent() {
        let unit = Aabb::new(Vec3::ZERO, Vec3::ONE);
        assert!(Aabb::EMPTY.is_empty());
        assert_eq!(Aabb::EMPTY.union(&unit), unit);
        assert_eq!(Aabb::EMPTY.volume(), 0.0);
        assert_eq!(Aabb::EMPTY.surface_area(), 0.0);
        assert!(!Aabb::EMPTY.touches(&unit));
    }

    #[test]
    fn touching_faces_count_and_a_gap_does_not() {
        let unit = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let right = Aabb::new(Vec3::X, Vec3::new(2.0, 1.0, 1.0));
        assert!(unit.touches(&right));
        assert!(!unit.touches(&Aabb::new(right.lo + 1e-15, right.hi)));
    }

    #[test]
    fn halves_of_a_split_fill_the_box() {
        let b = Aabb::new(Vec3::new(-1.0, 2.0, 3.0), Vec3::new(4.0, 5.0, 7.0));
        let (below, above) = b.split(Axis::Y, 3.0);
        assert_eq!(below.volume() + above.volume(), b.volume());
        assert_eq!(below.union(&above), b);
        assert_eq!(b.longest_axis(), Axis::X);
    }
}
