//! The tests that decide: those of the plain kernel, with the very same numbers.

use super::block::{Whole, widened};
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

    /// That ray's end.
    fn t_max(rays: &LaneRays, ray: usize, world: &[Ray]) -> f64;

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
        widened(&rays.rays[ray], [0, 1, 2])
    }

    #[inline(always)]
    fn t_max(rays: &LaneRays, ray: usize, _: &[Ray]) -> f64 {
        f64::from(rays.rays[ray].t_max)
    }

    #[inline(always)]
    fn to_world(rays: &LaneRays, ray: usize, t: f64) -> f64 {
        rays.to_world(ray, t)
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
    fn t_max(_: &LaneRays, ray: usize, world: &[Ray]) -> f64 {
        world[ray].t_max
    }

    #[inline(always)]
    fn to_world(_: &LaneRays, _: usize, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn limit(rays: &LaneRays, ray: usize, t: f64) -> f32 {
        (rays.in_frame(ray, t) as f32).next_up()
    }
}

/// Where the objects are that tests want.
pub(super) trait Objects {
    type Numbers: Numbers;

    /// [`Form::settle`] of a candidate up to `t_max`; `world` are the rays in the world.
    fn settle(
        &self,
        candidate: &Candidate,
        rays: &LaneRays,
        world: &[Ray],
        t_max: f64,
    ) -> Option<f64>;
}

/// In the blocks themselves, which were just read.
pub(super) struct InBlocks<'a, B>(pub(super) &'a [B]);

impl<B: Whole> Objects for InBlocks<'_, B> {
    type Numbers = Narrow;

    #[inline(always)]
    fn settle(&self, candidate: &Candidate, rays: &LaneRays, _: &[Ray], t_max: f64) -> Option<f64> {
        let block = &self.0[candidate.block as usize];
        let ray = &rays.rays[candidate.ray as usize];
        block.settle(candidate.place as usize, ray, t_max)
    }
}

/// In an array by number.
pub(super) struct InArray<'a, N, F> {
    objects: &'a [F],
    numbers: PhantomData<N>,
}

impl<'a, N, F> InArray<'a, N, F> {
    pub(super) fn new(objects: &'a [F]) -> Self {
        InArray {
            objects,
            numbers: PhantomData,
        }
    }
}

impl<N: Numbers, F: Form> Objects for InArray<'_, N, F> {
    type Numbers = N;

    #[inline(always)]
    fn settle(
        &self,
        candidate: &Candidate,
        rays: &LaneRays,
        world: &[Ray],
        t_max: f64,
    ) -> Option<f64> {
        let ray = N::tested(rays, candidate.ray as usize, world);
        self.objects[candidate.object as usize].settle(&ray, t_max)
    }
}

/// What is nearest?
pub(super) struct Closest<'a, O> {
    objects: O,
    rays: &'a [Ray],
    /// By ray: the nearest so far, with a distance on the ray that objects are tested with.
    hits: &'a mut [Hit],
}

impl<'a, O> Closest<'a, O> {
    pub(super) fn new(objects: O, rays: &'a [Ray], hits: &'a mut [Hit]) -> Self {
        Closest {
            objects,
            rays,
            hits,
        }
    }
}

impl<O: Objects> Tests for Closest<'_, O> {
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
            if let Some(t) = self.objects.settle(candidate, rays, self.rays, best.t)
                && (t < best.t || object < best.object)
            {
                *best = Hit { t, object };
                limits[candidate.lane as usize] = O::Numbers::limit(rays, ray, t);
            }
        }
    }
}

/// Is anything hit?
pub(super) struct Any<'a, O> {
    objects: O,
    rays: &'a [Ray],
    blocked: &'a mut [bool],
}

impl<'a, O> Any<'a, O> {
    pub(super) fn new(objects: O, rays: &'a [Ray], blocked: &'a mut [bool]) -> Self {
        Any {
            objects,
            rays,
            blocked,
        }
    }
}

impl<O: Objects> Tests for Any<'_, O> {
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
                let t_max = O::Numbers::t_max(rays, ray, self.rays);
                let t = self.objects.settle(candidate, rays, self.rays, t_max);
                t.is_some()
            };
            if candidate.surely || is_hit() {
                self.blocked[ray] = true;
                limits[candidate.lane as usize] = -1.0;
            }
        }
    }
}
