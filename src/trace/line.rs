//! A ray as the walk through a tree sees it, in either precision.
//!
//! The walk needs to know where a ray meets a plane, and where it may meet it: between `first` and
//! `last`, whatever was rounded. Everything it decides follows from these.

use super::traverse::{Scratch, Waiting};
use crate::geometry::Ray;
use crate::primitive::UnitFrame;
use crate::structure::Tree;

/// The number that a walk computes with: `f32` or `f64`.
pub(crate) trait Real: Copy + PartialOrd {
    fn of(value: f64) -> Self;
    fn wide(self) -> f64;
    fn least(self, other: Self) -> Self;
    fn greatest(self, other: Self) -> Self;
    /// The stack of a walk in this number.
    fn stack(scratch: &mut Scratch) -> &mut Vec<Waiting<Self>>;
}

macro_rules! real {
    ($real:ident, $stack:ident) => {
        impl Real for $real {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as $real
            }
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn least(self, other: Self) -> Self {
                self.min(other)
            }
            #[inline(always)]
            fn greatest(self, other: Self) -> Self {
                self.max(other)
            }
            #[inline(always)]
            fn stack(scratch: &mut Scratch) -> &mut Vec<Waiting<Self>> {
                &mut scratch.$stack
            }
        }
    };
}
real!(f32, narrow);
real!(f64, wide);

/// Where a ray meets a plane.
#[derive(Clone, Copy)]
pub(crate) struct PlaneCrossing<T> {
    /// Infinite or NaN where it runs along it.
    pub(crate) t: T,
    /// The ray certainly ends before the plane if it ends before this.
    pub(crate) surely_before: T,
    /// The ray certainly begins behind the plane if it begins behind this.
    pub(crate) surely_behind: T,
    /// Bounds of `t`, widened by rounding.
    pub(crate) first: T,
    pub(crate) last: T,
}

/// A ray in the coordinates of a tree's root cell.
pub(crate) trait TraversalRay {
    type T: Real;

    /// Whether of two far children that wait, what matters of the one that waits longer never lies
    /// nearer. It may where a ray that runs along a plane has both sides of it to visit.
    const PENDING_IN_ORDER: bool;

    /// Where the ray is within the root cell and the two distances; `None` where it misses it.
    fn clip_to_root(&self, interval: [f64; 2]) -> Option<(Self::T, Self::T)>;

    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<Self::T>;

    /// Whether the ray runs towards lower coordinates.
    fn is_backward(&self, axis: usize) -> bool;

    /// Whether what begins at `t_enter` may still matter when nothing beyond `limit` does.
    fn reaches(t_enter: Self::T, limit: Self::T) -> bool;
}

/// Relative bound on the rounding of a distance to a plane, with room to spare: the subtraction,
/// the division and both conversions into the coordinates of the root cell round once each.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Relative rounding that a hit may carry, and so the end of a ray that ends on one: a grazing root,
/// or one at the tip of a cone, is known to about the root of what a plane is known to. A hit this near
/// to the next leaf does not end the walk, for what that leaf holds may be nearer still.
const HIT_ROUNDING: f64 = 1e-7;

#[inline(always)]
fn later(t: f64) -> f64 {
    t + t.abs() * ROUNDING
}

#[inline(always)]
pub(super) fn earlier(t: f64) -> f64 {
    t - t.abs() * ROUNDING
}

/// How far a hit at `t` may truly lie.
#[inline(always)]
fn beyond_hit(t: f64) -> f64 {
    t + t.abs() * HIT_ROUNDING
}

/// In `f64`: the tree and the objects were decided in the same numbers, only the distance rounds.
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

    /// Whether the ray runs along the planes of an axis.
    #[cfg(test)]
    pub(crate) fn is_along(&self, axis: usize) -> bool {
        self.direction[axis] == 0.0
    }
}

impl TraversalRay for TraversalRayF64 {
    type T = f64;
    // What a ray meets in a plane is in the leaves of both sides.
    const PENDING_IN_ORDER: bool = true;

