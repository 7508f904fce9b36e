//! Fast estimates of hits in `f64`, with bounds on their errors.
//!
//! With u = 2⁻⁵³, a sum, difference, product or quotient has a relative error of at most u. A bound counts
//! these errors, rounded up; what a bound itself loses by rounding is far less than that.

use super::Precision;
use super::exact::{Known, Stage, Surface};
use super::numeric::{Shear, is_workable};
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
    /// The line certainly misses.
    pub(crate) const MISS: Estimate = Estimate {
        t: 0.0,
        error: -1.0,
    };
    /// Nothing is known.
    pub(super) const UNSURE: Estimate = Estimate {
        t: 0.0,
        error: f64::INFINITY,
    };

    /// Estimates where a ray from `origin` crosses a triangle with these vertices, as the exact test of a
    /// triangle does. Coordinates are in cyclic order with the axis of the direction's largest component last.
    /// Branchless, so that a loop over many triangles becomes vectors.
    #[inline(always)]
    pub(crate) fn of_triangle(vertices: [Vec3; 3], origin: Vec3, direction: Vec3) -> Estimate {
        let [a, b, c] = vertices;
        let shear = Shear::of_rotated(direction);
        let estimate = triangle([a - origin, b - origin, c - origin], &shear);
        if is_workable(direction.z.abs()) {
            estimate
        } else {
            Estimate::UNSURE
        }
    }

    #[inline(always)]
    pub(crate) fn new(t: f64, error: f64) -> Self {
        Estimate { t, error }
    }

    /// Returns what [`Estimate::new`] was called with.
    #[inline(always)]
    pub(crate) fn parts(self) -> (f64, f64) {
        (self.t, self.error)
    }

    /// Returns whether the line certainly misses, or crosses outside an interval.
    #[inline(always)]
    pub(super) fn is_outside(&self, [t_min, t_max]: [f64; 2]) -> bool {
        self.error < 0.0 || self.t + self.error < t_min || self.t - self.error > t_max
    }

    /// Returns whether the line certainly crosses within an interval.
    #[inline(always)]
    pub(super) fn is_inside(&self, [t_min, t_max]: [f64; 2]) -> bool {
        self.is_certain() && self.t - self.error >= t_min && self.t + self.error <= t_max
    }

    /// Returns whether the line certainly crosses, wherever.
    #[inline(always)]
    pub(super) fn is_certain(&self) -> bool {
        self.error >= 0.0 && self.error < f64::INFINITY
    }

    /// Returns what is known of the first crossing within an interval, of crossings in ascending order; `None`
    /// if there is certainly none. Crossings beyond `limit` do not matter.
    #[inline(always)]
    pub(super) fn first<const N: usize>(
        crossings: &[Estimate; N],
        interval: [f64; 2],
        limit: f64,
    ) -> Option<Known> {
        for (k, crossing) in crossings.iter().enumerate() {
            if !crossing.is_outside([interval[0], limit]) {
                return Some(if crossing.is_inside(interval) {
                    Known::Hit(k)
                } else if N == 1 && crossing.is_certain() {
                    Known::Crossing
                } else {
                    Known::Nothing
                });
            }
        }
        None
    }

    /// Decides the test of a packed object: returns the exact distance of the first hit, rounded to the
    /// nearest `f32`, if it is at most `t_max`. `exactly` returns it without estimates; its argument is as
    /// in [`Surface::intersect`].
    #[inline(always)]
    pub(crate) fn settle<const N: usize>(
        crossings: [Estimate; N],
        interval: [f64; 2],
        t_max: f64,
        exactly: impl Fn(Known) -> Option<f64>,
    ) -> Option<f64> {
        let known = Estimate::first(&crossings, interval, t_max * UP)?;
        let rounded = match known {
            Known::Hit(k) => {
                let Estimate { t, error } = crossings[k];
                let (lo, hi) = ((t - error) as f32, (t + error) as f32);
                (lo == hi).then(|| f64::from(lo))
            }
            _ => None,
        };
        let t = match rounded {
            Some(t) => Some(t),
            None => exactly(known),
        };
        t.filter(|&t| t <= t_max)
    }
}

/// Returns the larger number, or the second if one is NaN: one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Returns the smaller number, likewise.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Returns where a ray's line crosses a triangle, edges included.
#[inline(always)]
pub(super) fn triangle_at(vertices: &[Vec3; 3], ray: &Ray) -> Estimate {
    let Some(shear) = Shear::of(ray.direction) else {
        return Estimate::UNSURE;
    };
    let relative = |v: Vec3| shear.rotate(v - ray.origin);
    let [a, b, c] = *vertices;
    triangle([relative(a), relative(b), relative(c)], &shear)
}

