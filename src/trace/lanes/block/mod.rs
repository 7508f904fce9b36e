//! Blocks of objects that are held against a ray at once. What is decided here is only which of them
//! the ray may hit, whatever `f32` has rounded; those few are then tested one by one.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

mod boxes;
mod spheres;
mod triangles;

use super::packet::{Bundle, Packet};
use super::ray::{LaneRay, LaneRays};
use super::simd::Simd;
use crate::primitive::{Primitive, UnitFrame};
pub(super) use boxes::Boxes;
pub(super) use spheres::Spheres;
pub(super) use triangles::Triangles;

/// Objects of a block.
pub(super) const BLOCK: usize = 16;

type Numbers = [f32; BLOCK];

/// No object.
pub(super) const NONE: u32 = u32::MAX;

/// Runs `$body` for every part of a block that fills the lanes and gathers its bits. The numbers of
/// places without an object are NaN, which nothing hits.
macro_rules! parts {
    ($simd:ident, $objects:expr, $at:ident => $body:expr) => {{
        let mut found = MayHit::default();
        let mut $at = 0;
        while $at < BLOCK && ($at == 0 || $objects[$at] != NONE) {
            let part: MayHit = $body;
            found.maybe |= part.maybe << $at;
            found.surely |= part.surely << $at;
            $at += $simd::LANES;
        }
        found
    }};
}
use parts;

pub(super) trait Block: Copy + Default + Send + Sync {
    /// Puts an object in its place; the frame's coordinates are those of the block.
    fn set(&mut self, lane: usize, object: u32, primitive: &Primitive, frame: &UnitFrame);

    fn objects(&self) -> &[u32; BLOCK];

    /// What the ray of this number may hit up to the distance `limit`, and, if `any` will do, what it
    /// surely hits.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &LaneRays,
        ray: usize,
        limit: f32,
        any: bool,
    ) -> MayHit;

    /// Lower and upper corners, along these axes, of what bounds the objects from the place `at` on.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn bounds<S: Simd>(&self, axes: [usize; 3], at: usize) -> [[S::F; 3]; 2];

    /// Objects that may be in the way of some ray of a bundle, a bit for each place.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn near<S: Simd>(&self, bundle: &Bundle) -> u32 {
        let found = parts!(S, self.objects(), at => {
            let corners = self.bounds::<S>(bundle.axes, at);
            MayHit { maybe: S::bits(in_the_way::<S>(corners, bundle)), surely: 0 }
        });
        found.maybe
    }

    /// The same the other way about: which rays of a packet may hit, or surely hit, the object in a
    /// place, each up to its own limit. The rays have one axis of the largest component.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn rays_that_may_hit<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        any: bool,
    ) -> MayHit;
}

/// Of what lies in boxes with these lower and upper corners, their axes turned as the bundle's, what is
/// in the way of some ray of the bundle: from the ray's side, where its sheared bounds hold the origin.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn in_the_way<S: Simd>([low, high]: [[S::F; 3]; 2], bundle: &Bundle) -> S::M {
    let [x, y, z] = bundle.origin;
    let z_low = S::sub(low[2], S::splat(z[1]));
    let z_high = S::sub(high[2], S::splat(z[0]));
    let x_meets = holds_zero::<S>(
        [low[0], high[0]],
        x,
        [z_low, z_high],
        bundle.shear[0],
        bundle,
    );
    let y_meets = holds_zero::<S>(
        [low[1], high[1]],
        y,
        [z_low, z_high],
        bundle.shear[1],
        bundle,
    );
    S::and(x_meets, y_meets)
}

/// Whether a coordinate less that of an origin, less a shear times the distance along the third axis,
/// may be 0, each between two bounds.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn holds_zero<S: Simd>(
    [low, high]: [S::F; 2],
    origin: [f32; 2],
    [z_low, z_high]: [S::F; 2],
    shear: [f32; 2],
    bundle: &Bundle,
) -> S::M {
    let (least, most) = (S::splat(shear[0]), S::splat(shear[1]));
    let (a, b) = (S::mul(least, z_low), S::mul(least, z_high));
    let (c, d) = (S::mul(most, z_low), S::mul(most, z_high));
    let moved_most = S::max(S::max(a, b), S::max(c, d));
    let moved_least = S::min(S::min(a, b), S::min(c, d));
    let low = S::sub(S::sub(low, S::splat(origin[1])), moved_most);
    let high = S::sub(S::sub(high, S::splat(origin[0])), moved_least);
    S::and(
        S::le(low, S::splat(bundle.error)),
        S::le(S::splat(-bundle.error), high),
    )
}

/// Bound on the error of a sheared coordinate, as a multiple of `reach`: twice that of a point of a
/// triangle, see [`triangles`].
pub(super) const SHEARED_ERROR: f32 = 16.0 * f32::EPSILON;

/// Objects of a block that a ray may hit, or rays of a packet that may hit an object, a bit for each.
#[derive(Clone, Copy, Default)]
pub(super) struct MayHit {
    pub(super) maybe: u32,
    /// Those of them that certainly hit or are hit, up to the ray's own end.
    pub(super) surely: u32,
}

/// Of a distance along the ray.
const T_ERROR: f32 = 32.0 * f32::EPSILON;

/// Where on a ray in `f32` a hit must lie to count, and where to count whatever was rounded.
#[derive(Clone, Copy)]
struct Within<S: Simd> {
    nearest: S::F,
    farthest: S::F,
    begin: S::F,
    end: S::F,
    /// Bound on the error of a distance, which these have room for.
    error: S::F,
}

impl<S: Simd> Within<S> {
    /// One ray in all lanes.
    #[inline(always)]
    unsafe fn of_one(ray: &LaneRay, limit: f32) -> Self {
        let error = T_ERROR * ray.reach;
        Within {
            nearest: S::splat(ray.t_min - error),
            farthest: S::splat(limit + error),
            begin: S::splat(ray.t_min + error),
            end: S::splat(ray.t_max - error),
            error: S::splat(error),
        }
    }

    /// A ray a lane.
    #[inline(always)]
    unsafe fn of_each(packet: &Packet, limits: S::F) -> Self {
        let error = S::mul(S::load(packet.reach.as_ptr()), S::splat(T_ERROR));
        let [t_min, t_max] = [&packet.t_min, &packet.t_max].map(|t| S::load(t.as_ptr()));
        Within {
            nearest: S::sub(t_min, error),
            farthest: S::add(limits, error),
            begin: S::add(t_min, error),
            end: S::sub(t_max, error),
            error,
        }
    }
}

#[inline(always)]
unsafe fn dot<S: Simd>(p: [S::F; 3], q: [S::F; 3]) -> S::F {
    S::mul_add(p[0], q[0], S::mul_add(p[1], q[1], S::mul(p[2], q[2])))
}

#[inline(always)]
unsafe fn splat3<S: Simd>([x, y, z]: [f32; 3]) -> [S::F; 3] {
    [S::splat(x), S::splat(y), S::splat(z)]
}
