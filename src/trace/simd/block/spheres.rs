//! Blocks of spheres, by center and radius.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::interface::{Block, HitInterval, HitMasks, dot, each_vector, splat3};
use crate::structure::simd_tree::{NONE, Spheres};
use crate::trace::simd::arithmetic::Simd;
use crate::trace::simd::array::three;
use crate::trace::simd::ray::RayBuffer;
use crate::trace::simd::ray_packet::{Lanes, Packet};

/// Bound on the error of the distance between a center and the ray, as a multiple of `reach`: twice that
/// of [`crate::primitive::PackedSphere`].
const OFFSET_ERROR: f32 = 96.0 * f32::EPSILON;

impl<const N: usize> Block for Spheres<N> {
    #[inline(always)]
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &RayBuffer,
        ray: usize,
        limit: f32,
        any_hit: bool,
    ) -> HitMasks {
        let ray = rays.rays.get_unchecked(ray);
        let [x, y, z] = ray.direction;
        let squared = x * x + y * y + z * z;
        let test = SphereTest::<S> {
            origin: splat3::<S>(ray.origin),
            direction: splat3::<S>(ray.direction),
            per_square: S::splat(1.0 / squared),
            per_length: S::splat(ROUND_UP / squared.sqrt()),
            error: S::splat(OFFSET_ERROR * ray.reach),
            interval: HitInterval::of_ray(ray, limit),
        };
        each_vector!(S, self.objects, at => {
            let center = three(|k| S::load(self.center[k].as_ptr().add(at)));
            test.hits(center, S::load(self.radius.as_ptr().add(at)), any_hit)
        })
    }

    #[inline(always)]
    unsafe fn bounds<S: Simd>(&self, axes: [usize; 3], at: usize) -> [[S::F; 3]; 2] {
        let radius = S::load(self.radius.as_ptr().add(at));
        let (mut low, mut high) = ([radius; 3], [radius; 3]);
        for k in 0..3 {
            let center = S::load(self.center.get_unchecked(axes[k]).as_ptr().add(at));
            low[k] = S::sub(center, radius);
            high[k] = S::add(center, radius);
        }
        [low, high]
    }

    #[inline(always)]
    unsafe fn candidate_rays<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        any_hit: bool,
    ) -> HitMasks {
        let load = |lanes: &Lanes| S::load(lanes.as_ptr());
        let direction = three(|k| load(&packet.direction[k]));
        let squared = dot::<S>(direction, direction);
        let one = S::splat(1.0);
        let test = SphereTest::<S> {
            origin: three(|k| load(&packet.origin[k])),
            direction,
            per_square: S::div(one, squared),
            per_length: S::div(S::splat(ROUND_UP), S::sqrt(squared)),
            error: S::mul(load(&packet.reach), S::splat(OFFSET_ERROR)),
            interval: HitInterval::of_packet(packet, limits),
        };
        let center = three(|k| S::splat(*self.center[k].get_unchecked(place)));
        test.hits(center, S::splat(*self.radius.get_unchecked(place)), any_hit)
    }
}

/// Factor that keeps a computed 1 / length from being below the exact one.
const ROUND_UP: f32 = 1.0 + 4.0 * f32::EPSILON;

/// One ray against many spheres, or many rays against one sphere.
struct SphereTest<S: Simd> {
    origin: [S::F; 3],
    direction: [S::F; 3],
    /// 1 / direction².
    per_square: S::F,
    /// At least 1 / length of the direction.
    per_length: S::F,
    /// Bound on the error of the distance between a center and the ray.
    error: S::F,
    interval: HitInterval<S>,
}

impl<S: Simd> SphereTest<S> {
    /// Compares the distance between center and line with the radius, and the ray's interval with that
    /// around the point nearest to the center.
    #[inline(always)]
    unsafe fn hits(&self, center: [S::F; 3], radius: S::F, any_hit: bool) -> HitMasks {
        let HitInterval {
            nearest,
            farthest,
            begin,
            end,
            ..
        } = self.interval;
        let to = three(|k| S::sub(center[k], self.origin[k]));
        let along = S::mul(dot::<S>(to, self.direction), self.per_square);
        let off = three(|k| S::sub_mul(to[k], along, self.direction[k]));
        let squared = dot::<S>(off, off);
        let reach = S::add(radius, self.error);
        let near = S::le(squared, S::mul(reach, reach));
        let half = S::mul(reach, self.per_length);
        let first = S::sub(along, half);
        let reached = S::and(S::le(first, farthest), S::le(nearest, S::add(along, half)));
        let possible = S::and(near, reached);
        let mut found = HitMasks {
            possible: S::mask_bits(possible),
            certain: 0,
        };
        if any_hit {
            // The ray enters the sphere between `first` and the point nearest to the center.
            let inner = S::max(S::sub(radius, self.error), S::splat(0.0));
            let enters = S::lt(squared, S::mul(inner, inner));
            let within = S::and(S::le(begin, first), S::le(along, end));
            found.certain = S::mask_bits(S::and(possible, S::and(enters, within)));
        }
        found
    }
}
