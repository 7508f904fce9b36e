//! Spheres.

use super::{Shape, ShapeError, SurfacePoint};
use crate::geometry::{Aabb, Ray, Vec3};

/// A sphere; radius 0 is a point that no ray hits but by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    pub center: Vec3,
    pub radius: f64,
}

impl Sphere {
    /// # Errors
    /// A number that is not finite, or a negative radius.
    pub fn new(center: Vec3, radius: f64) -> Result<Self, ShapeError> {
        if !center.is_finite() || !radius.is_finite() {
            return Err(ShapeError::NotFinite);
        }
        if radius < 0.0 {
            return Err(ShapeError::NegativeRadius(radius));
        }
        Ok(Sphere { center, radius })
    }
}

impl Shape for Sphere {
    fn bounds(&self) -> Aabb {
        Aabb::new(self.center - self.radius, self.center + self.radius)
    }

    fn overlaps(&self, cell: &Aabb) -> bool {
        let nearest = self.center.clamp(cell.lo, cell.hi);
        nearest.distance_squared(self.center) <= self.radius * self.radius
    }

    fn intersect(&self, _ray: &Ray, _t_max: f64) -> Option<f64> {
        None
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let normal = (ray.at(t) - self.center).normalize_or(Vec3::Z);
        SurfacePoint {
            point: self.center + self.radius * normal,
            normal,
            shading_normal: normal,
            error: 0.0,
        }
    }
}
