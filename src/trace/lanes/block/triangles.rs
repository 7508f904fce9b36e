//! Triangles, by their vertices.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::{BLOCK, Block, MayHit, NONE, Numbers, Within, parts, splat3};
use crate::primitive::{Primitive, UnitFrame};
use crate::trace::lanes::packet::Packet;
use crate::trace::lanes::ray::LaneRays;
use crate::trace::lanes::simd::Simd;
use crate::trace::lanes::three;

/// Bound on the error of an edge function, for packed triangles and for the exact ones that these are
/// nearest to, as a multiple of `reach`. A sheared coordinate is off by 4 ε by its own arithmetic
/// ([`crate::primitive::PackedTriangle`]), and by less than that again through rounded origin, direction
/// and vertex; an edge function is off by four such errors times the triangle's size.
const EDGE_ERROR: f32 = 48.0 * f32::EPSILON;

/// Triangles by their vertices.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(in super::super) struct Triangles {
    /// By vertex, by axis.
    vertices: [[Numbers; 3]; 3],
    objects: [u32; BLOCK],
}

impl Default for Triangles {
    fn default() -> Self {
        Triangles {
            vertices: [[[f32::NAN; BLOCK]; 3]; 3],
            objects: [NONE; BLOCK],
        }
    }
}

impl Block for Triangles {
    fn set(&mut self, lane: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let Primitive::Triangle(triangle) = primitive else {
            unreachable!("all objects are triangles");
        };
        for (vertex, place) in triangle.vertices.iter().zip(&mut self.vertices) {
            let vertex = frame.point(*vertex).as_vec3();
            for k in 0..3 {
                place[k][lane] = vertex[k];
            }
        }
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
        let axes = ray.turned_axes();
        let along = *ray.inverse.get_unchecked(axes[2]);
        let turned = Turned::<S> {
            origin: splat3::<S>(three(|k| *ray.origin.get_unchecked(axes[k]))),
            shear: [S::splat(ray.shear[0]), S::splat(ray.shear[1])],
            along: S::splat(along),
            error: S::splat(EDGE_ERROR * ray.reach),
            within: Within::of_one(ray, limit),
        };
        parts!(S, self.objects, at => {
            let vertex = |i: usize| {
                let v = self.vertices.get_unchecked(i);
                three(|k| S::load(v.get_unchecked(axes[k]).as_ptr().add(at)))
            };
            turned.may_hit([vertex(0), vertex(1), vertex(2)], any)
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
    unsafe fn rays_that_may_hit<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        any: bool,
    ) -> MayHit {
        let axes = packet.bundle.axes;
        let load = |numbers: &[f32; BLOCK]| S::load(numbers.as_ptr());
        let along = load(packet.inverse.get_unchecked(axes[2]));
        let turned = Turned::<S> {
            origin: three(|k| load(packet.origin.get_unchecked(axes[k]))),
            shear: [0, 1].map(|k| S::mul(load(packet.direction.get_unchecked(axes[k])), along)),
            along,
            error: S::mul(load(&packet.reach), S::splat(EDGE_ERROR)),
            within: Within::of_each(packet, limits),
        };
        let vertex = |i: usize| {
            let v = self.vertices.get_unchecked(i);
            three(|k| S::splat(*v.get_unchecked(axes[k]).get_unchecked(place)))
        };
        turned.may_hit([vertex(0), vertex(1), vertex(2)], any)
    }
}

/// Rays as triangles are held against them, the axis of the largest component last.
struct Turned<S: Simd> {
    origin: [S::F; 3],
    shear: [S::F; 2],
    /// 1 over the last component.
    along: S::F,
    /// Of an edge function, for a triangle of size 1.
    error: S::F,
    within: Within<S>,
}

impl<S: Simd> Turned<S> {
    /// The edge functions of Woop, Benthin and Wald ("Watertight ray/triangle intersection", JCGT
    /// 2(1), 2013), which decide where they are off 0 by more than rounding; and the distance of the
    /// hit, their weighted mean of those of the vertices.
    ///
    /// With e and E the computed and the exact edge functions and z the distances of the vertices, that of
    /// the hit, t, is where Σ E (z − t) = 0. So Σ e z and t Σ e differ by Σ (e − E) (z − t), which is at
    /// most 3 `error` times the span of the z: limits are held against the mean times Σ e, without a
    /// division. The span is made wider by what adding up rounds where Σ e is small beside `error`.
    #[inline(always)]
    unsafe fn may_hit(&self, [a, b, c]: [[S::F; 3]; 3], any: bool) -> MayHit {
        let zero = S::splat(0.0);
        let Within {
            nearest,
            farthest,
            begin,
            end,
            error: rounded,
        } = self.within;
        let a = sheared::<S>(a, self.origin, self.shear);
        let b = sheared::<S>(b, self.origin, self.shear);
        let c = sheared::<S>(c, self.origin, self.shear);
        let u = cross::<S>(c, b);
        let v = cross::<S>(a, c);
        let w = cross::<S>(b, a);
        let size = S::max(S::max(size::<S>(a), size::<S>(b)), size::<S>(c));
        let error = S::mul(self.error, size);
        let least = S::min(S::min(u, v), w);
        let most = S::max(S::max(u, v), w);
        let missed = S::and(S::lt(least, S::sub(zero, error)), S::lt(error, most));
        let sum = S::add(S::add(u, v), w);
        let scale = S::abs(sum);
        // In half a block there is often none; whether there is in a whole one nothing predicts.
        if S::LANES < BLOCK && S::bits(S::and_not(S::le(zero, scale), missed)) == 0 {
            return MayHit::default();
        }
        let first = S::min(S::min(a[2], b[2]), c[2]);
        let last = S::max(S::max(a[2], b[2]), c[2]);
        let mean = S::mul_add(u, a[2], S::mul_add(v, b[2], S::mul(w, c[2])));
        let t = S::flip(S::mul(mean, self.along), sum);
        let span = S::mul_add(S::sub(last, first), S::abs(self.along), rounded);
        let off = S::mul(S::mul(error, S::splat(4.0)), span);
        let early = S::sub(t, off);
        let late = S::add(t, off);
        let reached = S::and(
            S::le(S::mul(nearest, scale), late),
            S::le(early, S::mul(farthest, scale)),
        );
        let maybe = S::and_not(reached, missed);
        let mut found = MayHit {
            maybe: S::bits(maybe),
            surely: 0,
        };
        if any {
            let inside = S::or(S::lt(error, least), S::lt(most, S::sub(zero, error)));
            let within = S::and(
                S::le(S::mul(begin, scale), early),
                S::le(late, S::mul(end, scale)),
            );
            found.surely = S::bits(S::and(S::and(inside, within), maybe));
        }
        found
    }
}

impl Triangles {
    /// A triangle's vertices, their coordinates along these axes.
    #[inline(always)]
    pub(in super::super) fn vertices(&self, place: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        three(|i| three(|k| self.vertices[i][axes[k]][place]))
    }
}

/// Points in coordinates in which the ray is the third axis, which stays unscaled.
#[inline(always)]
unsafe fn sheared<S: Simd>(point: [S::F; 3], origin: [S::F; 3], shear: [S::F; 2]) -> [S::F; 3] {
    let z = S::sub(point[2], origin[2]);
    let x = S::sub(point[0], origin[0]);
    let y = S::sub(point[1], origin[1]);
    [S::sub_mul(x, shear[0], z), S::sub_mul(y, shear[1], z), z]
}

/// The cross product of the first two coordinates.
#[inline(always)]
unsafe fn cross<S: Simd>(p: [S::F; 3], q: [S::F; 3]) -> S::F {
    S::sub_mul(S::mul(p[0], q[1]), p[1], q[0])
}

/// The larger of the first two coordinates.
#[inline(always)]
unsafe fn size<S: Simd>(p: [S::F; 3]) -> S::F {
    S::max_abs(p[0], p[1])
}