    #[inline(always)]
    fn clip_to_root(&self, [t_min, t_max]: [f64; 2]) -> Option<(f64, f64)> {
        // Ends may lie on hits, and be known no better.
        let (mut t_enter, mut t_exit) = (-beyond_hit(-t_min), beyond_hit(t_max));
        for k in 0..3 {
            const SIDE: f64 = 1.0 + ROUNDING;
            let (origin, inverse) = (self.origin[k], self.inverse[k]);
            if inverse.is_finite() {
                let (a, b) = ((-SIDE - origin) * inverse, (SIDE - origin) * inverse);
                t_enter = t_enter.max(earlier(a.min(b)));
                t_exit = t_exit.min(later(a.max(b)));
            } else if origin.abs() > SIDE {
                return None;
            }
        }
        (t_enter <= t_exit).then_some((t_enter, t_exit))
    }

    #[inline(always)]
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
        // A limit of −∞ gives NaN.
        t_enter <= beyond_hit(limit)
    }
}

/// In `f32`, on a tree that was decided in `f64`: every plane is as thick as rounding may have moved
/// the objects and the ray, so that no ray passes on the wrong side of one unseen.
///
/// The thickness is an absolute one along the plane's axis. It makes up for the distance between a
/// hit and the true object (4 ε (1 + o), see [`crate::primitive::Form`]) and for what the walk itself
/// rounds (origin, plane, difference, inverse and product: less than 4 ε of the coordinates that take
/// part). After Ize, "Robust BVH ray traversal" (JCGT 2(2), 2013), with absolute in place of relative
/// bounds.
pub(super) struct TraversalRayF32 {
    origin: [f32; 3],
    /// Of at least 10⁻²⁰, so that the inverse is finite: over the few lengths that matter, a ray that
    /// runs along a plane then stays within its thickness, or well off it.
    inverse: [f32; 3],
    /// Half the thickness of the planes of an axis, and how far apart along the ray that puts their
    /// sides.
    thick: [f32; 3],
    thick_along: [f32; 3],
}

impl TraversalRayF32 {
    /// The line of a ray in the coordinates of a frame.
    #[inline(always)]
    pub(super) fn new(tree: &Tree, frame: &UnitFrame, ray: &Ray) -> Self {
        const EPSILON: f32 = f32::EPSILON;
        const LEAST: f32 = 1e-20;
        // In the frame's coordinates first: there, the center of the root cell is near the origin.
        let (center, half) = tree.frame().center_and_half();
        let center = frame.point(center);
        let per_length = 1.0 / (half * frame.scale());
        let origin = ((ray.origin - center) * per_length).as_vec3();
        let direction = (ray.direction * per_length).as_vec3();
        let distance = 4.0 * f64::from(EPSILON) * (1.0 + ray.origin.abs().max_element());
        let thick = (distance * per_length).as_vec3() + 4.0 * EPSILON * (1.0 + origin.abs());
        let inverse = direction
            .to_array()
            .map(|d| 1.0 / d.abs().max(LEAST).copysign(d));
        let thick = thick.to_array();
        TraversalRayF32 {
            origin: origin.to_array(),
            inverse,
            thick,
            thick_along: std::array::from_fn(|k| thick[k] * inverse[k].abs()),
        }
    }
}

impl TraversalRay for TraversalRayF32 {
    type T = f32;
    // What it meets within a plane's thickness may be in the leaf of either side alone.
    const PENDING_IN_ORDER: bool = false;

    #[inline(always)]
    fn clip_to_root(&self, [t_min, t_max]: [f64; 2]) -> Option<(f32, f32)> {
        let (mut t_enter, mut t_exit) = (t_min as f32, t_max as f32);
        for k in 0..3 {
            let (origin, inverse) = (self.origin[k], self.inverse[k]);
            let side = 1.0 + self.thick[k];
            let (a, b) = ((-side - origin) * inverse, (side - origin) * inverse);
            t_enter = t_enter.max(a.min(b));
            t_exit = t_exit.min(a.max(b));
        }
        (t_enter <= t_exit).then_some((t_enter, t_exit))
    }

    #[inline(always)]
    fn crossing(&self, axis: usize, plane: f32) -> PlaneCrossing<f32> {
        let t = (plane - self.origin[axis]) * self.inverse[axis];
        let (first, last) = (t - self.thick_along[axis], t + self.thick_along[axis]);
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
