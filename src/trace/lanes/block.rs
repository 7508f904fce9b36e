//! Blocks of objects that are held against a ray at once. What is decided here is only which of them
//! the ray may hit, whatever `f32` has rounded; those few are then tested one by one.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::ray::LaneRays;
use super::simd::Simd;
use super::three;
use crate::primitive::{PackedSphere, Primitive, Shape, UnitFrame};

/// Objects of a block.
pub(super) const BLOCK: usize = 16;

type Numbers = [f32; BLOCK];

/// No object.
pub(super) const NONE: u32 = u32::MAX;

pub(super) trait Block: Default + Send + Sync {
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
}

/// Objects of a block that a ray may hit, a bit for each.
#[derive(Clone, Copy, Default)]
pub(super) struct MayHit {
    pub(super) maybe: u32,
    /// Those of them that it certainly hits, up to its own end.
    pub(super) surely: u32,
}

/// Bounds on errors in `f32`, for packed objects and for the exact ones that these are nearest to, as
/// multiples of `reach`. A sheared coordinate is off by 4 ε by its own arithmetic ([`PackedTriangle`]),
/// and by less than that again through rounded origin, direction and vertex; an edge function is off
/// by four such errors times the triangle's size.
const EDGE_ERROR: f32 = 48.0 * f32::EPSILON;
/// Of the distance between a centre and the ray: twice that of [`PackedSphere`].
const OFFSET_ERROR: f32 = 96.0 * f32::EPSILON;
/// Of a distance along the ray.
const T_ERROR: f32 = 32.0 * f32::EPSILON;

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

/// Triangles by their vertices.
#[repr(C, align(64))]
pub(super) struct Triangles {
    /// By vertex, by axis.
    vertices: [[Numbers; 3]; 3],
    objects: [u32; BLOCK],
}

/// Spheres.
#[repr(C, align(64))]
pub(super) struct Spheres {
    center: [Numbers; 3],
    radius: Numbers,
    objects: [u32; BLOCK],
}

