//! Boxes that a ray certainly misses.

use crate::geometry::{Aabb, Ray, Vec3};

/// Bound on relative rounding errors: far more than those of the few operations on any number here.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Returns a box enlarged by its own rounding, for [`Meeting::may_meet`].
pub fn enlarged(bounds: &Aabb) -> Aabb {
    bounds.enlarged(ROUNDING * bounds.magnitude() + f64::MIN_POSITIVE)
}

/// A ray that is tested against boxes.
pub struct Meeting {
    origin: Vec3,
    direction: Vec3,
    inverse: Vec3,
    /// Rounding of the origin.
    slack: f64,
    forward_only: bool,
}

impl Meeting {
    /// Creates the test of a ray with a direction.
    pub fn of(ray: &Ray) -> Self {
        // Scaled so that neither the direction nor its inverse overflows.
        let scaled = ray.direction / ray.direction.abs().max_element();
        Meeting {
            origin: ray.origin,
            direction: ray.direction,
            inverse: 1.0 / scaled,
            slack: ROUNDING * ray.origin.abs().max_element(),
            forward_only: ray.t_min >= 0.0,
        }
    }

    /// Returns whether the ray may meet an [`enlarged`] box. `true` is conservative; `false` is certain: the
    /// box contains what it was made for with a margin of 64 ε of all coordinates, each distance has an error
    /// of at most 3 ε, and both ends of each interval are widened by 64 ε.
    pub fn may_meet(&self, bounds: &Aabb) -> bool {
        let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
        for k in 0..3 {
            let (lo, hi) = (bounds.lo[k] - self.slack, bounds.hi[k] + self.slack);
            if self.direction[k] == 0.0 {
                if self.origin[k] < lo || self.origin[k] > hi {
                    return false;
                }
            } else if self.inverse[k].is_finite() {
                let a = (lo - self.origin[k]) * self.inverse[k];
                let b = (hi - self.origin[k]) * self.inverse[k];
                let (near, far) = (a.min(b), a.max(b));
                enter = enter.max(near - ROUNDING * near.abs());
                exit = exit.min(far + ROUNDING * far.abs());
            }
        }
        enter <= exit && (exit >= 0.0 || !self.forward_only)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_touches_a_box_may_meet_it_and_what_is_apart_does_not() {
        let unit = enlarged(&Aabb::new(Vec3::ZERO, Vec3::ONE));
        let meets = |origin: Vec3, direction: Vec3| {
            Meeting::of(&Ray::new(origin, direction)).may_meet(&unit)
        };
        let origin = Vec3::new(-3.0, 0.5, 0.5);
        assert!(meets(origin, Vec3::X) && meets(origin, Vec3::X * 1e300));
        assert!(!meets(origin, -Vec3::X) && !meets(origin, Vec3::Y));
        // Along a side, at a corner, and with components too small for an inverse.
        assert!(meets(Vec3::new(-3.0, 1.0, 1.0), Vec3::X));
        assert!(meets(Vec3::splat(-3.0), Vec3::ONE));
        assert!(meets(
            Vec3::new(-3.0, 1.0, 0.0),
            Vec3::new(1.0, 5e-324, 0.0)
        ));
        assert!(!meets(Vec3::new(-3.0, 1.1, 0.0), Vec3::X));
        assert!(!meets(Vec3::new(-3.0, 1.1, 0.0), Vec3::new(1.0, 1e-3, 0.0)));
    }
}
