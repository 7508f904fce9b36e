//! A ray as traversal uses it, in either precision.
//!
//! All decisions of a traversal follow from where a ray crosses a plane, and from the bounds `first` and
//! `last` on where it may cross it in spite of rounding.

use super::stack::Real;
use crate::geometry::Ray;
use crate::primitive::UnitFrame;
use crate::structure::Tree;

/// Where a ray crosses a plane.
#[derive(Clone, Copy)]
pub(crate) struct PlaneCrossing<T> {
    /// Infinite or NaN if the ray is parallel to the plane.
    pub(crate) t: T,
    /// A ray that ends before this certainly ends before the plane.
    pub(crate) surely_before: T,
    /// A ray that begins behind this certainly begins behind the plane.
    pub(crate) surely_behind: T,
    /// Bounds on `t` that include rounding.
    pub(crate) first: T,
    pub(crate) last: T,
}

/// A ray in the coordinates of a tree's root cell.
pub(crate) trait TraversalRay {
    type T: Real;

    /// Whether a pending node never holds a hit before one in a node that was pushed later. It may hold one
    /// where a ray that is parallel to a plane visits both sides of it.
    const PENDING_IN_ORDER: bool;

    /// Returns an interval, widened for rounding.
    fn widened(interval: [f64; 2]) -> (Self::T, Self::T);

    /// Clips an interval to a box in the coordinates of the root cell; `None` if the ray misses it. A ray
    /// within rounding of the box does not.
    fn clip(
        &self,
        interval: (Self::T, Self::T),
        lo: &[f32; 3],
        hi: &[f32; 3],
    ) -> Option<(Self::T, Self::T)>;

    /// Clips an interval to the root cell; `None` if the ray misses the cell.
    #[inline(always)]
    fn clip_to_root(&self, interval: [f64; 2]) -> Option<(Self::T, Self::T)> {
        self.clip(Self::widened(interval), &[-1.0; 3], &[1.0; 3])
    }

    /// Returns where the ray crosses a plane.
    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<Self::T>;

    /// Returns whether the ray points towards lower coordinates.
    fn is_backward(&self, axis: usize) -> bool;

    /// Returns whether a node that begins at `t_enter` may hold a hit at `limit` or before.
    fn reaches(t_enter: Self::T, limit: Self::T) -> bool;
}

/// Generous relative bound on the rounding of a distance to a plane: the subtraction, the division and
/// both conversions to the coordinates of the root cell round once each.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Relative bound on the rounding of a hit, and so of the end of a ray that ends on one. A root where the
/// ray grazes the surface, or at the tip of a cone, is only known to about the square root of
/// [`ROUNDING`]. A hit this near to the next leaf does not end the traversal, because that leaf may hold a
/// closer one.
const HIT_ROUNDING: f64 = 1e-7;

#[inline(always)]
fn later(t: f64) -> f64 {
    t + t.abs() * ROUNDING
}

#[inline(always)]
pub(super) fn earlier(t: f64) -> f64 {
    t - t.abs() * ROUNDING
}

/// Returns the largest distance that a hit computed at `t` may have.
#[inline(always)]
fn beyond_hit(t: f64) -> f64 {
    t + t.abs() * HIT_ROUNDING
}

/// In `f64`. The tree was built in the same precision, so only distances are rounded.
pub(crate) struct TraversalRayF64 {
    origin: [f64; 3],
    direction: [f64; 3],
    inverse: [f64; 3],
}

impl TraversalRayF64 {
    #[inline(always)]
    pub(crate) fn new(tree: &Tree, ray: &Ray) -> Self {
        let direction = tree.frame().direction_to_local(ray.direction).to_array();
        TraversalRayF64 {
            origin: tree.frame().point_to_local(ray.origin).to_array(),
            direction,
            inverse: direction.map(|d| 1.0 / d),
        }
    }

    /// Returns whether the ray is parallel to the planes of an axis.
    #[cfg(test)]
    pub(crate) fn is_along(&self, axis: usize) -> bool {
        self.direction[axis] == 0.0
    }
}

impl TraversalRay for TraversalRayF64 {
    type T = f64;
    // Objects in a plane are in the leaves on both sides of it.
    const PENDING_IN_ORDER: bool = true;

    #[inline(always)]
    fn widened([t_min, t_max]: [f64; 2]) -> (f64, f64) {
        // The ends may be those of hits, and known no better.
        (-beyond_hit(-t_min), beyond_hit(t_max))
    }

    #[inline(always)]
    fn clip(
        &self,
        (mut t_enter, mut t_exit): (f64, f64),
        lo: &[f32; 3],
        hi: &[f32; 3],
    ) -> Option<(f64, f64)> {
        for k in 0..3 {
            let (origin, inverse) = (self.origin[k], self.inverse[k]);
            let (lo, hi) = (f64::from(lo[k]) - ROUNDING, f64::from(hi[k]) + ROUNDING);
            if inverse.is_finite() {
                let (a, b) = ((lo - origin) * inverse, (hi - origin) * inverse);
                t_enter = t_enter.max(earlier(a.min(b)));
                t_exit = t_exit.min(later(a.max(b)));
            } else if origin < lo || origin > hi {
                return None;
            }
        }
        (t_enter <= t_exit).then_some((t_enter, t_exit))
    }

