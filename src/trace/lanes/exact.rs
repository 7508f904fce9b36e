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
use std::hint::select_unpredictable;
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
pub(super) trait RayPrecision {
    /// Whether lanes hold all of a ray but what lies behind its origin.
    const FORWARD_ONLY: bool;

    /// The ray that objects are tested with, and whose distances those of tests are, of the ray made
    /// ready in `slot`.
    fn tested(rays: &LaneRays, slot: usize, world: &[Ray]) -> Ray;

    /// That ray's end.
    fn t_max(rays: &LaneRays, slot: usize, world: &[Ray]) -> f64;

    /// A distance on that ray as one on the ray in the world.
    fn to_world(rays: &LaneRays, slot: usize, t: f64) -> f64;

    /// A distance in the unit frame that is not below `t` on that ray.
    fn limit(rays: &LaneRays, slot: usize, t: f64) -> f32;
}

/// `f32`, in the unit frame.
pub(super) struct InF32;

impl RayPrecision for InF32 {
    /// Packed rays begin at 0 at the earliest for the plain kernel, too.
    const FORWARD_ONLY: bool = false;

    #[inline(always)]
    fn tested(rays: &LaneRays, slot: usize, _: &[Ray]) -> Ray {
        widened(&rays.rays[slot])
    }

    #[inline(always)]
    fn t_max(rays: &LaneRays, slot: usize, _: &[Ray]) -> f64 {
        f64::from(rays.rays[slot].t_max)
    }

    #[inline(always)]
    fn to_world(rays: &LaneRays, slot: usize, t: f64) -> f64 {
        rays.to_world(slot, t)
    }

    #[inline(always)]
    fn limit(_: &LaneRays, _: usize, t: f64) -> f32 {
        t as f32
    }
}

/// `f64`, in the world.
pub(super) struct InF64;

impl RayPrecision for InF64 {
    const FORWARD_ONLY: bool = true;

    #[inline(always)]
    fn tested(rays: &LaneRays, slot: usize, world: &[Ray]) -> Ray {
        world[rays.number(slot)]
    }

    #[inline(always)]
    fn t_max(rays: &LaneRays, slot: usize, world: &[Ray]) -> f64 {
        world[rays.number(slot)].t_max
    }

    #[inline(always)]
    fn to_world(_: &LaneRays, _: usize, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn limit(rays: &LaneRays, slot: usize, t: f64) -> f32 {
        (rays.in_frame(slot, t) as f32).next_up()
    }
}

/// Where the objects are that tests want.
pub(super) trait Objects {
    type RayPrecision: RayPrecision;

    /// Whether tests are computed for several candidates at once; else each for itself.
    const AT_ONCE: bool = false;

    /// What can be computed for several candidates at once, at most [`MANY`]; [`Objects::test`] asks
    /// for them next.
    fn begin(&mut self, _: &[Candidate], _: &LaneRays) {}

    /// [`Form::intersect_exact`] of a candidate up to `t_max`, the one of this number among those that were
    /// begun, NaN for none; `world` are the rays in the world.
    fn test(
        &self,
        number: usize,
        candidate: &Candidate,
        rays: &LaneRays,
        world: &[Ray],
        t_max: f64,
    ) -> f64;
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
    type RayPrecision = InF32;

    const AT_ONCE: bool = true;

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
    fn test(&self, number: usize, _: &Candidate, _: &LaneRays, _: &[Ray], t_max: f64) -> f64 {
        PackedTriangle::round_hit(self.crossings.of(number), t_max)
    }
}

/// Spheres likewise.
pub(super) struct InSpheres<'a>(pub(super) &'a [Spheres]);

impl Objects for InSpheres<'_> {
    type RayPrecision = InF32;

    #[inline(always)]
    fn test(&self, _: usize, candidate: &Candidate, rays: &LaneRays, _: &[Ray], t_max: f64) -> f64 {
        let ray = widened(&rays.rays[candidate.ray as usize]);
        let block = &self.0[candidate.block as usize];
        let t = block
            .sphere(candidate.place as usize)
            .intersect_exact(&ray, t_max);
        t.unwrap_or(f64::NAN)
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

impl<N: RayPrecision, F: Form> Objects for InArray<'_, N, F> {
    type RayPrecision = N;

    #[inline(always)]
    fn test(
        &self,
        _: usize,
        candidate: &Candidate,
        rays: &LaneRays,
        world: &[Ray],
        t_max: f64,
    ) -> f64 {
        let ray = N::tested(rays, candidate.ray as usize, world);
        let t = self.objects[candidate.object as usize].intersect_exact(&ray, t_max);
        t.unwrap_or(f64::NAN)
    }
}

/// What is nearest?
pub(super) struct Closest<'a, O> {
    objects: O,
    rays: &'a [Ray],
    /// By ray: its answer, if it is done; if it is on its way, the nearest so far, with a distance on the
    /// ray that objects are tested with.
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

    fn begin(&mut self, rays: &LaneRays, part: usize) {
        for (slot, number) in rays.of_part(part) {
            let t = O::RayPrecision::t_max(rays, slot, self.rays);
            self.hits[number] = Hit { t, ..Hit::MISS };
        }
    }

    fn end(&mut self, rays: &LaneRays, part: usize) {
        for (slot, number) in rays.of_part(part) {
            let hit = &mut self.hits[number];
            let t = O::RayPrecision::to_world(rays, slot, hit.t);
            hit.t = select_unpredictable(hit.is_hit(), t, Hit::MISS.t);
        }
    }

    fn hit(&mut self, _: &LaneRays, _: &[u32]) {
        unreachable!("it matters where");
    }

    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]) {
        for candidates in candidates.chunks(MANY) {
            self.objects.begin(candidates, rays);
            for (k, candidate) in candidates.iter().enumerate() {
                let (slot, object) = (candidate.ray as usize, candidate.object);
                let best = &mut self.hits[rays.number(slot)];
                // Found in the leaf before.
                if !O::AT_ONCE && object == best.object {
                    continue;
                }
                let t = self.objects.test(k, candidate, rays, self.rays, best.t);
                let nearer = (t < best.t) | (t == best.t) & (object < best.object);
                *best = select_unpredictable(nearer, Hit { t, object }, *best);
                let limit = &mut limits[candidate.lane as usize];
                *limit =
                    select_unpredictable(nearer, O::RayPrecision::limit(rays, slot, t), *limit);
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

    fn begin(&mut self, rays: &LaneRays, part: usize) {
        self.blocked[rays.parts[part].clone()].fill(false);
    }

    fn end(&mut self, _: &LaneRays, _: usize) {}

    fn hit(&mut self, rays: &LaneRays, slots: &[u32]) {
        for &slot in slots {
            self.blocked[rays.number(slot as usize)] = true;
        }
    }

    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]) {
        for candidates in candidates.chunks(MANY) {
            self.objects.begin(candidates, rays);
            for (k, candidate) in candidates.iter().enumerate() {
                let t_max = O::RayPrecision::t_max(rays, candidate.ray as usize, self.rays);
                let t = self.objects.test(k, candidate, rays, self.rays, t_max);
                if !t.is_nan() {
                    self.hit(rays, &[candidate.ray]);
                    limits[candidate.lane as usize] = -1.0;
                }
            }
        }
    }
}
