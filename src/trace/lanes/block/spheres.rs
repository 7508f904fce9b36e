//! Spheres, by centre and radius.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::{BLOCK, Block, MayHit, NONE, Numbers, Within, dot, parts, splat3};
use crate::primitive::{PackedSphere, Primitive, UnitFrame};
use crate::trace::lanes::packet::Packet;
use crate::trace::lanes::ray::LaneRays;
use crate::trace::lanes::simd::Simd;
use crate::trace::lanes::three;

/// Bound on the error of the distance between a centre and the ray, as a multiple of `reach`: twice that
/// of [`PackedSphere`].
const OFFSET_ERROR: f32 = 96.0 * f32::EPSILON;

/// Spheres.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(in super::super) struct Spheres {
    center: [Numbers; 3],
    radius: Numbers,
    objects: [u32; BLOCK],
}

impl Default for Spheres {
    fn default() -> Self {
        Spheres {
            center: [[f32::NAN; BLOCK]; 3],
            radius: [f32::NAN; BLOCK],
            objects: [NONE; BLOCK],
        }
    }
}

impl Spheres {
    #[inline(always)]
    pub(in super::super) fn sphere(&self, place: usize) -> PackedSphere {
        let center = three(|k| self.center[k][place]).into();
        PackedSphere::from_center(center, self.radius[place])
    }
}

impl Block for Spheres {
    fn set(&mut self, lane: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let Primitive::Sphere(sphere) = primitive else {
            unreachable!("all objects are spheres");
        };
        let center = frame.point(sphere.center).as_vec3();
        for k in 0..3 {
            self.center[k][lane] = center[k];
        }
        self.radius[lane] = (sphere.radius * frame.scale()) as f32;
        self.objects[lane] = object;
    }

    fn objects(&self) -> &[u32; BLOCK] {
        &self.objects
    }

    #[inline(always)]
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &LaneRays,
        ray: usize,
        limit: f32,
        any: bool,
    ) -> MayHit {
        let ray = rays.rays.get_unchecked(ray);
        let [x, y, z] = ray.direction;
        let squared = x * x + y * y + z * z;
        let line = Straight::<S> {
            origin: splat3::<S>(ray.origin),
            direction: splat3::<S>(ray.direction),
            per_square: S::splat(1.0 / squared),
            per_length: S::splat(MORE / squared.sqrt()),
            error: S::splat(OFFSET_ERROR * ray.reach),
            within: Within::of_one(ray, limit),
        };
        parts!(S, self.objects, at => {
            let center = three(|k| S::load(self.center[k].as_ptr().add(at)));
            line.may_hit(center, S::load(self.radius.as_ptr().add(at)), any)
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
    unsafe fn rays_that_may_hit<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        any: bool,
    ) -> MayHit {
        let load = |numbers: &[f32; BLOCK]| S::load(numbers.as_ptr());
        let direction = three(|k| load(&packet.direction[k]));
        let squared = dot::<S>(direction, direction);
        let one = S::splat(1.0);
        let line = Straight::<S> {
            origin: three(|k| load(&packet.origin[k])),
            direction,
            per_square: S::div(one, squared),
            per_length: S::div(S::splat(MORE), S::sqrt(squared)),
            error: S::mul(load(&packet.reach), S::splat(OFFSET_ERROR)),
            within: Within::of_each(packet, limits),
        };
        let center = three(|k| S::splat(*self.center[k].get_unchecked(place)));
        line.may_hit(center, S::splat(*self.radius.get_unchecked(place)), any)
    }
}

/// Makes what is 1 over a length not less than that, whatever was rounded.
const MORE: f32 = 1.0 + 4.0 * f32::EPSILON;

/// Rays as spheres are held against them.
struct Straight<S: Simd> {
    origin: [S::F; 3],
    direction: [S::F; 3],
    /// 1 over the direction's square.
    per_square: S::F,
    /// Not below 1 over the direction's length.
    per_length: S::F,
    /// Of the distance between a centre and the ray.
    error: S::F,
    within: Within<S>,
}

impl<S: Simd> Straight<S> {
    /// The distance between the centre and the ray's line.
    #[inline(always)]
    unsafe fn may_hit(&self, center: [S::F; 3], radius: S::F, any: bool) -> MayHit {
        let Within {
            nearest,
            farthest,
            begin,
            end,
            ..
        } = self.within;
        let to = three(|k| S::sub(center[k], self.origin[k]));
        let along = S::mul(dot::<S>(to, self.direction), self.per_square);
        let off = three(|k| S::sub_mul(to[k], along, self.direction[k]));
        let squared = dot::<S>(off, off);
        let reach = S::add(radius, self.error);
        let met = S::le(squared, S::mul(reach, reach));
        let half = S::mul(reach, self.per_length);
        let first = S::sub(along, half);
        let reached = S::and(S::le(first, farthest), S::le(nearest, S::add(along, half)));
        let maybe = S::and(met, reached);
        let mut found = MayHit {
            maybe: S::bits(maybe),
            surely: 0,
        };
        if any {
            // The ray enters between there and the point nearest to the centre.
            let inner = S::max(S::sub(radius, self.error), S::splat(0.0));
            let enters = S::lt(squared, S::mul(inner, inner));
            let within = S::and(S::le(begin, first), S::le(along, end));
            found.surely = S::bits(S::and(maybe, S::and(enters, within)));
        }
        found
    }
}
