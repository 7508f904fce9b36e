//! Blocks of objects that are held against a ray at once. What is decided here is only which of them
//! the ray may hit, whatever `f32` has rounded; those few are then tested one by one.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::packet::{Bundle, Packet};
use super::ray::{LaneRay, LaneRays};
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

    /// Objects that may be in the way of some ray of a bundle, a bit for each place.
    ///
    /// # Safety
    /// As [`Simd`].
    unsafe fn near<S: Simd>(&self, bundle: &Bundle) -> u32;

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
unsafe fn in_the_way<S: Simd>(low: [S::F; 3], high: [S::F; 3], bundle: &Bundle) -> S::M {
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
/// triangle, see [`EDGE_ERROR`].
pub(super) const SHEARED_ERROR: f32 = 16.0 * f32::EPSILON;

/// Objects of a block that a ray may hit, or rays of a packet that may hit an object, a bit for each.
#[derive(Clone, Copy, Default)]
pub(super) struct MayHit {
    pub(super) maybe: u32,
    /// Those of them that certainly hit or are hit, up to the ray's own end.
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
        let [dx, dy, _] = three(|k| *ray.direction.get_unchecked(axes[k]));
        let turned = Turned::<S> {
            origin: splat3::<S>(three(|k| *ray.origin.get_unchecked(axes[k]))),
            shear: [S::splat(dx * along), S::splat(dy * along)],
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
    unsafe fn near<S: Simd>(&self, bundle: &Bundle) -> u32 {
        let axes = bundle.axes;
        let found = parts!(S, self.objects, at => {
            let (mut low, mut high) = ([S::splat(0.0); 3], [S::splat(0.0); 3]);
            for k in 0..3 {
                let axis = axes[k];
                let a = S::load(self.vertices[0].get_unchecked(axis).as_ptr().add(at));
                let b = S::load(self.vertices[1].get_unchecked(axis).as_ptr().add(at));
                let c = S::load(self.vertices[2].get_unchecked(axis).as_ptr().add(at));
                low[k] = S::min(S::min(a, b), c);
                high[k] = S::max(S::max(a, b), c);
            }
            MayHit { maybe: S::bits(in_the_way::<S>(low, high, bundle)), surely: 0 }
        });
        found.maybe
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

/// Where on a ray in `f32` a hit must lie to count, and where to count whatever was rounded.
#[derive(Clone, Copy)]
struct Within<S: Simd> {
    nearest: S::F,
    farthest: S::F,
    begin: S::F,
    end: S::F,
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
        }
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
    /// 2(1), 2013), which decide where they are off 0 by more than rounding; and the distances of the
    /// vertices, between which that of a hit lies.
    #[inline(always)]
    unsafe fn may_hit(&self, [a, b, c]: [[S::F; 3]; 3], any: bool) -> MayHit {
        let zero = S::splat(0.0);
        let Within {
            nearest,
            farthest,
            begin,
            end,
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
        let along = self.along;
        let (ta, tb, tc) = (
            S::mul(a[2], along),
            S::mul(b[2], along),
            S::mul(c[2], along),
        );
        let first = S::min(S::min(ta, tb), tc);
        let last = S::max(S::max(ta, tb), tc);
        let reached = S::and(S::le(first, farthest), S::le(nearest, last));
        let maybe = S::and_not(reached, missed);
        // The distance is a mean of those of the vertices, weighted by the edge functions. With D
        // their sum: if they are off by `error` each, it is by 3 `error` / |D| times the span of
        // those distances, at most. Nothing predicts whether it is wanted: it is computed without
        // asking.
        let sum = S::add(S::add(u, v), w);
        let inverse = S::div(S::splat(1.0), sum);
        let t = S::mul(S::mul_add(u, ta, S::mul_add(v, tb, S::mul(w, tc))), inverse);
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
    unsafe fn near<S: Simd>(&self, bundle: &Bundle) -> u32 {
        let axes = bundle.axes;
        let found = parts!(S, self.objects, at => {
            let radius = S::load(self.radius.as_ptr().add(at));
            let (mut low, mut high) = ([radius; 3], [radius; 3]);
            for k in 0..3 {
                let center = S::load(self.center.get_unchecked(axes[k]).as_ptr().add(at));
                low[k] = S::sub(center, radius);
                high[k] = S::add(center, radius);
            }
            MayHit { maybe: S::bits(in_the_way::<S>(low, high, bundle)), surely: 0 }
        });
        found.maybe
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

    #[inline(always)]
    unsafe fn near<S: Simd>(&self, bundle: &Bundle) -> u32 {
        let axes = bundle.axes;
        let found = parts!(S, self.objects, at => {
            let (mut low, mut high) = ([S::splat(0.0); 3], [S::splat(0.0); 3]);
            for k in 0..3 {
                low[k] = S::load(self.corners[0].get_unchecked(axes[k]).as_ptr().add(at));
                high[k] = S::load(self.corners[1].get_unchecked(axes[k]).as_ptr().add(at));
            }
            MayHit { maybe: S::bits(in_the_way::<S>(low, high, bundle)), surely: 0 }
        });
        found.maybe
    }

    #[inline(always)]
    unsafe fn rays_that_may_hit<S: Simd>(
        &self,
        place: usize,
        packet: &Packet,
        limits: S::F,
        _: bool,
    ) -> MayHit {
        let load = |numbers: &[f32; BLOCK]| S::load(numbers.as_ptr());
        let Within {
            nearest, farthest, ..
        } = Within::<S>::of_each(packet, limits);
        let (mut enter, mut exit) = (nearest, farthest);
        for k in 0..3 {
            let inverse = load(&packet.inverse[k]);
            let shifted = load(&packet.shifted[k]);
            let width = S::mul(S::abs(inverse), S::splat(2.0 * packet.thick));
            let [low, high] = [0, 1].map(|end| {
                let corner = S::splat(*self.corners[end][k].get_unchecked(place));
                S::mul(S::sub(corner, shifted), inverse)
            });
            enter = S::max(enter, S::min(low, high));
            exit = S::min(exit, S::add(S::max(low, high), width));
        }
        MayHit {
            maybe: S::bits(S::le(enter, exit)),
            surely: 0,
        }
    }
}
