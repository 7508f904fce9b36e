//! The coordinates that represent a scene in `f32`.

use crate::geometry::{Aabb, Vec3};

/// Coordinates with the scene's center as origin, scaled by a power of two so that the scene's longest
/// edge is from ½ to 1: its coordinates are at most ½.
///
/// So the precision does not depend on the position and size of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitFrame {
    /// The scene's center, scaled.
    center: Vec3,
    scale: f64,
}

impl UnitFrame {
    /// Returns the frame of a scene with these bounds. A scene without extent is not scaled.
    pub fn around(bounds: &Aabb) -> Self {
        let half = (bounds.hi * 0.5 - bounds.lo * 0.5).max_element();
        if bounds.is_empty() || half == 0.0 {
            let center = if bounds.is_empty() {
                Vec3::ZERO
            } else {
                bounds.lo
            };
            return UnitFrame { center, scale: 1.0 };
        }
        let scale = libm::scalbn(1.0, -(libm::ilogb(half) + 2));
        UnitFrame {
            center: bounds.center() * scale,
            scale,
        }
    }

    /// Returns the ratio of lengths here to those in the world: a power of two.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns the scene's center, scaled: what [`UnitFrame::point`] subtracts.
    pub(crate) fn center(&self) -> Vec3 {
        self.center
    }

    /// Transforms a point of the world.
    #[inline]
    pub fn point(&self, world: Vec3) -> Vec3 {
        // Scales first because the difference of two huge coordinates may overflow.
        world * self.scale - self.center
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_of_any_size_and_place_fills_the_cube() {
        for (size, offset) in [
            (1.0, 0.0),
            (3e30, 0.0),
            (1e-30, 0.0),
            (1e300, 0.0),
            (1.0, 1e12),
        ] {
            let lo = Vec3::splat(offset);
            let bounds = Aabb::new(lo, lo + size * Vec3::new(1.0, 0.5, 0.0));
            let frame = UnitFrame::around(&bounds);
            let (lo, hi) = (frame.point(bounds.lo), frame.point(bounds.hi));
            assert!(
                (0.5..=1.0).contains(&(hi - lo).x),
                "{size} {offset}: {lo} {hi}"
            );
            assert!(lo.abs().max(hi.abs()).max_element() <= 0.5);
        }
    }

    #[test]
    fn a_scene_without_extent_stays_finite() {
        for bounds in [Aabb::EMPTY, Aabb::new(Vec3::ONE, Vec3::ONE)] {
            assert_eq!(UnitFrame::around(&bounds).scale(), 1.0);
        }
        let point = Aabb::new(Vec3::ONE, Vec3::ONE);
        assert_eq!(UnitFrame::around(&point).point(Vec3::ONE), Vec3::ZERO);
    }
}