/// [`triangle_at`] with vertices that are relative to the ray's origin, each coordinate with a relative error
/// of u, and [rotated](Shear::rotate). Branchless, so that a loop over many triangles is vectorized. If two
/// edge functions are numbers, all coordinates are.
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
    let largest3 = |a: f64, b: f64, c: f64| larger(larger(a.abs(), b.abs()), c.abs());
    let s = larger(largest3(a.x, b.x, c.x), largest3(a.y, b.y, c.y));
    let d = largest3(vertices[0].z, vertices[1].z, vertices[2].z);
    let r = 8.0 * d + 2.0 * s + UNDERFLOW;
    let bound = 7.0 * U * r * (s + 2.0 * U * r) + UNDERFLOW;

    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    let least = smaller(smaller(u, v), w);
    let most = larger(larger(u, v), w);
    let is_missed = (least < -bound) & (most > bound);
    let is_crossed = (least > bound) | (most < -bound);

    let sum = u + v + w;
    let t = (u * a.z + v * b.z + w * c.z) / sum;
    let range = larger(larger(a.z, b.z), c.z) - smaller(smaller(a.z, b.z), c.z);
    let largest = largest3(a.z, b.z, c.z);
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
/// - Half the sum of the roots, b / a, has an error of at most 4 u f / √a; the square root of a times the
///   discriminant one of at most a · `spread` / root if the discriminant is at least twice `spread`. So the
///   larger root, q / a, has an error of `eq` / a and 6 u of itself.
/// - The smaller root, c / q, where c is the squared distance from the center minus r², has an error of
///   5 u of their sum divided by q, and twice `eq` / q and 4 u of itself. So the surface that a ray has
///   just left is not mistaken for a hit.
#[inline(always)]
pub(super) fn sphere(center: Vec3, radius: f64, ray: &Ray) -> [Estimate; 2] {
    let direction = ray.direction;
    let a = direction.length_squared();
    if !is_workable(a) {
        return [Estimate::UNSURE; 2];
    }
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
    let is_positive = discriminant > 2.0 * spread;
    if !is_positive {
        return [Estimate::UNSURE; 2];
    }
    let root = (a * discriminant).sqrt();
    let q = b + root.copysign(b);
    let c = to_center.length_squared() - squared_radius;
    let (t0, t1) = (c / q, q / a);
    // √a ≤ (1 + a) / 2.
    let eq = 2.0 * U * f * (1.0 + a) + a * spread / root + 2.0 * U * q.abs();
    let sum = c + 2.0 * squared_radius;
    let e0 = (5.0 * U * sum + 2.0 * eq * t0.abs()) / q.abs() + 6.0 * U * t0.abs() + UNDERFLOW;
    let e1 = eq / a + 8.0 * U * t1.abs() + UNDERFLOW;
    let [t0, t1] = [Estimate::new(t0, e0), Estimate::new(t1, e1)];
    if t0.t < t1.t { [t0, t1] } else { [t1, t0] }
}

/// An edge that crosses the first axis, with bounds on the errors of where.
#[derive(Clone, Copy)]
struct EdgeCrossing {
    x: f64,
    x_error: f64,
    t: f64,
    t_error: f64,
}

