//! Blocks of triangles, by their vertices.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::interface::{Block, HitInterval, HitMasks, each_vector, splat3};
use crate::structure::simd_tree::{NONE, Triangles};
use crate::trace::simd::arithmetic::Simd;
use crate::trace::simd::array::three;
use crate::trace::simd::ray::RayBuffer;
use crate::trace::simd::ray_packet::{Lanes, Packet};

/// Bound on the error of an edge function, as a multiple of `reach` times the triangle's size. It holds
/// for packed triangles and for the unrounded ones.
///
/// A sheared coordinate has an error of 4 ε by its own arithmetic ([`crate::primitive::PackedTriangle`])
/// and less than that by the rounding of origin, direction and vertex. An edge function has four such
/// errors times the size.
const EDGE_ERROR: f32 = 48.0 * f32::EPSILON;

impl<const N: usize> Block for Triangles<N> {
    #[inline(always)]
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &RayBuffer,
        ray: usize,
        limit: f32,
        any_hit: bool,
    ) -> HitMasks {
        let ray = rays.rays.get_unchecked(ray);
        let axes = ray.rotated_axes();
        let along = *ray.inverse.get_unchecked(axes[2]);
        let test = TriangleTest::<S> {
            origin: splat3::<S>(three(|k| *ray.origin.get_unchecked(axes[k]))),
            shear: [S::splat(ray.shear[0]), S::splat(ray.shear[1])],
            along: S::splat(along),
            error: S::splat(EDGE_ERROR * ray.reach),
            interval: HitInterval::of_ray(ray, limit),
        };
        each_vector!(S, self.objects, at => {
            let vertex = |i: usize| {
                let v = self.vertices.get_unchecked(i);
                three(|k| S::load(v.get_unchecked(axes[k]).as_ptr().add(at)))
            };
            test.hits([vertex(0), vertex(1), vertex(2)], any_hit, S::LANES < N)
        })
    }

    #[inline(always)]
    unsafe fn bounds<S: Simd>(&self, axes: [usize; 3], at: usize) -> [[S::F; 3]; 2] {
        let (mut low, mut high) = ([S::splat(0.0); 3], [S::splat(0.0); 3]);
        for k in 0..3 {
            let axis = axes[k];
            let a = S::load(self.vertices[0].get_unchecked(axis).as_ptr().add(at));
            let b = S::load(self.vertices[1].get_unchecked(axis).as_ptr().add(at));
            let c = S::load(self.vertices[2].get_unchecked(axis).as_ptr().add(at));
            low[k] = S::min(S::min(a, b), c);
            high[k] = S::max(S::max(a, b), c);
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
        let axes = packet.bundle.axes;
        let load = |lanes: &Lanes| S::load(lanes.as_ptr());
        let along = load(packet.inverse.get_unchecked(axes[2]));
        let test = TriangleTest::<S> {
            origin: three(|k| load(packet.origin.get_unchecked(axes[k]))),
            shear: [0, 1].map(|k| S::mul(load(packet.direction.get_unchecked(axes[k])), along)),
            along,
            error: S::mul(load(&packet.reach), S::splat(EDGE_ERROR)),
            interval: HitInterval::of_packet(packet, limits),
        };
        let vertex = |i: usize| {
            let v = self.vertices.get_unchecked(i);
            three(|k| S::splat(*v.get_unchecked(axes[k]).get_unchecked(place)))
        };
        test.hits([vertex(0), vertex(1), vertex(2)], any_hit, S::LANES < N)
    }
}

/// One ray against many triangles, or many rays against one triangle. The axis of the direction's
/// largest component is the last.
struct TriangleTest<S: Simd> {
    origin: [S::F; 3],
    shear: [S::F; 2],
    /// 1 / last component of the direction.
    along: S::F,
    /// Bound on the error of an edge function of a triangle of size 1.
    error: S::F,
    interval: HitInterval<S>,
}