/// Objects of any kind by their bounds.
#[repr(C, align(64))]
pub(super) struct Boxes {
    /// Lower and upper corners by axis.
    corners: [[Numbers; 3]; 2],
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

impl Default for Spheres {
    fn default() -> Self {
        Spheres {
            center: [[f32::NAN; BLOCK]; 3],
            radius: [f32::NAN; BLOCK],
            objects: [NONE; BLOCK],
        }
    }
}

impl Default for Boxes {
    fn default() -> Self {
        Boxes {
            corners: [[[f32::NAN; BLOCK]; 3]; 2],
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

    /// The edge functions of Woop, Benthin and Wald ("Watertight ray/triangle intersection", JCGT
    /// 2(1), 2013), which decide where they are off 0 by more than rounding; and the distances of the
    /// vertices, between which that of a hit lies.
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
        let origin = splat3::<S>(three(|k| *ray.origin.get_unchecked(axes[k])));
        let [dx, dy, _] = three(|k| *ray.direction.get_unchecked(axes[k]));
        let along = *ray.inverse.get_unchecked(axes[2]);
        let shear = [S::splat(dx * along), S::splat(dy * along)];
        let along = S::splat(along);
        let reach = ray.reach;
        let error = S::splat(EDGE_ERROR * reach);
        let nearest = S::splat(ray.t_min - T_ERROR * reach);
        let farthest = S::splat(limit + T_ERROR * reach);
        let begin = S::splat(ray.t_min + T_ERROR * reach);
        let end = S::splat(ray.t_max - T_ERROR * reach);
        let zero = S::splat(0.0);
        parts!(S, self.objects, at => {
            let vertex = |i: usize| {
                let v = self.vertices.get_unchecked(i);
                three(|k| v.get_unchecked(axes[k]).as_ptr().add(at))
            };
            let a = sheared::<S>(vertex(0), origin, shear);
            let b = sheared::<S>(vertex(1), origin, shear);
            let c = sheared::<S>(vertex(2), origin, shear);
            let u = cross::<S>(c, b);
            let v = cross::<S>(a, c);
            let w = cross::<S>(b, a);
            let size = S::max(S::max(size::<S>(a), size::<S>(b)), size::<S>(c));
            let error = S::mul(error, size);
            let least = S::min(S::min(u, v), w);
            let most = S::max(S::max(u, v), w);
            let missed = S::and(S::lt(least, S::sub(zero, error)), S::lt(error, most));
            let (ta, tb, tc) = (S::mul(a[2], along), S::mul(b[2], along), S::mul(c[2], along));
            let first = S::min(S::min(ta, tb), tc);
            let last = S::max(S::max(ta, tb), tc);
            let reached = S::and(S::le(first, farthest), S::le(nearest, last));
            let maybe = S::and_not(reached, missed);
            // The distance is a mean of those of the vertices, weighted by the edge functions.
            // With D their sum: if they are off by `error` each, it is by 3 `error` / |D| times
            // the span of those distances, at most. Nothing predicts whether it is wanted: it is
            // computed without asking.
            let sum = S::add(S::add(u, v), w);
            let inverse = S::div(S::splat(1.0), sum);
            let t = S::mul(
                S::mul_add(u, ta, S::mul_add(v, tb, S::mul(w, tc))),
                inverse,
            );
            let off = S::mul(S::mul(error, S::splat(4.0)), S::abs(inverse));
            let clear = S::lt(off, S::splat(1.0));
            let off = S::mul(off, S::sub(last, first));
            let (early, late) = (S::sub(t, off), S::add(t, off));
            let out = S::or(S::lt(late, nearest), S::lt(farthest, early));
            let maybe = S::and_not(maybe, S::and(clear, out));
            let mut found = MayHit {
                maybe: S::bits(maybe),
                surely: 0,
            };
            if any {
                let inside = S::or(S::lt(error, least), S::lt(most, S::sub(zero, error)));
                let within = S::and(S::le(begin, early), S::le(late, end));
                found.surely = S::bits(S::and(S::and(inside, within), S::and(clear, maybe)));
            }
            found
        })
    }
}

impl Triangles {
    /// A triangle's vertices, their coordinates along these axes.
    #[inline(always)]
    pub(super) fn vertices(&self, place: usize, axes: [usize; 3]) -> [[f32; 3]; 3] {
        three(|i| three(|k| self.vertices[i][axes[k]][place]))
    }
}

impl Spheres {
    #[inline(always)]
    pub(super) fn sphere(&self, place: usize) -> PackedSphere {
        let center = three(|k| self.center[k][place]).into();
        PackedSphere::from_center(center, self.radius[place])
    }
}

/// Points in coordinates in which the ray is the third axis, which stays unscaled.
#[inline(always)]
unsafe fn sheared<S: Simd>(
    point: [*const f32; 3],
    origin: [S::F; 3],
    shear: [S::F; 2],
) -> [S::F; 3] {
    let z = S::sub(S::load(point[2]), origin[2]);
    let x = S::sub(S::load(point[0]), origin[0]);
    let y = S::sub(S::load(point[1]), origin[1]);
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

#[inline(always)]
unsafe fn dot<S: Simd>(p: [S::F; 3], q: [S::F; 3]) -> S::F {
    S::mul_add(p[0], q[0], S::mul_add(p[1], q[1], S::mul(p[2], q[2])))
}

#[inline(always)]
unsafe fn splat3<S: Simd>([x, y, z]: [f32; 3]) -> [S::F; 3] {
    [S::splat(x), S::splat(y), S::splat(z)]
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

    /// The distance between the centre and the ray's line.
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
        let origin = splat3::<S>(ray.origin);
        let direction = splat3::<S>(ray.direction);
        let per_square = S::splat(1.0 / squared);
        let reach = ray.reach;
        let error = S::splat(OFFSET_ERROR * reach);
        let nearest = S::splat(ray.t_min - T_ERROR * reach);
        let farthest = S::splat(limit + T_ERROR * reach);
        let begin = S::splat(ray.t_min + T_ERROR * reach);
        let end = S::splat(ray.t_max - T_ERROR * reach);
        let zero = S::splat(0.0);
        // Not below 1 over the length.
        let per_length = S::splat((1.0 + 4.0 * f32::EPSILON) / squared.sqrt());
        parts!(S, self.objects, at => {
            let [x, y, z] = three(|k| self.center[k].as_ptr().add(at));
            let to = [
                S::sub(S::load(x), origin[0]),
                S::sub(S::load(y), origin[1]),
                S::sub(S::load(z), origin[2]),
            ];
            let along = S::mul(dot::<S>(to, direction), per_square);
            let off = [
                S::sub_mul(to[0], along, direction[0]),
                S::sub_mul(to[1], along, direction[1]),
                S::sub_mul(to[2], along, direction[2]),
            ];
            let squared = dot::<S>(off, off);
            let radius = S::load(self.radius.as_ptr().add(at));
            let reach = S::add(radius, error);
            let met = S::le(squared, S::mul(reach, reach));
            let half = S::mul(reach, per_length);
            let first = S::sub(along, half);
            let reached = S::and(
                S::le(first, farthest),
                S::le(nearest, S::add(along, half)),
            );
            let maybe = S::and(met, reached);
            let mut found = MayHit { maybe: S::bits(maybe), surely: 0 };
            if any {
                // The ray enters between there and the point nearest to the centre.
                let inner = S::max(S::sub(radius, error), zero);
                let enters = S::lt(squared, S::mul(inner, inner));
                let within = S::and(S::le(begin, first), S::le(along, end));
                found.surely = S::bits(S::and(maybe, S::and(enters, within)));
            }
            found
        })
    }
}

impl Block for Boxes {
    fn set(&mut self, lane: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let bounds = primitive.bounds();
        for (corner, place) in [bounds.lo, bounds.hi].into_iter().zip(&mut self.corners) {
            let corner = frame.point(corner).as_vec3();
            for k in 0..3 {
                place[k][lane] = corner[k];
            }
        }
        self.objects[lane] = object;
    }

