//! Fast estimates of hits in `f64`, with bounds on their errors.
//!
//! With u = 2⁻⁵³, a sum, difference, product or quotient has a relative error of at most u. A bound counts
//! these errors, rounded up; what a bound itself loses by rounding is far less than that.

use super::Precision;
use super::exact::Surface;
use super::numeric::Shear;
use crate::geometry::{Ray, Vec3};

/// Half a unit of relative precision: the largest relative error of one operation.
pub(super) const U: f64 = 0.5 * f64::EPSILON;

/// Far more than all errors of one estimate by underflow, and far less than any error that matters.
pub(super) const UNDERFLOW: f64 = 1e-290;

/// Bound on the ratio between a distance and the `f32` nearest to it.
const UP: f64 = 1.0 + f32::EPSILON as f64;

/// Where a line crosses a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate {
    t: f64,
    /// Bound on the error of `t`; negative if the line certainly misses, infinite if that is not certain.
    error: f64,
}

impl Estimate {
    pub(crate) const MISS: Estimate = Estimate {
        t: 0.0,
        error: -1.0,
    };
    pub(super) const UNSURE: Estimate = Estimate {
        t: 0.0,
        error: f64::INFINITY,
    };

    #[inline(always)]
    pub(super) fn new(t: f64, error: f64) -> Self {
        Estimate { t, error }
    }

    /// Returns whether the line certainly misses, or crosses outside an interval.
    #[inline(always)]
    pub(super) fn is_outside(&self, [t_min, t_max]: [f64; 2]) -> bool {
        self.error < 0.0 || self.t + self.error < t_min || self.t - self.error > t_max
    }

    /// Returns whether the line certainly crosses within an interval.
    #[inline(always)]
    pub(super) fn is_inside(&self, [t_min, t_max]: [f64; 2]) -> bool {
        self.error >= 0.0 && self.t - self.error >= t_min && self.t + self.error <= t_max
    }

    /// Returns whether the line certainly crosses, wherever.
    #[inline(always)]
    pub(super) fn is_crossing(&self) -> bool {
        self.error >= 0.0 && self.error < f64::INFINITY
    }

    /// Decides the test of a packed object: returns the exact distance rounded to the nearest `f32`, if it is
    /// at most `t_max`. The crossings are in ascending order.
    #[inline(always)]
    pub(crate) fn settle<const N: usize>(
        crossings: [Estimate; N],
        interval: [f64; 2],
        t_max: f64,
        exactly: impl Fn() -> Option<f64>,
    ) -> Option<f64> {
        for crossing in crossings {
            if crossing.is_outside([interval[0], t_max * UP]) {
                continue;
            }
            let Estimate { t, error } = crossing;
            let (lo, hi) = ((t - error) as f32, (t + error) as f32);
            let t = if lo == hi && crossing.is_inside(interval) {
                Some(f64::from(lo))
            } else {
                exactly()
            };
            return t.filter(|&t| t <= t_max);
        }
        None
    }
}

/// Returns where a ray's line crosses a triangle, edges included. The vertices are relative to the ray's
/// origin, each coordinate with a relative error of u, and [rotated](Shear::rotate). Branchless, so that a
/// loop over many triangles is vectorized.
///
/// After Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2(1), 2013). Where `d` is the
/// largest third coordinate and `s` the largest of the other sheared ones:
///
/// - A sheared coordinate `x − k z`, |k| ≤ 1, has the errors u of x and of the sum, and 5 u of k z (1 of z, 2
///   of k, 1 of the product, 1 of the sum). As |x| ≤ s + d, that is at most u r with r = 8 d + 2 s.
/// - An edge function, the difference of two products of such coordinates, has an error of at most
///   4 s u r + 4 u² r² + 3 u s², which is at most `bound` = 7 u r (s + 2 u r), because 2 s ≤ r.
/// - If all edge functions certainly have the same sign, `t` is the mean of the vertices' third
///   coordinates, weighted with them. Errors of the weights move it by at most 3 `bound` / |sum of weights|
///   of the range of these coordinates; 9 operations by 9 u of the largest.
#[inline(always)]
pub(super) fn triangle(vertices: [Vec3; 3], shear: &Shear) -> Estimate {
    let [a, b, c] = vertices.map(|v| shear.apply_rotated(v));
    let size = |v: Vec3| v.x.abs().max(v.y.abs());
    let s = size(a).max(size(b)).max(size(c));
    let [az, bz, cz] = vertices.map(|v| v.z.abs());
    let r = 8.0 * az.max(bz).max(cz) + 2.0 * s + UNDERFLOW;
    let bound = 7.0 * U * r * (s + 2.0 * U * r) + UNDERFLOW;

    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    let (least, most) = (u.min(v).min(w), u.max(v).max(w));
    let is_missed = (least < -bound) & (most > bound);
    let is_crossed = (least > bound) | (most < -bound);

    let sum = u + v + w;
    let t = (u * a.z + v * b.z + w * c.z) / sum;
    let range = a.z.max(b.z).max(c.z) - a.z.min(b.z).min(c.z);
    let largest = a.z.abs().max(b.z.abs()).max(c.z.abs());
    let error = 4.0 * bound / sum.abs() * range + 24.0 * U * largest + UNDERFLOW;
    let known = if is_crossed {
        Estimate { t, error }
    } else {
        Estimate::UNSURE
    };
    if is_missed { Estimate::MISS } else { known }
}