impl<S: Simd> TriangleTest<S> {
    /// Tests triangles after Woop, Benthin and Wald ("Watertight ray/triangle intersection", JCGT 2(1),
    /// 2013), with bounds on rounding:
    ///
    /// ```text
    /// shear the vertices so that the ray is the third axis: a, b, c
    /// u, v, w = edge functions of the first two coordinates
    /// missed  = two of them have different signs, by more than rounding
    /// t       = (u a.z + v b.z + w c.z) / (u + v + w)
    /// reached = t is within the ray's interval, or outside of it by less than rounding
    /// possible = not missed and reached
    /// certain  = u, v, w have the same sign and t is within the interval, by more than rounding
    /// ```
    ///
    /// The bound on rounding: let e and E be the computed and the exact edge functions and z the
    /// distances of the vertices. The exact t solves Σ E (z − t) = 0, so Σ e z and t Σ e differ by
    /// Σ (e − E) (z − t), which is at most 3 `error` times the span of the z. Limits are compared with
    /// t Σ e, which saves the division. The span is widened by what summation rounds where Σ e is small
    /// compared with `error`.
    ///
    /// `is_part` tells whether a block has more triangles than a vector.
    #[inline(always)]
    unsafe fn hits(&self, [a, b, c]: [[S::F; 3]; 3], any_hit: bool, is_part: bool) -> HitMasks {
        let zero = S::splat(0.0);
        let HitInterval {
            nearest,
            farthest,
            begin,
            end,
            error: t_error,
        } = self.interval;
        let a = sheared::<S>(a, self.origin, self.shear);
        let b = sheared::<S>(b, self.origin, self.shear);
        let c = sheared::<S>(c, self.origin, self.shear);
        let u = cross::<S>(c, b);
        let v = cross::<S>(a, c);
        let w = cross::<S>(b, a);
        let size = S::max(S::max(size::<S>(a), size::<S>(b)), size::<S>(c));
        let error = S::mul(self.error, size);
        let smallest = S::min(S::min(u, v), w);
        let largest = S::max(S::max(u, v), w);
        let missed = S::and(S::lt(smallest, S::sub(zero, error)), S::lt(error, largest));
        let sum = S::add(S::add(u, v), w);
        let scale = S::abs(sum);
        // Half a block often has no candidate. For a whole block this branch would mispredict.
        if is_part && S::mask_bits(S::and_not(S::le(zero, scale), missed)) == 0 {
            return HitMasks::default();
        }
        let first = S::min(S::min(a[2], b[2]), c[2]);
        let last = S::max(S::max(a[2], b[2]), c[2]);
        let mean = S::mul_add(u, a[2], S::mul_add(v, b[2], S::mul(w, c[2])));
        let t = S::xor_sign(S::mul(mean, self.along), sum);
        let span = S::mul_add(S::sub(last, first), S::abs(self.along), t_error);
        let off = S::mul(S::mul(error, S::splat(4.0)), span);
        let early = S::sub(t, off);
        let late = S::add(t, off);
        let reached = S::and(
            S::le(S::mul(nearest, scale), late),
            S::le(early, S::mul(farthest, scale)),
        );
        let possible = S::and_not(reached, missed);
        let mut found = HitMasks {
            possible: S::mask_bits(possible),
            certain: 0,
        };
        if any_hit {
            let inside = S::or(S::lt(error, smallest), S::lt(largest, S::sub(zero, error)));
            let within = S::and(
                S::le(S::mul(begin, scale), early),
                S::le(late, S::mul(end, scale)),
            );
            found.certain = S::mask_bits(S::and(S::and(inside, within), possible));
        }
        found
    }
}

impl<const N: usize> Triangles<N> {
    /// Returns the vertices of the triangle in a place, with their coordinates along these axes.
    #[inline(always)]
    pub(crate) fn vertices(&self, place: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        three(|i| three(|k| self.vertices[i][axes[k]][place]))
    }
}

/// Shears points so that the ray is the third axis, which is not scaled.
#[inline(always)]
unsafe fn sheared<S: Simd>(point: [S::F; 3], origin: [S::F; 3], shear: [S::F; 2]) -> [S::F; 3] {
    let z = S::sub(point[2], origin[2]);
    let x = S::sub(point[0], origin[0]);
    let y = S::sub(point[1], origin[1]);
    [S::sub_mul(x, shear[0], z), S::sub_mul(y, shear[1], z), z]
}

/// Returns the cross product of the first two coordinates.
#[inline(always)]
unsafe fn cross<S: Simd>(p: [S::F; 3], q: [S::F; 3]) -> S::F {
    S::sub_mul(S::mul(p[0], q[1]), p[1], q[0])
}

/// Returns the larger absolute value of the first two coordinates.
#[inline(always)]
unsafe fn size<S: Simd>(p: [S::F; 3]) -> S::F {
    S::max_abs(p[0], p[1])
}