    fn objects(&self) -> &[u32; BLOCK] {
        &self.objects
    }

    /// Where the ray is within the box, faces as thick as the planes of the tree.
    #[inline(always)]
    unsafe fn candidates<S: Simd>(
        &self,
        rays: &LaneRays,
        ray: usize,
        limit: f32,
        _: bool,
    ) -> MayHit {
        let ray = rays.rays.get_unchecked(ray);
        let (reach, shifted) = (ray.reach, ray.shifted(rays.thick));
        let nearest = S::splat(ray.t_min - T_ERROR * reach);
        let farthest = S::splat(limit + T_ERROR * reach);
        parts!(S, self.objects, at => {
            let (mut enter, mut exit) = (nearest, farthest);
            for k in 0..3 {
                let inverse = ray.inverse[k];
                let backward = usize::from(inverse.is_sign_negative());
                let inverse = S::splat(inverse);
                let shifted = S::splat(shifted[k]);
                let width = S::mul(S::abs(inverse), S::splat(2.0 * rays.thick));
                let near = self.corners[backward][k].as_ptr().add(at);
                let far = self.corners[1 - backward][k].as_ptr().add(at);
                let begin = S::mul(S::sub(S::load(near), shifted), inverse);
                let end = S::mul(S::sub(S::load(far), shifted), inverse);
                enter = S::max(enter, begin);
                exit = S::min(exit, S::add(end, width));
            }
            MayHit { maybe: S::bits(S::le(enter, exit)), surely: 0 }
        })
    }
}
