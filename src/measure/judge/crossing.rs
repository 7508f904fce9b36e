//! Where a ray meets one object, exactly or within a tolerance.

use super::root::Root;
use super::span::{Span, SpanVec, rational};
use super::tolerance::Tolerance;
use crate::geometry::Ray;
use std::cmp::Ordering;

/// A place where the ray may meet the surface: between `earliest` and `latest`, which are one number
/// where nothing is left open.
#[derive(Clone, Debug)]
pub struct Crossing {
    pub earliest: Root,
    pub latest: Root,
    /// Whether it is met, whatever the tolerance leaves open; `false` too just on an edge, for a
    /// tangent, and at the very start and end of the ray.
    pub certain: bool,
}

impl Crossing {
    /// Returns the crossing if it may lie in the interval of the ray.
    pub(super) fn within(mut self, ray: &Ray) -> Option<Crossing> {
        let start = Root::from(rational(ray.t_min));
        // What no number is large enough for is not met.
        let end = Root::from(rational(ray.t_max.min(f64::MAX)));
        let inside = self.latest.cmp(&start).min(end.cmp(&self.earliest));
        let surely = self.earliest > start && self.latest < end;
        self.certain &= surely;
        (inside != Ordering::Less).then_some(self)
    }
}

/// A ray with its numbers as intervals.
pub struct Line<'a> {
    pub ray: &'a Ray,
    pub origin: SpanVec,
    pub direction: SpanVec,
}

impl<'a> Line<'a> {
    pub fn new(ray: &'a Ray, tolerance: &Tolerance) -> Self {
        let turn = tolerance.relative * ray.direction.abs().max_element();
        Line {
            ray,
            origin: SpanVec::around(ray.origin, &rational(tolerance.length)),
            direction: SpanVec::around(ray.direction, &rational(turn)),
        }
    }

    /// The points at a parameter, from another point: `origin + t · direction − from`.
    pub fn offset_at(&self, t: &Span, from: &SpanVec) -> SpanVec {
        &(&self.origin - from) + &self.direction.scaled(t)
    }
}
