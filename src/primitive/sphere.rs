//! Spheres.

use super::clip::certain;
use super::estimate::{self, Estimate};
use super::exact::{Root, Surface};
use super::{Shape, ShapeError, SurfacePoint, numeric};
use crate::geometry::{Aabb, Ray, Vec3};

/// A sphere. Radius 0 is a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    pub center: Vec3,
    pub radius: f64,
}

impl Sphere {
    /// Creates a sphere.
    ///
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

    /// Returns the squared radius, and what a squared distance of this size may lose by rounding.
    fn squared_reach(&self) -> f64 {
        self.radius * self.radius * (1.0 + 8.0 * f64::EPSILON)
    }

    /// Estimates where the ray's line crosses the sphere, in ascending order.
    #[inline(always)]
    pub(super) fn estimates(&self, ray: &Ray) -> [Estimate; 2] {
        estimate::sphere(self.center, self.radius, ray)
    }

    pub(super) fn exact(&self) -> Surface<'static> {
        Surface::Sphere {
            center: self.center,
            radius: self.radius,
        }
    }
}

impl Shape for Sphere {
    fn bounds(&self) -> Aabb {
        numeric::grown(Aabb::new(
            self.center - self.radius,
            self.center + self.radius,
        ))
    }

    /// Tests the solid ball: whether the point of the cell nearest to the center is within the radius.
    fn overlaps(&self, cell: &Aabb) -> bool {
        let nearest = self.center.clamp(cell.lo, cell.hi);
        nearest.distance_squared(self.center) <= self.squared_reach()
    }

    /// Returns those of the solid ball. Its extent along an axis is that at the point of the cell nearest to
    /// the center in the other two axes.
    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let away = self.center.clamp(cell.lo, cell.hi) - self.center;
        let away = away * away;
        let squared = self.radius * self.radius - Vec3::splat(away.element_sum()) + away;
        let reach = squared.max(Vec3::ZERO).map(f64::sqrt);
        let part = Aabb::new(self.center - reach, self.center + reach).intersection(cell);
        (away.element_sum() <= self.squared_reach() && !part.is_empty()).then_some(part)
    }

    fn certain_bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        certain(&self.bounds(), cell, |cell| self.bounds_within(cell))
    }

    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        self.exact().settle(self.estimates(ray), ray, t_max)
    }

    #[inline]
    fn is_hit(&self, ray: &Ray) -> bool {
        self.exact().settle_any(self.estimates(ray), ray)
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        self.exact().exact_distance(ray)
    }

    /// Returns the diameter.
    fn min_width(&self) -> f64 {
        2.0 * self.radius
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let normal = (ray.at(t) - self.center).normalize_or(Vec3::Z);
        SurfacePoint {
            point: self.center + self.radius * normal,
            normal,
            shading_normal: normal,
            // 2 ε for the unit normal, ε/2 each for its multiple and the sum.
            error: 4.0 * f64::EPSILON * (self.center.abs().element_sum() + self.radius),
        }
    }
}