    #[inline(always)]
    /// Returns where the ray crosses a plane.
    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<f64> {
        let t = (f64::from(plane) - self.origin[axis]) * self.inverse[axis];
        PlaneCrossing {
            t,
            surely_before: t,
            surely_behind: t,
            first: earlier(t),
            last: later(t),
        }
    }

    #[inline(always)]
    fn is_backward(&self, axis: usize) -> bool {
        self.direction[axis].is_sign_negative()
    }

    #[inline(always)]
    fn reaches(t_enter: f64, limit: f64) -> bool {
        // NaN for a limit of −∞: false.
        t_enter <= beyond_hit(limit)
    }
}

/// In `f32`, on a tree that was built in `f64`. Planes are as thick as rounding may have moved the objects
/// and the ray, so that a ray that may be on the wrong side of a plane visits both sides.
///
/// The thickness is absolute, along the plane's axis. It covers the distance between a hit and the exact
/// object (4 ε (1 + o), see [`crate::primitive::Form`]) and the rounding of the traversal (origin, plane,
/// difference, inverse and product: less than 4 ε of the coordinates). After Ize, "Robust BVH ray
/// traversal" (JCGT 2(2), 2013), with absolute instead of relative bounds.
pub(super) struct TraversalRayF32 {
    origin: [f32; 3],
    /// 1 / direction, with components of at least 10⁻²⁰ so that it is finite. Over the few lengths that
    /// matter, a ray that is parallel to a plane then stays within its thickness, or well away from it.
    inverse: [f32; 3],
    /// Half the thickness of the planes of each axis, along the axis and along the ray.
    half_thickness: [f32; 3],
    half_thickness_along: [f32; 3],
}

impl TraversalRayF32 {
    /// Converts a ray from the coordinates of a frame.
    #[inline(always)]
    pub(super) fn new(tree: &Tree, frame: &UnitFrame, ray: &Ray) -> Self {
        const EPSILON: f32 = f32::EPSILON;
        const MIN_COMPONENT: f32 = 1e-20;
        // The center of the root cell is near the origin of the frame.
        let (center, half) = tree.frame().center_and_half();
        let center = frame.point(center);
        let per_length = 1.0 / (half * frame.scale());
        let origin = ((ray.origin - center) * per_length).as_vec3();
        let direction = (ray.direction * per_length).as_vec3();
        let distance = 4.0 * f64::from(EPSILON) * (1.0 + ray.origin.abs().max_element());
        let half_thickness =
            (distance * per_length).as_vec3() + 4.0 * EPSILON * (1.0 + origin.abs());
        let inverse = direction
            .to_array()
            .map(|d| 1.0 / d.abs().max(MIN_COMPONENT).copysign(d));
        let half_thickness = half_thickness.to_array();
        TraversalRayF32 {
            origin: origin.to_array(),
            inverse,
            half_thickness,
            half_thickness_along: std::array::from_fn(|k| half_thickness[k] * inverse[k].abs()),
        }
    }
}

impl TraversalRay for TraversalRayF32 {
    type T = f32;
    // Objects within the thickness of a plane may be in the leaf on either side of it alone.
    const PENDING_IN_ORDER: bool = false;

    #[inline(always)]
    fn widened([t_min, t_max]: [f64; 2]) -> (f32, f32) {
        (t_min as f32, t_max as f32)
    }

    #[inline(always)]
    fn clip(
        &self,
        (mut t_enter, mut t_exit): (f32, f32),
        lo: &[f32; 3],
        hi: &[f32; 3],
    ) -> Option<(f32, f32)> {
        for k in 0..3 {
            let (origin, inverse) = (self.origin[k], self.inverse[k]);
            let thickness = self.half_thickness[k];
            let (lo, hi) = (lo[k] - thickness, hi[k] + thickness);
            let (a, b) = ((lo - origin) * inverse, (hi - origin) * inverse);
            t_enter = t_enter.max(a.min(b));
            t_exit = t_exit.min(a.max(b));
        }
        (t_enter <= t_exit).then_some((t_enter, t_exit))
    }

    #[inline(always)]
    /// Returns where the ray crosses a plane.
    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<f32> {
        let t = (plane - self.origin[axis]) * self.inverse[axis];
        let (first, last) = (
            t - self.half_thickness_along[axis],
            t + self.half_thickness_along[axis],
        );
        PlaneCrossing {
            t,
            surely_before: first,
            surely_behind: last,
            first,
            last,
        }
    }

    #[inline(always)]
    fn is_backward(&self, axis: usize) -> bool {
        self.inverse[axis].is_sign_negative()
    }

    #[inline(always)]
    fn reaches(t_enter: f32, limit: f32) -> bool {
        t_enter <= limit
    }
}
