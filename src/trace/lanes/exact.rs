//! The tests that decide: those of the plain kernel, with the very same numbers.

use super::InstructionSet;
use super::block::{Spheres, Triangles};
use super::crossings::{Crossings, MANY};
use super::ray::{LaneRay, LaneRays};
use super::three;
use super::walk::{Candidate, Tests};
use crate::geometry::Ray;
use crate::primitive::{Form, PackedTriangle};
use crate::trace::Hit;
use std::marker::PhantomData;

/// A ray in `f64`.
#[inline(always)]
fn widened(ray: &LaneRay) -> Ray {
    Ray {
        origin: three(|k| f64::from(ray.origin[k])).into(),
        direction: three(|k| f64::from(ray.direction[k])).into(),
        t_min: f64::from(ray.t_min),
        t_max: f64::from(ray.t_max),
    }
}

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
        widened(&rays.rays[ray])
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

    /// What can be computed for several candidates at once, at most [`MANY`]; [`Objects::settle`] asks
    /// for them next.
    fn begin(&mut self, _: &[Candidate], _: &LaneRays) {}

    /// [`Form::settle`] of a candidate up to `t_max`, the one of this number among those that were
    /// begun; `world` are the rays in the world.
    fn settle(
        &self,
        number: usize,
        candidate: &Candidate,
        rays: &LaneRays,
        world: &[Ray],
        t_max: f64,
    ) -> Option<f64>;
}

/// Triangles in the blocks themselves, which were just read.
pub(super) struct InTriangles<'a> {
    blocks: &'a [Triangles],
    crossings: Crossings,
    instructions: InstructionSet,
}

impl<'a> InTriangles<'a> {
    pub(super) fn new(blocks: &'a [Triangles], instructions: InstructionSet) -> Self {
        InTriangles {
            blocks,
            crossings: Crossings::new(),
            instructions,
        }
    }
}

impl Objects for InTriangles<'_> {
    type Numbers = Narrow;

    #[inline(always)]
    fn begin(&mut self, candidates: &[Candidate], rays: &LaneRays) {
        for (k, candidate) in candidates.iter().enumerate() {
            let ray = &rays.rays[candidate.ray as usize];
            let block = &self.blocks[candidate.block as usize];
            self.crossings.set(k, block, candidate.place as usize, ray);
        }
        self.crossings.compute(self.instructions, candidates.len());
    }

    #[inline(always)]
    fn settle(
        &self,
        number: usize,
        _: &Candidate,
        _: &LaneRays,
        _: &[Ray],
        t_max: f64,
    ) -> Option<f64> {
        PackedTriangle::settled(self.crossings.of(number), t_max)
    }
}

/// Spheres likewise.
pub(super) struct InSpheres<'a>(pub(super) &'a [Spheres]);

impl Objects for InSpheres<'_> {
    type Numbers = Narrow;

    #[inline(always)]
    fn settle(
        &self,
        _: usize,
        candidate: &Candidate,
        rays: &LaneRays,
        _: &[Ray],
        t_max: f64,
    ) -> Option<f64> {
        let ray = widened(&rays.rays[candidate.ray as usize]);
        let block = &self.0[candidate.block as usize];
        block.sphere(candidate.place as usize).settle(&ray, t_max)
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
        _: usize,
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
        for candidates in candidates.chunks(MANY) {
            self.objects.begin(candidates, rays);
            for (k, candidate) in candidates.iter().enumerate() {
                let (ray, object) = (candidate.ray as usize, candidate.object);
                let best = &mut self.hits[ray];
                // Found in the leaf before.
                if object == best.object {
                    continue;
                }
                if let Some(t) = self.objects.settle(k, candidate, rays, self.rays, best.t)
                    && (t < best.t || object < best.object)
                {
                    *best = Hit { t, object };
                    limits[candidate.lane as usize] = O::Numbers::limit(rays, ray, t);
                }
            }
        }
    }
}

/// Is anything hit?
pub(super) struct Any<'a, O> {
    objects: O,
    rays: &'a [Ray],
    blocked: &'a mut [bool],
    /// Those of the candidates that have to be tested.
    unsure: Vec<Candidate>,
}

impl<'a, O> Any<'a, O> {
    pub(super) fn new(objects: O, rays: &'a [Ray], blocked: &'a mut [bool]) -> Self {
        Any {
            objects,
            rays,
            blocked,
            unsure: Vec::new(),
        }
    }
}

impl<O: Objects> Tests for Any<'_, O> {
    fn any_will_do(&self) -> bool {
        true
    }

    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]) {
        let mut block = |candidate: &Candidate| {
            self.blocked[candidate.ray as usize] = true;
            limits[candidate.lane as usize] = -1.0;
        };
        self.unsure.clear();
        for candidate in candidates {
            if candidate.surely {
                block(candidate);
            } else {
                self.unsure.push(*candidate);
            }
        }
        for candidates in self.unsure.chunks(MANY) {
            self.objects.begin(candidates, rays);
            for (k, candidate) in candidates.iter().enumerate() {
                let t_max = O::Numbers::t_max(rays, candidate.ray as usize, self.rays);
                let t = self.objects.settle(k, candidate, rays, self.rays, t_max);
                if t.is_some() {
                    block(candidate);
                }
            }
        }
    }
}
