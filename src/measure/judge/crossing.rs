//! Intersections of a ray with one object, exact or within a tolerance.

use super::span::{Span, SpanVec, rational};
use super::tolerance::Tolerance;
use crate::geometry::Ray;
use crate::primitive::exact::Root;
use std::cmp::Ordering;

/// A possible intersection of the ray and the surface, between `earliest` and `latest`. The two are
/// equal if the intersection is exact.
#[derive(Clone, Debug)]
pub struct Crossing {
    pub earliest: Root,
    pub latest: Root,
    /// Whether the ray hits here for all numbers within the tolerance. `false` also exactly on an
    /// edge, at a tangent, and at the very start or end of the ray.
    pub certain: bool,
}

impl Crossing {
    /// Returns the crossing if it may lie within the ray's interval.
    pub(super) fn within(mut self, ray: &Ray) -> Option<Crossing> {
        let start = Root::from(rational(ray.t_min));
        // An infinite end is clamped to the largest number, because no hit beyond it can be
        // represented.
        let end = Root::from(rational(ray.t_max.min(f64::MAX)));
        let inside = self.latest.cmp(&start).min(end.cmp(&self.earliest));
        let surely = self.earliest > start && self.latest < end;
        self.certain &= surely;
        (inside != Ordering::Less).then_some(self)
    }
}

/// A ray with intervals for its coordinates.
pub struct Line<'a> {
    pub ray: &'a Ray,
    pub origin: SpanVec,
    pub direction: SpanVec,
}

impl<'a> Line<'a> {
    /// Creates a line whose coordinates vary within the tolerance.
    pub fn new(ray: &'a Ray, tolerance: &Tolerance) -> Self {
        let turn = tolerance.relative * ray.direction.abs().max_element();
        Line {
            ray,
            origin: SpanVec::around(ray.origin, &rational(tolerance.length)),
            direction: SpanVec::around(ray.direction, &rational(turn)),
        }
    }

    /// Returns whether no coordinate varies.
    pub fn is_exact(&self) -> bool {
        let mut all = self.origin.0.iter().chain(&self.direction.0);
        all.all(Span::is_exact)
    }

    /// Returns `origin + t · direction − from`: the point at parameter `t`, relative to another
    /// point.
    pub fn offset_at(&self, t: &Span, from: &SpanVec) -> SpanVec {
        &(&self.origin - from) + &self.direction.scaled(t)
    }
}
