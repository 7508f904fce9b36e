//! The exact tests: those of the scalar kernel, on the same numbers.

use super::array::three;
use super::candidate::{Candidate, ExactTests};
use super::crossings::{BATCH, Crossings};
use super::instruction_set::InstructionSet;
use super::ray::{RayBuffer, SimdRay};
use crate::geometry::{Axis, Ray, Vec3};
use crate::primitive::{Estimate, Form, PackedSphere, PackedTriangle, Triangle, rotated};
use crate::structure::simd_tree::{Spheres, Triangles};
use crate::trace::Hit;
use crate::trace::query::wins_tie;
use std::hint::select_unpredictable;
use std::marker::PhantomData;

/// Converts a ray to `f64`.
#[inline(always)]
fn to_f64(ray: &SimdRay) -> Ray {
    Ray {
        origin: three(|k| f64::from(ray.origin[k])).into(),
        direction: three(|k| f64::from(ray.direction[k])).into(),
        t_min: f64::from(ray.t_min),
        t_max: f64::from(ray.t_max),
    }
}

/// The precision of exact tests.
pub(super) trait TestPrecision {
    /// Whether rays that begin behind their origin are left to the scalar kernel.
    const FORWARD_ONLY: bool;

    /// Returns the ray that objects are tested with, for the prepared ray in `slot`. Distances of tests
    /// are along this ray.
    fn test_ray(rays: &RayBuffer, slot: usize, world: &[Ray]) -> Ray;

    /// Returns the end of that ray.
    fn t_max(rays: &RayBuffer, slot: usize, world: &[Ray]) -> f64;

    /// Converts a distance along that ray to one along the world's ray.
    fn to_world(rays: &RayBuffer, slot: usize, t: f64) -> f64;

    /// Converts a distance along that ray to one in the unit frame, rounded up.
    fn limit(rays: &RayBuffer, slot: usize, t: f64) -> f32;
}

/// Tests of packed objects: `f32`, in the unit frame.
pub(super) struct InF32;

impl TestPrecision for InF32 {
    /// The scalar kernel, too, lets packed rays begin at 0 at the earliest.
    const FORWARD_ONLY: bool = false;

    #[inline(always)]
    fn test_ray(rays: &RayBuffer, slot: usize, _: &[Ray]) -> Ray {
        to_f64(&rays.rays[slot])
    }

    #[inline(always)]
    fn t_max(rays: &RayBuffer, slot: usize, _: &[Ray]) -> f64 {
        f64::from(rays.rays[slot].t_max)
    }

    #[inline(always)]
    fn to_world(rays: &RayBuffer, slot: usize, t: f64) -> f64 {
        rays.to_world(slot, t)
    }

    #[inline(always)]
    fn limit(_: &RayBuffer, _: usize, t: f64) -> f32 {
        t as f32
    }
}

/// Tests in `f64`, in the world.
pub(super) struct InF64;

impl TestPrecision for InF64 {
    const FORWARD_ONLY: bool = true;

    #[inline(always)]
    fn test_ray(rays: &RayBuffer, slot: usize, world: &[Ray]) -> Ray {
        world[rays.index(slot)]
    }

    #[inline(always)]
    fn t_max(rays: &RayBuffer, slot: usize, world: &[Ray]) -> f64 {
        world[rays.index(slot)].t_max
    }

    #[inline(always)]
    fn to_world(_: &RayBuffer, _: usize, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn limit(rays: &RayBuffer, slot: usize, t: f64) -> f32 {
        (rays.to_frame(slot, t) as f32).next_up()
    }
}

/// The objects of exact tests.
pub(super) trait TestObjects {
    type Precision: TestPrecision;

    /// Whether [`TestObjects::begin`] computes the tests of all candidates.
    const BATCHED: bool = false;

    /// Computes what can be computed for several candidates at once, at most [`BATCH`].
    /// [`TestObjects::test`] is then called for each of them, or with `any_hit` [`TestObjects::is_hit`].
    fn begin(&mut self, _: &[Candidate], _: &RayBuffer, _: &[Ray], _: bool) {}

