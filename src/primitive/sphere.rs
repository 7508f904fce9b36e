//! Spheres.

use super::{Shape, ShapeError, SurfacePoint, numeric};
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
        numeric::grown(Aabb::new(
            self.center - self.radius,
            self.center + self.radius,
        ))
    }

    /// The solid ball: whether the point of the cell nearest the centre is within the radius.
    fn overlaps(&self, cell: &Aabb) -> bool {
        let nearest = self.center.clamp(cell.lo, cell.hi);
        nearest.distance_squared(self.center) <= self.radius * self.radius
    }

    /// The solid ball's: along an axis it reaches as far as at the point of the cell that is nearest
    /// to its centre in the other two.
    fn bounds_within(&self, cell: &Aabb) -> Option<Aabb> {
        let away = self.center.clamp(cell.lo, cell.hi) - self.center;
        let away = away * away;
        let squared = self.radius * self.radius - Vec3::splat(away.element_sum()) + away;
        let reach = squared.max(Vec3::ZERO).map(f64::sqrt);
        let part = Aabb::new(self.center - reach, self.center + reach).intersection(cell);
        (away.element_sum() <= self.radius * self.radius && !part.is_empty()).then_some(part)
    }

    /// After Haines, Günther and Akenine-Möller, "Precision improvements for ray/sphere
    /// intersection" (Ray Tracing Gems, 2019, ch. 7): the discriminant comes from the centre's
    /// offset from the ray, not from a difference of squares of the distance, which would leave
    /// nothing of a small sphere far away; and no root is a difference of nearly equal numbers.
    #[inline]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let direction = ray.direction;
        let a = direction.length_squared();
        if !numeric::is_workable(a) {
            return numeric::with_direction_rescaled(ray, t_max, |r, t| self.intersect(r, t));
        }
        let to_center = self.center - ray.origin;
        let b = to_center.dot(direction);
        let offset = to_center - (b / a) * direction;
        let squared_radius = self.radius * self.radius;
        let discriminant = squared_radius - offset.length_squared();
        if discriminant < 0.0 {
            return None;
        }
        let q = b + (a * discriminant).sqrt().copysign(b);
        let c = to_center.length_squared() - squared_radius;
        let (t0, t1) = (c / q, q / a);
        // Where q is 0, t0 is infinite or no number, and t1 the one root.
        let (near, far) = if t0 < t1 { (t0, t1) } else { (t1, t0) };
        let in_reach = |t: &f64| ray.t_min <= *t && *t <= t_max && t.is_finite();
        Some(near)
            .filter(in_reach)
            .or_else(|| Some(far).filter(in_reach))
    }

    /// The diameter.
    fn min_width(&self) -> f64 {
        2.0 * self.radius
    }

    fn surface(&self, ray: &Ray, t: f64) -> SurfacePoint {
        let normal = (ray.at(t) - self.center).normalize_or(Vec3::Z);
        SurfacePoint {
            point: self.center + self.radius * normal,
            normal,
            shading_normal: normal,
            // The unit normal is good to 2 ε, its multiple and the sum to ε/2 each.
            error: 4.0 * f64::EPSILON * (self.center.abs().element_sum() + self.radius),
        }
    }
}