/// Returns where a ray's line crosses the area within an outline, outline included, as
/// [`Surface::Outline`] defines it.
///
/// A sheared coordinate has an error of at most `e` = u r, an edge function one of at most `bound`
/// ([`triangle`]). An edge crosses the first axis at edge function / rise; the rise has an
/// error of 2 e, and so the place one of 2 (`bound` + 2 e |place|) / rise as long as that is small. The
/// distance there is interpolated between those of the vertices, with an error of 2 e / rise of their
/// difference; likewise that between both ends of the chord.
#[inline(always)]
pub(super) fn outline(vertices: impl Iterator<Item = Vec3> + Clone, ray: &Ray) -> Estimate {
    let Some(shear) = Shear::of(ray.direction) else {
        return Estimate::UNSURE;
    };
    let relative = vertices.map(|v| shear.rotate(v - ray.origin));
    let Some(last) = relative.clone().last() else {
        return Estimate::MISS;
    };
    let (mut from, mut a) = (last, shear.apply_rotated(last));
    let (mut left, mut right): (Option<EdgeCrossing>, Option<EdgeCrossing>) = (None, None);
    let (mut inside, mut is_ambiguous) = (false, false);
    let (mut area, mut area_error, mut largest) = (0.0, 0.0, 0.0_f64);
    for to in relative {
        let b = shear.apply_rotated(to);
        let size = a.x.abs().max(a.y.abs()).max(b.x.abs()).max(b.y.abs());
        let r = 8.0 * from.z.abs().max(to.z.abs()) + 2.0 * size + UNDERFLOW;
        let e = U * r;
        let bound = 7.0 * e * (size + 2.0 * e) + UNDERFLOW;
        let cross = a.x * b.y - a.y * b.x;
        area += cross;
        area_error += 2.0 * bound;
        largest = largest.max(b.z.abs());
        let is_near = a.y.abs() <= 2.0 * e || b.y.abs() <= 2.0 * e;
        let is_straddling = (a.y > 0.0) != (b.y > 0.0);
        let has_side = cross.abs() > 4.0 * bound;
        if (is_near || is_straddling) && !has_side {
            return Estimate::UNSURE;
        }
        if is_straddling {
            let rise = b.y - a.y;
            let is_steep = rise.abs() > 8.0 * e;
            if !is_steep {
                return Estimate::UNSURE;
            }
            let x = cross / rise;
            let share = 4.0 * e / rise.abs();
            let depth = (b.z - a.z).abs() + 8.0 * U * (a.z.abs() + b.z.abs());
            let crossing = EdgeCrossing {
                x,
                x_error: 2.0 * bound / rise.abs() + share * x.abs() + 4.0 * U * x.abs(),
                t: (a.z * b.y - a.y * b.z) / rise,
                t_error: 2.0 * share * depth + 16.0 * U * (a.z.abs() + b.z.abs()),
            };
            let nearest = if x > 0.0 {
                inside = !inside;
                &mut right
            } else {
                &mut left
            };
            match nearest {
                Some(other) => {
                    let are_apart = (other.x - x).abs() > other.x_error + crossing.x_error;
                    is_ambiguous |= !are_apart;
                    if x.abs() < other.x.abs() {
                        *other = crossing;
                    }
                }
                None => *nearest = Some(crossing),
            }
        }
        (from, a) = (to, b);
    }
    match (inside, left, right) {
        (false, ..) => Estimate::MISS,
        (true, Some(left), Some(right)) if !is_ambiguous => {
            let chord = right.x - left.x;
            let error = left.x_error + right.x_error;
            if !(area.abs() > area_error && chord > 4.0 * error) {
                return Estimate::UNSURE;
            }
            let t = (left.t * right.x - right.t * left.x) / chord;
            let t_error = left.t_error.max(right.t_error);
            let depth = (right.t - left.t).abs() + 2.0 * t_error;
            let rounding = 16.0 * U * (left.t.abs() + right.t.abs() + largest);
            Estimate::new(
                t,
                2.0 * (t_error + depth * error / chord) + rounding + UNDERFLOW,
            )
        }
        _ => Estimate::UNSURE,
    }
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
        let known = Estimate::first(&crossings, [ray.t_min, ray.t_max], t_max)?;
        self.intersect(known, ray, Precision::F64)
            .filter(|&t| t <= t_max)
    }

    /// Decides whether an object is hit.
    #[inline(always)]
    pub(super) fn settle_any<const N: usize>(&self, crossings: [Estimate; N], ray: &Ray) -> bool {
        match Estimate::first(&crossings, [ray.t_min, ray.t_max], ray.t_max) {
            None => false,
            Some(Known::Hit(_)) => true,
            Some(known) => self.is_hit(known, ray),
        }
    }

    /// Returns the arithmetic that decides a test: [`Surface::settle`] with this limit, or
    /// [`Surface::settle_any`] without one.
    pub(super) fn deciding_stage<const N: usize>(
        &self,
        crossings: [Estimate; N],
        ray: &Ray,
        limit: Option<f64>,
    ) -> Stage {
        let interval = [ray.t_min, ray.t_max];
        match Estimate::first(&crossings, interval, limit.unwrap_or(ray.t_max)) {
            None => Stage::Estimate,
            Some(Known::Hit(_)) if limit.is_none() => Stage::Estimate,
            Some(known) => self.stage(known, ray, limit.is_some()),
        }
    }
}