    /// Returns [`Form::intersect_exact`] up to `t_max` of a candidate, the `k`th of those passed to
    /// [`TestObjects::begin`]; NaN for no hit. `world` are the rays in the world.
    fn test(
        &self,
        k: usize,
        candidate: &Candidate,
        rays: &RayBuffer,
        world: &[Ray],
        t_max: f64,
    ) -> f64;

    /// Returns [`Form::is_hit_exact`] of a candidate, likewise.
    fn is_hit(&self, k: usize, candidate: &Candidate, rays: &RayBuffer, world: &[Ray]) -> bool {
        let t_max = Self::Precision::t_max(rays, candidate.ray as usize, world);
        !self.test(k, candidate, rays, world, t_max).is_nan()
    }

    /// Returns [`wins_tie`] of a candidate.
    fn wins_tie(&self, candidate: &Candidate, best: &Hit, rays: &RayBuffer, world: &[Ray]) -> bool;
}

/// Triangles in their blocks, which are still in the cache.
pub(super) struct InTriangles<'a, const N: usize> {
    blocks: &'a [Triangles<N>],
    triangles: &'a [PackedTriangle],
    crossings: Crossings<f32>,
    instructions: InstructionSet,
}

impl<'a, const N: usize> InTriangles<'a, N> {
    pub(super) fn new(
        blocks: &'a [Triangles<N>],
        triangles: &'a [PackedTriangle],
        instructions: InstructionSet,
    ) -> Self {
        InTriangles {
            blocks,
            triangles,
            crossings: Crossings::new(),
            instructions,
        }
    }
}

impl<const N: usize> TestObjects for InTriangles<'_, N> {
    type Precision = InF32;

    const BATCHED: bool = true;

    #[inline(always)]
    fn begin(&mut self, candidates: &[Candidate], rays: &RayBuffer, _: &[Ray], _: bool) {
        for (k, candidate) in candidates.iter().enumerate() {
            let ray = &rays.rays[candidate.ray as usize];
            let axes = ray.rotated_axes();
            let block = &self.blocks[candidate.block as usize];
            let vertices = block.vertices(candidate.place as usize, axes);
            let [origin, direction] = [ray.origin, ray.direction].map(|v| three(|j| v[axes[j]]));
            self.crossings.set(k, vertices, origin, direction);
        }
        let count = candidates.len();
        self.crossings.compute(self.instructions, count, false);
    }

    #[inline(always)]
    fn test(
        &self,
        k: usize,
        candidate: &Candidate,
        rays: &RayBuffer,
        _: &[Ray],
        t_max: f64,
    ) -> f64 {
        let estimate = self.crossings.estimate(k);
        let ray = &rays.rays[candidate.ray as usize];
        let interval = [f64::from(ray.t_min), f64::from(ray.t_max)];
        let t = Estimate::settle([estimate], interval, t_max, |known| {
            self.triangles[candidate.object as usize].intersect_slowly(known, &to_f64(ray))
        });
        t.unwrap_or(f64::NAN)
    }

    fn wins_tie(&self, candidate: &Candidate, best: &Hit, rays: &RayBuffer, _: &[Ray]) -> bool {
        let ray = to_f64(&rays.rays[candidate.ray as usize]);
        wins_tie(self.triangles, candidate.object, best, &ray)
    }
}

/// Triangles of the scene, in `f64`.
pub(super) struct InWideTriangles<'a> {
    triangles: &'a [Triangle],
    crossings: Crossings<f64>,
    instructions: InstructionSet,
}

impl<'a> InWideTriangles<'a> {
    pub(super) fn new(triangles: &'a [Triangle], instructions: InstructionSet) -> Self {
        InWideTriangles {
            triangles,
            crossings: Crossings::new(),
            instructions,
        }
    }
}

