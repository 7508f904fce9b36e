//! Exact decisions: whether and where a ray meets a surface.
//!
//! Every decision is the sign of an expression in the stored coordinates. An expression is first evaluated
//! in `f64` where it is fast and with a bound on the error ([`super::estimate`]). What that leaves open is
//! evaluated with twice the precision ([`DoubleWord`]), which also rounds distances correctly. What is
//! still open is evaluated with fractions ([`Rational`]), which round nothing.
//!
//! So a surface is hit exactly where its coordinates say, and distances are the exact ones rounded to the
//! nearest number. Rounding keeps the order: the exact distances of two hits need to be compared only where
//! the rounded ones are equal ([`super::Shape::exact_distance`]).
//!
//! The approach is that of Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
//! predicates" (Discrete & Computational Geometry 18, 1997).

mod distance;
mod double_word;
mod flat;
mod number;
mod quadric;
mod root;

pub(super) use quadric::ConeEnds;
pub use root::Root;

use super::Precision;
use crate::geometry::{Ray, Vec3};
use distance::{Distance, Round};
use double_word::DoubleWord;
use number::{Number, Rational, Unsure};
use std::cmp::Ordering;

/// A surface, by the numbers that define it.
#[derive(Clone, Copy)]
pub(super) enum Surface<'a> {
    Sphere {
        center: Vec3,
        radius: f64,
    },
    Triangle(&'a [Vec3; 3]),
    /// A triangle that the ray's line certainly crosses.
    Pierced(&'a [Vec3; 3]),
    /// The outline of a polygon.
    Outline(&'a [Vec3]),
    Cone(ConeEnds),
}

impl Surface<'_> {
    /// Returns where the ray's line crosses the surface, in ascending order.
    #[inline(always)]
    fn crossings<N: Number>(&self, ray: &Ray) -> Result<[Option<Distance<N>>; 2], Unsure> {
        match self {
            Surface::Sphere { center, radius } => quadric::sphere(*center, *radius, ray),
            Surface::Triangle(vertices) => Ok([flat::triangle(vertices, ray)?, None]),
            Surface::Pierced(vertices) => Ok([flat::plane(vertices, ray)?, None]),
            Surface::Outline(vertices) => Ok([flat::outline(vertices, ray)?, None]),
            Surface::Cone(ends) => quadric::cone(ends, ray),
        }
    }

    /// Returns the first crossing within the ray's interval.
    #[inline(always)]
    fn first<N: Number>(&self, ray: &Ray) -> Result<Option<Distance<N>>, Unsure> {
        for crossing in self.crossings(ray)?.into_iter().flatten() {
            if crossing.compare(ray.t_min)? != Ordering::Less
                && crossing.compare(ray.t_max)? != Ordering::Greater
            {
                return Ok(Some(crossing));
            }
        }
        Ok(None)
    }

    /// Returns the first crossing within the ray's interval, rounded to the nearest number.
    #[inline(always)]
    fn first_rounded<N: Number>(
        &self,
        ray: &Ray,
        precision: Precision,
    ) -> Result<Option<f64>, Unsure>
    where
        Distance<N>: Round,
    {
        let first = self.first::<N>(ray)?;
        first
            .map(|t| match precision {
                Precision::F32 => t.to_f32(),
                Precision::F64 => t.to_f64(),
            })
            .transpose()
    }

    /// Returns the distance of the first hit, rounded to the nearest number; `None` if that is infinite.
    pub(super) fn intersect(&self, ray: &Ray, precision: Precision) -> Option<f64> {
        if !is_usable(ray) {
            return None;
        }
        let first = self
            .first_rounded::<DoubleWord>(ray, precision)
            .unwrap_or_else(|Unsure| self.intersect_rationally(ray, precision));
        first.filter(|t| t.is_finite())
    }

    #[cold]
    #[inline(never)]
    fn intersect_rationally(&self, ray: &Ray, precision: Precision) -> Option<f64> {
        certain(self.first_rounded::<Rational>(ray, precision))
    }

    /// Returns the exact distance of the first hit.
    #[cold]
    pub(super) fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        if !is_usable(ray) {
            return None;
        }
        certain(self.first::<Rational>(ray)).map(|t| t.root())
    }
}

/// Returns a result of arithmetic that rounds nothing.
fn certain<T>(result: Result<T, Unsure>) -> T {
    result.unwrap_or_else(|Unsure| unreachable!("fractions have certain signs"))
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
                    let direction = if i % 2 == 0 {
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

    /// Fast tests decide as fractions do, and distances are the same bits.
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
                let exact = surface.intersect_rationally(ray, Precision::F64);
                let exact = exact.filter(|t| t.is_finite());
                let found = shape.intersect(ray, ray.t_max);
                assert_eq!(found, exact, "{ray:?}");
                hits += usize::from(exact.is_some());
                misses += usize::from(exact.is_none());
            },
        );
        assert!(hits > 1000 && misses > 1000, "{hits} {misses}");
    }

    /// Twice the precision decides nearly all cases, and each of them as fractions do.
    #[test]
    fn double_words_know_their_error() {
        let (mut certain, mut unsure) = (0, 0);
        each_case(3_000, |surface, _, ray| {
            match surface.first_rounded::<DoubleWord>(ray, Precision::F64) {
                Ok(found) => {
                    assert_eq!(found, surface.intersect_rationally(ray, Precision::F64));
                    certain += 1;
                }
                Err(Unsure) => unsure += 1,
            }
        });
        println!("{certain} certain, {unsure} unsure");
        assert!(unsure * 5 < certain, "{certain} {unsure}");
    }
}
