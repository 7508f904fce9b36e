//! Blocks of objects of any kind, by their bounds.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::interface::{Block, HitInterval, HitMasks, T_ERROR, each_vector};
use crate::structure::simd_tree::{Boxes, NONE};
use crate::trace::simd::arithmetic::Simd;
use crate::trace::simd::ray::RayBuffer;
use crate::trace::simd::ray_packet::{Lanes, Packet};

impl<const N: usize> Block for Boxes<N> {
    /// Tests slabs; faces are as thick as the planes of the tree.
    #[inline(always)]
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &RayBuffer,
        ray: usize,
        limit: f32,
        _: bool,
    ) -> HitMasks {
        let ray = rays.rays.get_unchecked(ray);
        let (reach, shifted) = (ray.reach, ray.shifted(rays.half_thickness));
        let nearest = S::splat(ray.t_min - T_ERROR * reach);
        let farthest = S::splat(limit + T_ERROR * reach);
        each_vector!(S, self.objects, at => {
            let (mut enter, mut exit) = (nearest, farthest);
            for k in 0..3 {
                let inverse = ray.inverse[k];
                let backward = usize::from(inverse.is_sign_negative());
                let inverse = S::splat(inverse);
                let shifted = S::splat(shifted[k]);
                let width = S::mul(S::abs(inverse), S::splat(2.0 * rays.half_thickness));
                let near = self.corners[backward][k].as_ptr().add(at);
                let far = self.corners[1 - backward][k].as_ptr().add(at);
                let begin = S::mul(S::sub(S::load(near), shifted), inverse);
                let end = S::mul(S::sub(S::load(far), shifted), inverse);
                enter = S::max(enter, begin);
                exit = S::min(exit, S::add(end, width));
            }
            HitMasks { possible: S::mask_bits(S::le(enter, exit)), certain: 0 }
        })
    }

    #[inline(always)]
    unsafe fn bounds<S: Simd>(&self, axes: [usize; 3], at: usize) -> [[S::F; 3]; 2] {
        let (mut low, mut high) = ([S::splat(0.0); 3], [S::splat(0.0); 3]);
        for k in 0..3 {
            low[k] = S::load(self.corners[0].get_unchecked(axes[k]).as_ptr().add(at));
            high[k] = S::load(self.corners[1].get_unchecked(axes[k]).as_ptr().add(at));
        }
        [low, high]
    }

    #[inline(always)]
    unsafe fn candidate_rays<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        _: bool,
    ) -> HitMasks {
        let load = |lanes: &Lanes| S::load(lanes.as_ptr());
        let HitInterval {
            nearest, farthest, ..
        } = HitInterval::<S>::of_packet(packet, limits);
        let (mut enter, mut exit) = (nearest, farthest);
        for k in 0..3 {
            let inverse = load(&packet.inverse[k]);
            let shifted = load(&packet.shifted[k]);
            let width = S::mul(S::abs(inverse), S::splat(2.0 * packet.half_thickness));
            let [low, high] = [0, 1].map(|end| {
                let corner = S::splat(*self.corners[end][k].get_unchecked(place));
                S::mul(S::sub(corner, shifted), inverse)
            });
            enter = S::max(enter, S::min(low, high));
            exit = S::min(exit, S::add(S::max(low, high), width));
        }
        HitMasks {
            possible: S::mask_bits(S::le(enter, exit)),
            certain: 0,
        }
    }
}