impl TestObjects for InWideTriangles<'_> {
    type Precision = InF64;

    const BATCHED: bool = true;

    #[inline(always)]
    fn begin(&mut self, candidates: &[Candidate], rays: &RayBuffer, world: &[Ray], any_hit: bool) {
        for (k, candidate) in candidates.iter().enumerate() {
            let ray = &world[rays.index(candidate.ray as usize)];
            let axis = Axis::of_largest(ray.direction.abs().to_array());
            let rotate = |v: Vec3| rotated(v, axis).to_array();
            let vertices = self.triangles[candidate.object as usize]
                .vertices
                .map(rotate);
            let [origin, direction] = [ray.origin, ray.direction].map(rotate);
            self.crossings.set(k, vertices, origin, direction);
        }
        let count = candidates.len();
        self.crossings.compute(self.instructions, count, !any_hit);
    }

    #[inline(always)]
    fn test(
        &self,
        k: usize,
        candidate: &Candidate,
        rays: &RayBuffer,
        world: &[Ray],
        t_max: f64,
    ) -> f64 {
        let ray = &world[rays.index(candidate.ray as usize)];
        let (estimate, nearest) = (self.crossings.estimate(k), self.crossings.nearest(k));
        let triangle = &self.triangles[candidate.object as usize];
        let t = triangle.settle(estimate, nearest, ray, t_max);
        t.unwrap_or(f64::NAN)
    }

    #[inline(always)]
    fn is_hit(&self, k: usize, candidate: &Candidate, rays: &RayBuffer, world: &[Ray]) -> bool {
        let ray = &world[rays.index(candidate.ray as usize)];
        self.triangles[candidate.object as usize].settle_any(self.crossings.estimate(k), ray)
    }

    fn wins_tie(&self, candidate: &Candidate, best: &Hit, rays: &RayBuffer, world: &[Ray]) -> bool {
        let ray = &world[rays.index(candidate.ray as usize)];
        wins_tie(self.triangles, candidate.object, best, ray)
    }
}

/// Spheres in their blocks.
pub(super) struct InSpheres<'a, const N: usize> {
    blocks: &'a [Spheres<N>],
    spheres: &'a [PackedSphere],
}

impl<'a, const N: usize> InSpheres<'a, N> {
    pub(super) fn new(blocks: &'a [Spheres<N>], spheres: &'a [PackedSphere]) -> Self {
        InSpheres { blocks, spheres }
    }
}

impl<const N: usize> TestObjects for InSpheres<'_, N> {
    type Precision = InF32;

    #[inline(always)]
    fn test(
        &self,
        _: usize,
        candidate: &Candidate,
        rays: &RayBuffer,
        _: &[Ray],
        t_max: f64,
    ) -> f64 {
        let ray = to_f64(&rays.rays[candidate.ray as usize]);
        let block = &self.blocks[candidate.block as usize];
        let t = block
            .sphere(candidate.place as usize)
            .intersect_exact(&ray, t_max);
        t.unwrap_or(f64::NAN)
    }

    fn wins_tie(&self, candidate: &Candidate, best: &Hit, rays: &RayBuffer, _: &[Ray]) -> bool {
        let ray = to_f64(&rays.rays[candidate.ray as usize]);
        wins_tie(self.spheres, candidate.object, best, &ray)
    }
}

/// Objects in an array, by index.
pub(super) struct InArray<'a, P, F> {
    objects: &'a [F],
    precision: PhantomData<P>,
}

impl<'a, P, F> InArray<'a, P, F> {
    pub(super) fn new(objects: &'a [F]) -> Self {
        InArray {
            objects,
            precision: PhantomData,
        }
    }
}

