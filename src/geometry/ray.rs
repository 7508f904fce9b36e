//! Rays with an interval.

use glam::DVec3 as Vec3;

/// Points `origin + t · direction` for `t` in the closed interval `[t_min, t_max]`.
///
/// `direction` need not have unit length. Renderers use unit length, so that `t` is a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
    pub t_min: f64,
    pub t_max: f64,
}

impl Ray {
    /// Returns a ray without an end.
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Ray {
            origin,
            direction,
            t_min: 0.0,
            t_max: f64::INFINITY,
        }
    }

    /// Returns a ray that ends at `t_max`.
    pub const fn to(origin: Vec3, direction: Vec3, t_max: f64) -> Self {
        Ray {
            origin,
            direction,
            t_min: 0.0,
            t_max,
        }
    }

    /// Returns the point at parameter `t`.
    pub fn at(&self, t: f64) -> Vec3 {
        self.origin + t * self.direction
    }
}