/// Returns where a ray's line crosses a sphere, in ascending order.
///
/// After Haines, Günther and Akenine-Möller, "Precision improvements for ray/sphere intersection" (Ray Tracing
/// Gems, 2019, ch. 7): the discriminant is computed from the offset of the center from the ray, because a
/// difference of squared distances would cancel for a small sphere far away. Where `f` is the sum of the
/// absolute coordinates of the center relative to the origin:
///
/// - The offset has an error of at most δ = 16 u f: u f for the relative center, 8 u f for its position along
///   the ray, and 4 u f for the product and the difference.
/// - The discriminant r² − offset² has an error of at most `spread` = (2 offset + δ) δ + 8 u r'², where r' =
///   r + 2 δ is at least the offset.
/// - The square root of the product with the squared length of the direction, a, has an error of at most
///   a · `spread` / root if the discriminant is at least twice `spread`. The roots have those of the numerator,
///   divided by a; that of the other formula is at most 5 u (f² + r²) / |q| more.
#[inline(always)]
pub(super) fn sphere(center: Vec3, radius: f64, ray: &Ray) -> [Estimate; 2] {
    let direction = ray.direction;
    let a = direction.length_squared();
    let to_center = center - ray.origin;
    let f = to_center.abs().element_sum();
    let b = to_center.dot(direction);
    let offset = (to_center - (b / a) * direction).length_squared();
    let delta = 16.0 * U * f + UNDERFLOW;
    let reach = radius + delta;
    if offset > reach * reach * (1.0 + 16.0 * U) {
        return [Estimate::MISS; 2];
    }
    let squared_radius = radius * radius;
    let discriminant = squared_radius - offset;
    let wide = radius + 2.0 * delta;
    let spread = (2.0 * wide + delta) * delta + 8.0 * U * wide * wide;
    if !(discriminant > 2.0 * spread) {
        return [Estimate::UNSURE; 2];
    }
    let root = (a * discriminant).sqrt();
    let q = b + root.copysign(b);
    let c = to_center.length_squared() - squared_radius;
    let (t0, t1) = (c / q, q / a);
    // √a ≤ (1 + a) / 2.
    let error = 4.0 * U * f * (1.0 + a) / a
        + spread / root
        + 5.0 * U * (f * f + squared_radius) / q.abs()
        + 10.0 * U * t0.abs().max(t1.abs())
        + UNDERFLOW;
    let [near, far] = if t0 < t1 { [t0, t1] } else { [t1, t0] };
    [near, far].map(|t| Estimate { t, error })
}

impl Surface<'_> {
    /// Decides the test of an object: returns the exact distance of the first hit, rounded to the nearest
    /// number, if it is at most `t_max`.
    #[inline(always)]
    pub(super) fn settle<const N: usize>(
        &self,
        crossings: [Estimate; N],
        ray: &Ray,
        t_max: f64,
    ) -> Option<f64> {
        if crossings.iter().all(|c| c.is_outside([ray.t_min, t_max])) {
            return None;
        }
        self.intersect(ray, Precision::F64).filter(|&t| t <= t_max)
    }
}