impl<P: TestPrecision, F: Form> TestObjects for InArray<'_, P, F> {
    type Precision = P;

    #[inline(always)]
    fn test(
        &self,
        _: usize,
        candidate: &Candidate,
        rays: &RayBuffer,
        world: &[Ray],
        t_max: f64,
    ) -> f64 {
        let ray = P::test_ray(rays, candidate.ray as usize, world);
        let t = self.objects[candidate.object as usize].intersect_exact(&ray, t_max);
        t.unwrap_or(f64::NAN)
    }

    #[inline(always)]
    fn is_hit(&self, _: usize, candidate: &Candidate, rays: &RayBuffer, world: &[Ray]) -> bool {
        let ray = P::test_ray(rays, candidate.ray as usize, world);
        self.objects[candidate.object as usize].is_hit_exact(&ray)
    }

    fn wins_tie(&self, candidate: &Candidate, best: &Hit, rays: &RayBuffer, world: &[Ray]) -> bool {
        let ray = P::test_ray(rays, candidate.ray as usize, world);
        wins_tie(self.objects, candidate.object, best, &ray)
    }
}

/// Finds the closest hit of every ray.
pub(super) struct Closest<'a, O> {
    objects: O,
    rays: &'a [Ray],
    /// By ray. While a ray is traced this is the closest hit so far, with a distance along the test's
    /// ray; then it is the answer.
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

impl<O: TestObjects> ExactTests for Closest<'_, O> {
    fn any_hit_suffices(&self) -> bool {
        false
    }

    fn begin(&mut self, rays: &RayBuffer, chunk: usize) {
        for (slot, index) in rays.chunk(chunk) {
            let t = O::Precision::t_max(rays, slot, self.rays);
            self.hits[index] = Hit { t, ..Hit::MISS };
        }
    }

    fn end(&mut self, rays: &RayBuffer, chunk: usize) {
        for (slot, index) in rays.chunk(chunk) {
            let hit = &mut self.hits[index];
            let t = O::Precision::to_world(rays, slot, hit.t);
            hit.t = select_unpredictable(hit.is_hit(), t, Hit::MISS.t);
        }
    }

    fn mark_hit(&mut self, _: &RayBuffer, _: &[u32]) {
        unreachable!("the distance matters");
    }

    fn test(&mut self, rays: &RayBuffer, candidates: &[Candidate], limits: &mut [f32]) {
        for candidates in candidates.chunks(BATCH) {
            self.objects.begin(candidates, rays, self.rays, false);
            for (k, candidate) in candidates.iter().enumerate() {
                let (slot, object) = (candidate.ray as usize, candidate.object);
                let best = &mut self.hits[rays.index(slot)];
                // The closest hit so far, which another leaf has a reference to.
                if !O::BATCHED && object == best.object {
                    continue;
                }
                let t = self.objects.test(k, candidate, rays, self.rays, best.t);
                let nearer = t < best.t
                    || t == best.t && self.objects.wins_tie(candidate, best, rays, self.rays);
                *best = select_unpredictable(nearer, Hit { t, object }, *best);
                let limit = &mut limits[candidate.lane as usize];
                *limit = select_unpredictable(nearer, O::Precision::limit(rays, slot, t), *limit);
            }
        }
    }
}

/// Finds whether every ray hits anything.
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

impl<O: TestObjects> ExactTests for Any<'_, O> {
    fn any_hit_suffices(&self) -> bool {
        true
    }

    fn begin(&mut self, rays: &RayBuffer, chunk: usize) {
        self.blocked[rays.chunks[chunk].clone()].fill(false);
    }

    fn end(&mut self, _: &RayBuffer, _: usize) {}

    fn mark_hit(&mut self, rays: &RayBuffer, slots: &[u32]) {
        for &slot in slots {
            self.blocked[rays.index(slot as usize)] = true;
        }
    }

    fn test(&mut self, rays: &RayBuffer, candidates: &[Candidate], limits: &mut [f32]) {
        for candidates in candidates.chunks(BATCH) {
            self.objects.begin(candidates, rays, self.rays, true);
            for (k, candidate) in candidates.iter().enumerate() {
                if self.objects.is_hit(k, candidate, rays, self.rays) {
                    self.mark_hit(rays, &[candidate.ray]);
                    limits[candidate.lane as usize] = -1.0;
                }
            }
        }
    }
}
