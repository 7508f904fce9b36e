//! Blocks of objects that are tested against a ray at once. The tests only decide which objects the
//! ray may hit in spite of rounding to `f32`. These few candidates then get the exact test.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use crate::structure::simd_tree::{BlockData, NONE};
use crate::trace::simd::arithmetic::Simd;
use crate::trace::simd::ray::{RayBuffer, SimdRay};
use crate::trace::simd::ray_packet::{Bundle, Packet};

/// Evaluates `$body` for each vector of objects in a block, from `$at` on, and joins the masks. The
/// numbers of places without an object are NaN, which nothing hits.
macro_rules! each_vector {
    ($simd:ident, $objects:expr, $at:ident => $body:expr) => {{
        let mut found = HitMasks::default();
        let mut $at = 0;
        while $at < $objects.len() && ($at == 0 || $objects[$at] != NONE) {
            let masks: HitMasks = $body;
            found.possible |= masks.possible << $at;
            found.certain |= masks.certain << $at;
            $at += $simd::LANES;
        }
        found
    }};
}
pub(super) use each_vector;

/// The tests of a block of objects of one kind.
pub(crate) trait Block: BlockData {
    /// Returns the objects that the ray in a slot may hit up to the distance `limit`, and if `any_hit` is
    /// set those that it certainly hits.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &RayBuffer,
        ray: usize,
        limit: f32,
        any_hit: bool,
    ) -> HitMasks;

    /// Returns the lower and upper corners, along these axes, of the bounds of a vector of objects from
    /// the place `at` on.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn bounds<S: Simd>(&self, axes: [usize; 3], at: usize) -> [[S::F; 3]; 2];

    /// Returns the objects that some ray of a bundle may hit, as a mask of places.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn candidates_of_bundle<S: Simd>(&self, bundle: &Bundle) -> u32 {
        let found = each_vector!(S, self.objects(), at => {
            let corners = self.bounds::<S>(bundle.axes, at);
            HitMasks { possible: S::mask_bits(overlaps_bundle::<S>(corners, bundle)), certain: 0 }
        });
        found.possible
    }

    /// Returns the rays of a packet that may hit the object in a place, each up to its own limit, and if
    /// `any_hit` is set those that certainly hit it. The rays have the axis of the largest component in
    /// common.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn candidate_rays<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        any_hit: bool,
    ) -> HitMasks;
}

/// Returns which boxes some ray of a bundle may hit: those whose bounds, sheared by the rays, contain
/// the origin. The corners' axes are in the order of the bundle's.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn overlaps_bundle<S: Simd>([low, high]: [[S::F; 3]; 2], bundle: &Bundle) -> S::M {
    let [x, y, z] = bundle.origin;
    let z_low = S::sub(low[2], S::splat(z[1]));
    let z_high = S::sub(high[2], S::splat(z[0]));
    let x_overlaps = contains_zero::<S>(
        [low[0], high[0]],
        x,
        [z_low, z_high],
        bundle.shear[0],
        bundle,
    );
    let y_overlaps = contains_zero::<S>(
        [low[1], high[1]],
        y,
        [z_low, z_high],
        bundle.shear[1],
        bundle,
    );
    S::and(x_overlaps, y_overlaps)
}

/// Returns whether `coordinate − origin − shear · z` may be 0, where each of the four is known by its
/// bounds.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn contains_zero<S: Simd>(
    [low, high]: [S::F; 2],
    origin: [f32; 2],
    [z_low, z_high]: [S::F; 2],
    shear: [f32; 2],
    bundle: &Bundle,
) -> S::M {
    let (min_shear, max_shear) = (S::splat(shear[0]), S::splat(shear[1]));
    let (a, b) = (S::mul(min_shear, z_low), S::mul(min_shear, z_high));
    let (c, d) = (S::mul(max_shear, z_low), S::mul(max_shear, z_high));
    let max_shift = S::max(S::max(a, b), S::max(c, d));
    let min_shift = S::min(S::min(a, b), S::min(c, d));
    let low = S::sub(S::sub(low, S::splat(origin[1])), max_shift);
    let high = S::sub(S::sub(high, S::splat(origin[0])), min_shift);
    S::and(
        S::le(low, S::splat(bundle.error)),
        S::le(S::splat(-bundle.error), high),
    )
}

/// Masks of a block's objects against a ray, or of a packet's rays against an object.
#[derive(Clone, Copy, Default)]
pub(crate) struct HitMasks {
    /// Pairs that may be hits.
    pub(crate) possible: u32,
    /// Those of them that certainly are hits within the ray's own interval.
    pub(crate) certain: u32,
}

/// Bound on the error of a distance along the ray, as a multiple of `reach`.
pub(super) const T_ERROR: f32 = 32.0 * f32::EPSILON;

/// The interval of a ray in which hits count, with room for rounding.
#[derive(Clone, Copy)]
pub(super) struct HitInterval<S: Simd> {
    /// Outside of these, a hit certainly does not count.
    pub(super) nearest: S::F,
    pub(super) farthest: S::F,
    /// Between these, a hit certainly counts.
    pub(super) begin: S::F,
    pub(super) end: S::F,
    /// Bound on the error of a distance.
    pub(super) error: S::F,
}

impl<S: Simd> HitInterval<S> {
    /// One ray in all lanes.
    #[inline(always)]
    pub(super) unsafe fn of_ray(ray: &SimdRay, limit: f32) -> Self {
        let error = T_ERROR * ray.reach;
        HitInterval {
            nearest: S::splat(ray.t_min - error),
            farthest: S::splat(limit + error),
            begin: S::splat(ray.t_min + error),
            end: S::splat(ray.t_max - error),
            error: S::splat(error),
        }
    }

    /// One ray per lane.
    #[inline(always)]
    pub(super) unsafe fn of_packet(packet: &Packet, limits: S::F) -> Self {
        let error = S::mul(S::load(packet.reach.as_ptr()), S::splat(T_ERROR));
        let [t_min, t_max] = [&packet.t_min, &packet.t_max].map(|t| S::load(t.as_ptr()));
        HitInterval {
            nearest: S::sub(t_min, error),
            farthest: S::add(limits, error),
            begin: S::add(t_min, error),
            end: S::sub(t_max, error),
            error,
        }
    }
}

#[inline(always)]
pub(super) unsafe fn dot<S: Simd>(p: [S::F; 3], q: [S::F; 3]) -> S::F {
    S::mul_add(p[0], q[0], S::mul_add(p[1], q[1], S::mul(p[2], q[2])))
}

#[inline(always)]
pub(super) unsafe fn splat3<S: Simd>([x, y, z]: [f32; 3]) -> [S::F; 3] {
    [S::splat(x), S::splat(y), S::splat(z)]
}
