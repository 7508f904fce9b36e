//! The tests that decide: those of the plain kernel, with the very same numbers.

use super::block::Whole;
use super::ray::LaneRays;
use super::walk::{Candidate, Tests};
use crate::geometry::Ray;
use crate::primitive::Form;
use crate::trace::Hit;
use std::marker::PhantomData;

/// What a precision makes of a ray.
pub(super) trait Numbers {
    /// Whether lanes hold all of a ray but what lies behind its origin.
    const FORWARD_ONLY: bool;

    /// The ray that objects are tested with, and whose distances those of tests are.
    fn tested(rays: &LaneRays, ray: usize, world: &[Ray]) -> Ray;

    /// A distance on that ray as one on the ray in the world.
    fn to_world(rays: &LaneRays, ray: usize, t: f64) -> f64;

    /// A distance in the unit frame that is not below `t` on that ray.
    fn limit(rays: &LaneRays, ray: usize, t: f64) -> f32;
}

/// `f32`, in the unit frame.
pub(super) struct Narrow;

impl Numbers for Narrow {
    /// Packed rays begin at 0 at the earliest for the plain kernel, too.
    const FORWARD_ONLY: bool = false;

    #[inline(always)]
    fn tested(rays: &LaneRays, ray: usize, _: &[Ray]) -> Ray {
        rays.framed(ray).wide()
    }

    #[inline(always)]
    fn to_world(rays: &LaneRays, ray: usize, t: f64) -> f64 {
        rays.framed(ray).to_world(t)
    }

    #[inline(always)]
    fn limit(_: &LaneRays, _: usize, t: f64) -> f32 {
        t as f32
    }
}

/// `f64`, in the world.
pub(super) struct Wide;

impl Numbers for Wide {
    const FORWARD_ONLY: bool = true;

    #[inline(always)]
    fn tested(_: &LaneRays, ray: usize, world: &[Ray]) -> Ray {
        world[ray]
    }

    #[inline(always)]
    fn to_world(_: &LaneRays, _: usize, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn limit(rays: &LaneRays, ray: usize, t: f64) -> f32 {
        (rays.framed(ray).in_frame(t) as f32).next_up()
    }
}

/// Where the objects are that tests want.
pub(super) trait Objects {
    /// [`Form::settle`] of a candidate.
    fn settle(&self, candidate: &Candidate, ray: &Ray, t_max: f64) -> Option<f64>;
}

/// In the blocks themselves, which were just read.
pub(super) struct InBlocks<'a, B>(pub(super) &'a [B]);

impl<B: Whole> Objects for InBlocks<'_, B> {
    #[inline(always)]
    fn settle(&self, candidate: &Candidate, ray: &Ray, t_max: f64) -> Option<f64> {
        let block = &self.0[candidate.block as usize];
        block.settle(candidate.place as usize, ray, t_max)
    }
}

/// In an array by number.
pub(super) struct InArray<'a, F>(pub(super) &'a [F]);

impl<F: Form> Objects for InArray<'_, F> {
    #[inline(always)]
    fn settle(&self, candidate: &Candidate, ray: &Ray, t_max: f64) -> Option<f64> {
        self.0[candidate.object as usize].settle(ray, t_max)
    }
}

/// What is nearest?
pub(super) struct Closest<'a, N, O> {
    objects: O,
    rays: &'a [Ray],
    /// By ray: the nearest so far, with a distance on the ray that objects are tested with.
    hits: &'a mut [Hit],
    numbers: PhantomData<N>,
}

impl<'a, N, O> Closest<'a, N, O> {
    pub(super) fn new(objects: O, rays: &'a [Ray], hits: &'a mut [Hit]) -> Self {
        Closest {
            objects,
            rays,
            hits,
            numbers: PhantomData,
        }
    }
}

impl<N: Numbers, O: Objects> Tests for Closest<'_, N, O> {
    fn any_will_do(&self) -> bool {
        false
    }

    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]) {
        for candidate in candidates {
            let (ray, object) = (candidate.ray as usize, candidate.object);
            let best = &mut self.hits[ray];
            // Found in the leaf before.
            if object == best.object {
                continue;
            }
            let tested = N::tested(rays, ray, self.rays);
            if let Some(t) = self.objects.settle(candidate, &tested, best.t)
                && (t < best.t || object < best.object)
            {
                *best = Hit { t, object };
                limits[candidate.lane as usize] = N::limit(rays, ray, t);
            }
        }
    }
}

/// Is anything hit?
pub(super) struct Any<'a, N, O> {
    objects: O,
    rays: &'a [Ray],
    blocked: &'a mut [bool],
    numbers: PhantomData<N>,
}

impl<'a, N, O> Any<'a, N, O> {
    pub(super) fn new(objects: O, rays: &'a [Ray], blocked: &'a mut [bool]) -> Self {
        Any {
            objects,
            rays,
            blocked,
            numbers: PhantomData,
        }
    }
}

impl<N: Numbers, O: Objects> Tests for Any<'_, N, O> {
    fn any_will_do(&self) -> bool {
        true
    }

    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]) {
        for candidate in candidates {
            let ray = candidate.ray as usize;
            if self.blocked[ray] {
                continue;
            }
            let is_hit = || {
                let tested = N::tested(rays, ray, self.rays);
                let t = self.objects.settle(candidate, &tested, tested.t_max);
                t.is_some()
            };
            if candidate.surely || is_hit() {
                self.blocked[ray] = true;
                limits[candidate.lane as usize] = -1.0;
            }
        }
    }
}
