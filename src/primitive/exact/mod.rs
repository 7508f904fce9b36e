//! Exact decisions: whether and where a ray meets a surface.
//!
//! Every decision is the sign of an expression in the stored coordinates. An expression is first evaluated
//! in `f64` where it is fast and with a bound on the error ([`super::estimate`]). What that leaves open is
//! evaluated with twice the precision ([`DoubleWord`]), which also rounds distances correctly. What is
//! still open is evaluated without rounding ([`Dyadic`]).
//!
//! So a surface is hit exactly where its coordinates say, and distances are the exact ones rounded to the
//! nearest number. Rounding keeps the order: the exact distances of two hits need to be compared only where
//! the rounded ones are equal ([`super::Shape::exact_distance`]).
//!
//! The approach is that of Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates" (Discrete & Computational Geometry 18, 1997).

mod distance;
mod double_word;
mod dyadic;
mod flat;
mod number;
mod quadric;
mod root;
mod vector;

pub(crate) use flat::nearest_in_plane;
pub(super) use number::Unsure;
pub(crate) use quadric::ConeEnds;
pub use root::Root;

use super::Precision;
use crate::geometry::{Ray, Vec3};
use distance::{Crossings, Distance, Round};
use double_word::DoubleWord;
use dyadic::Dyadic;
use number::Number;
use std::cmp::Ordering;

/// A surface, by the numbers that define it.
#[derive(Clone, Copy)]
pub(super) enum Surface<'a> {
    Sphere {
        center: Vec3,
        radius: f64,
    },
    Triangle(&'a [Vec3; 3]),
    /// The outline of a polygon.
    Outline(&'a [Vec3]),
    Cone(ConeEnds),
}

/// What is known of a line and a surface before it is decided exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Known {
    Nothing,
    /// The line crosses a surface that it can cross only once.
    Crossing,
    /// The crossing with this index, in ascending order, is the first one within the ray's interval.
    Hit(usize),
}

/// The arithmetic that decides a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// `f64` with a bound on the error.
    Estimate,
    /// Sums of two `f64`.
    DoubleWords,
    /// Integers of any size.
    Integers,
}

impl Surface<'_> {
    /// Returns where the ray's line crosses the surface, in ascending order.
    #[inline(always)]
    fn crossings<N: Number>(&self, ray: &Ray) -> Result<Crossings<N>, Unsure> {
        match self {
            Surface::Sphere { center, radius } => quadric::sphere(*center, *radius, ray),
            Surface::Triangle(vertices) => Ok([flat::triangle(vertices, ray)?, None]),
            Surface::Outline(vertices) => Ok([flat::outline(vertices, ray)?, None]),
            Surface::Cone(ends) => {
                let (mut roots, height) = quadric::cone(ends, ray)?;
                for root in &mut roots {
                    if let Some(t) = root
                        && !height.is_within(t)?
                    {
                        *root = None;
                    }
                }
                Ok(roots)
            }
        }
    }

    /// Returns the crossing number `k` in ascending order, which the line certainly has.
    #[inline(always)]
    fn known_crossing<N: Number>(
        &self,
        k: usize,
        ray: &Ray,
    ) -> Result<Option<Distance<N>>, Unsure> {
        let [near, far] = match self {
            Surface::Sphere { center, radius } => quadric::sphere(*center, *radius, ray)?,
            Surface::Cone(ends) => quadric::cone(ends, ray)?.0,
            Surface::Triangle(vertices) => return flat::plane(vertices, ray),
            Surface::Outline([a, b, c]) => return flat::plane(&[*a, *b, *c], ray),
            Surface::Outline(vertices) => return flat::outline(vertices, ray),
        };
        Ok(if k == 0 { near } else { far })
    }

    /// Returns the first crossing within the ray's interval.
    #[inline(always)]
    fn first<N: Number>(&self, known: Known, ray: &Ray) -> Result<Option<Distance<N>>, Unsure> {
        let crossings = match known {
            Known::Hit(k) => return self.known_crossing(k, ray),
            Known::Crossing => [self.known_crossing(0, ray)?, None],
            Known::Nothing => self.crossings(ray)?,
        };
        for crossing in crossings.into_iter().flatten() {
            if crossing.compare(ray.t_min)? != Ordering::Less
                && crossing.compare(ray.t_max)? != Ordering::Greater
            {
                return Ok(Some(crossing));
            }
        }
        Ok(None)
    }

    /// Returns the distance of the first hit, rounded to the nearest number; `None` if that is infinite.
    pub(super) fn intersect(&self, known: Known, ray: &Ray, precision: Precision) -> Option<f64> {
        self.decide(known, ray, Some(precision))
            .filter(|t| t.is_finite())
    }

    /// Returns whether [`Surface::intersect`] finds a hit.
    pub(super) fn is_hit(&self, known: Known, ray: &Ray) -> bool {
        if ray.t_max.is_finite() {
            self.decide(known, ray, None).is_some()
        } else {
            self.intersect(known, ray, Precision::F64).is_some()
        }
    }

    /// Returns the distance of the first hit, rounded to the nearest number; any number without a precision.
    fn decide(&self, known: Known, ray: &Ray, precision: Option<Precision>) -> Option<f64> {
        if !is_usable(ray) {
            return None;
        }
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("fma") {
            // SAFETY: the processor has the instructions.
            return unsafe { self.decide_with_fma(known, ray, precision) };
        }
        self.decide_with::<false>(known, ray, precision)
    }

    /// # Safety
    /// The processor must have fused multiply-add instructions.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "fma")]
    unsafe fn decide_with_fma(
        &self,
        known: Known,
        ray: &Ray,
        precision: Option<Precision>,
    ) -> Option<f64> {
        self.decide_with::<true>(known, ray, precision)
    }

    #[inline(always)]
    fn decide_with<const FMA: bool>(
        &self,
        known: Known,
        ray: &Ray,
        precision: Option<Precision>,
    ) -> Option<f64> {
        self.decide_in::<DoubleWord<FMA>>(known, ray, precision)
            .unwrap_or_else(|Unsure| self.decide_without_rounding(known, ray, precision))
    }

    /// [`Surface::decide`] with the numbers `N`.
    #[inline(always)]
    fn decide_in<N: Number>(
        &self,
        known: Known,
        ray: &Ray,
        precision: Option<Precision>,
    ) -> Result<Option<f64>, Unsure>
    where
        Distance<N>: Round,
    {
        let round = |t: Distance<N>| precision.map_or(Ok(0.0), |p| t.nearest(p));
        self.first::<N>(known, ray)?.map(round).transpose()
    }

    #[cold]
    #[inline(never)]
    fn decide_without_rounding(
        &self,
        known: Known,
        ray: &Ray,
        precision: Option<Precision>,
    ) -> Option<f64> {
        certain(self.decide_in::<Dyadic>(known, ray, precision))
    }

    /// Returns the arithmetic that [`Surface::intersect`] or [`Surface::is_hit`] needs.
    pub(super) fn stage(&self, known: Known, ray: &Ray, with_distance: bool) -> Stage {
        let precision = with_distance.then_some(Precision::F64);
        match self.decide_in::<DoubleWord<false>>(known, ray, precision) {
            Ok(_) => Stage::DoubleWords,
            Err(Unsure) => Stage::Integers,
        }
    }

    /// Returns the exact distance of the first hit, which there is.
    #[cold]
    pub(super) fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        if !is_usable(ray) {
            return None;
        }
        Some(match self.axis_of_plane() {
            Some((k, place)) => {
                let distance = Dyadic::difference(place, ray.origin[k]);
                let over = Dyadic::of(ray.direction[k]).to_rational();
                Root::from(distance.to_rational() / over)
            }
            None => certain(self.first::<Dyadic>(Known::Nothing, ray))?.root(),
        })
    }

    /// Returns the axis and the place of the plane in which the surface lies, if that is perpendicular to an
    /// axis.
    fn axis_of_plane(&self) -> Option<(usize, f64)> {
        let vertices = match self {
            Surface::Triangle(vertices) => vertices.as_slice(),
            Surface::Outline(vertices) => vertices,
            _ => return None,
        };
        let first = vertices.first()?;
        let is_flat = |k: &usize| vertices.iter().all(|v| v[*k] == first[*k]);
        (0..3).find(is_flat).map(|k| (k, first[k]))
    }
}

/// Returns whether a point certainly lies in the plane of a triangle, exactly. `false` may be wrong.
pub(super) fn is_in_plane(triangle: &[Vec3; 3], point: Vec3) -> bool {
    flat::height::<DoubleWord<false>>(triangle, point).sign() == Ok(Ordering::Equal)
}

/// Returns a result of arithmetic that rounds nothing.
fn certain<T>(result: Result<T, Unsure>) -> T {
    result.unwrap_or_else(|Unsure| unreachable!("integers have certain signs"))
}

/// Returns whether a ray has a direction and an interval.
fn is_usable(ray: &Ray) -> bool {
    ray.origin.is_finite()
        && ray.direction.is_finite()
        && ray.direction != Vec3::ZERO
        && ray.t_min <= ray.t_max
}

#[cfg(test)]
mod tests {
    use super::super::{Cone, Polygon, Shape, Sphere, Triangle};
    use super::*;

    /// Numbers from −1 to 1, the same everywhere.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (self.0 >> 10) as f64 / (1u64 << 53) as f64 - 1.0
        }

        fn vector(&mut self) -> Vec3 {
            Vec3::new(self.next(), self.next(), self.next())
        }

        /// From 10⁻ⁿ to 10ⁿ.
        fn scale(&mut self, n: f64) -> f64 {
            10f64.powf(n * self.next())
        }
    }

    /// Calls `check` with surfaces of every kind and rays that barely hit or miss them, or do so by far.
    fn each_case(count: usize, mut check: impl FnMut(&Surface<'_>, &dyn Shape, &Ray)) {
        let mut n = Numbers(1);
        for i in 0..count {
            let (size, place) = (n.scale(9.0), n.scale(6.0) * n.vector());
            let corner = |n: &mut Numbers| place + size * n.vector();
            let vertices = [corner(&mut n), corner(&mut n), corner(&mut n)];
            let [a, b, c] = vertices;
            let radius = size * n.next().abs();
            let eye = place + n.scale(9.0) * n.vector();
            let off = n.scale(20.0).min(1.0) * size * n.vector();
            let across = (eye - a).any_orthonormal_vector();
            let share = (i % 9) as f64 / 8.0;
            let quad = vec![a, b, c, a + (c - b)];
            let cone = Cone::new(a, radius, b, radius * (i % 3) as f64 * 0.5);
            let side = (a - eye).cross(b - a).normalize_or(Vec3::X);
            let mut shoot = |surface: &Surface<'_>, shape: &dyn Shape, target: Vec3| {
                for off in [Vec3::ZERO, off] {
                    let direction = target + off - eye;
                    let length =
                        [1e-320, 1e-300, 1e-150, 1e150, 1.0][if i % 7 == 3 { i % 4 } else { 4 }];
                    let direction = length
                        * if i % 2 == 0 {
                            direction
                        } else {
                            direction.normalize_or(Vec3::X)
                        };
                    let mut ray = Ray::new(eye, direction);
                    match i % 5 {
                        0 => ray.t_max = 1.0,
                        1 => ray.t_min = 1.0,
                        _ => {}
                    }
                    check(surface, shape, &ray);
                }
            };
            if let Ok(sphere) = Sphere::new(a, radius) {
                let surface = Surface::Sphere { center: a, radius };
                shoot(&surface, &sphere, a + radius * across);
                shoot(&surface, &sphere, a + share * radius * across);
            }
            if let Ok(triangle) = Triangle::new(vertices, None) {
                let surface = Surface::Triangle(&triangle.vertices);
                shoot(&surface, &triangle, a + share * (b - a));
                shoot(&surface, &triangle, (a + b + c) / 3.0);
            }
            if let Ok(polygon) = Polygon::new(quad, None) {
                let surface = Surface::Outline(polygon.vertices_in_plane());
                shoot(&surface, &polygon, a + share * (b - a));
                shoot(&surface, &polygon, b + share * (c - b));
                shoot(&surface, &polygon, a + share * (c - a));
            }
            if let Ok(cone) = cone {
                let surface = Surface::Cone(*cone.ends());
                let middle = 0.5 * (cone.base_radius() + cone.apex_radius());
                shoot(&surface, &cone, 0.5 * (a + b) + middle * side);
                shoot(&surface, &cone, a + share * (b - a));
                shoot(&surface, &cone, b + cone.apex_radius() * side);
            }
        }
    }

    /// Fast tests decide as integers of any size do, and distances are the same bits.
    #[test]
    fn tests_of_objects_are_exact() {
        let (mut hits, mut misses) = (0, 0);
        each_case(
            if cfg!(debug_assertions) {
                3_000
            } else {
                100_000
            },
            |surface, shape, ray| {
                let exact =
                    surface.decide_without_rounding(Known::Nothing, ray, Some(Precision::F64));
                let exact = exact.filter(|t| t.is_finite());
                let found = shape.intersect(ray, ray.t_max);
                assert_eq!(found, exact, "{ray:?}");
                assert_eq!(shape.is_hit(ray), exact.is_some(), "{ray:?}");
                hits += usize::from(exact.is_some());
                misses += usize::from(exact.is_none());
            },
        );
        assert!(hits > 1000 && misses > 1000, "{hits} {misses}");
    }

    /// Twice the precision decides nearly all cases, and each of them as integers of any size do.
    #[test]
    fn double_words_know_their_error() {
        let (mut certain, mut unsure) = (0, 0);
        each_case(3_000, |surface, _, ray| {
            let precision = Some(Precision::F64);
            match surface.decide_in::<DoubleWord<false>>(Known::Nothing, ray, precision) {
                Ok(found) => {
                    assert_eq!(
                        found,
                        surface.decide_without_rounding(Known::Nothing, ray, precision)
                    );
                    certain += 1;
                }
                Err(Unsure) => unsure += 1,
            }
        });
        println!("{certain} certain, {unsure} unsure");
        assert!(unsure * 3 < certain, "{certain} {unsure}");
    }
}
