//! Rays for tests of packed objects.

use super::UnitFrame;
use crate::geometry::{Axis, Ray, Vec3};
use glam::Vec3 as Point;

/// A ray in the coordinates of a [`UnitFrame`], rounded to `f32`.
#[derive(Debug)]
pub struct PackedRay {
    pub(crate) frame: UnitFrame,
    /// The rounded ray in `f64`.
    pub(crate) as_f64: Ray,
    pub(super) origin: Point,
    pub(super) direction: Point,
    /// 1 / direction².
    per_square: f32,
    /// The axis of the direction's largest component, and the other two components divided by it.
    axis: Axis,
    shear: [f32; 2],
    /// Bound on the difference between any coordinate of the scene and that of the origin.
    pub(super) reach: f32,
    /// Distance of this origin along the ray in the world.
    start: f64,
    /// Ratio of distances here to those in the world: a power of two.
    scale: f64,
}

/// A ray of the world in the coordinates of a [`UnitFrame`], rounded to `f32`: the input of all tests of
/// packed objects.
#[derive(Clone, Copy)]
pub(crate) struct FramedRay {
    pub(crate) origin: Point,
    /// Its largest component is from ½ to 2.
    pub(crate) direction: Point,
    pub(crate) t_min: f32,
    pub(crate) t_max: f32,
    /// Distance of this origin along the ray in the world.
    pub(crate) start: f64,
    /// Ratio of distances here to those in the world: a power of two.
    pub(crate) scale: f64,
}

impl FramedRay {
    /// An origin farther away than this is moved along the ray towards the scene, whose coordinates are at
    /// most ½. So rounding does not grow with the distance of the eye.
    pub(crate) const FAR: f64 = 2.0;

    /// Transforms a ray. `None` if it certainly misses the scene, has no direction, or one so short or long
    /// that distances to the scene are not finite.
    #[inline(always)]
    pub(crate) fn new(frame: &UnitFrame, ray: &Ray) -> Option<Self> {
        let (origin, direction) = (frame.point(ray.origin), ray.direction);
        let largest = |v: Vec3| v.x.abs().max(v.y.abs()).max(v.z.abs());
        if (0.5..2.0).contains(&largest(direction)) && largest(origin) <= Self::FAR {
            Some(Self::of(origin, direction, ray, 0.0, frame.scale()))
        } else {
            Self::uncommon(frame, ray)
        }
    }

    /// Transforms a ray whose direction is not about of unit length, or whose origin is far away. Not
    /// inlined, so that common rays stay in registers.
    #[cold]
    #[inline(never)]
    fn uncommon(frame: &UnitFrame, ray: &Ray) -> Option<Self> {
        let largest = ray.direction.abs().max_element();
        // The largest component becomes at least ½ and less than 2; every `t` is scaled inversely.
        let (mut direction, mut scale) = (ray.direction, frame.scale());
        if !(0.5..2.0).contains(&largest) {
            (direction, scale) = rescaled(direction, largest, scale)?;
        }
        let mut origin = frame.point(ray.origin);
        let mut start = 0.0;
        if origin.abs().max_element() > Self::FAR {
            let entry = entry(origin, direction)?;
            origin += entry * direction;
            start = entry / scale;
        }
        Some(Self::of(origin, direction, ray, start, scale))
    }

    #[inline(always)]
    fn of(origin: Vec3, direction: Vec3, ray: &Ray, start: f64, scale: f64) -> Self {
        FramedRay {
            origin: origin.as_vec3(),
            direction: direction.as_vec3(),
            t_min: ((ray.t_min - start) * scale).max(0.0) as f32,
            t_max: ((ray.t_max - start) * scale) as f32,
            start,
            scale,
        }
    }
}

/// Scales a direction to a largest component from 1 to 2. Returns it with the scale of distances.
fn rescaled(direction: Vec3, largest: f64, scale: f64) -> Option<(Vec3, f64)> {
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let shrink = libm::scalbn(1.0, -libm::ilogb(largest));
    let scale = scale / shrink;
    (scale > 0.0 && scale.is_finite()).then_some((direction * shrink, scale))
}

impl PackedRay {
    /// Transforms a ray. `None` if it certainly misses the scene, has no direction, or one so short or long
    /// that distances to the scene are not finite.
    #[inline(always)]
    pub fn new(frame: &UnitFrame, ray: &Ray) -> Option<Self> {
        let framed = FramedRay::new(frame, ray)?;
        let direction = framed.direction;
        let axis = Axis::of_largest(direction.abs().to_array());
        let rotated = rotated(direction, axis);
        Some(PackedRay {
            frame: *frame,
            origin: framed.origin,
            direction,
            per_square: 1.0 / direction.length_squared(),
            axis,
            shear: [rotated.x / rotated.z, rotated.y / rotated.z],
            reach: 0.5 + framed.origin.abs().max_element(),
            as_f64: Ray {
                origin: framed.origin.as_dvec3(),
                direction: direction.as_dvec3(),
                t_min: f64::from(framed.t_min),
                t_max: f64::from(framed.t_max),
            },
            start: framed.start,
            scale: framed.scale,
        })
    }

    /// Converts a distance along this ray to one along the ray in the world.
    #[inline(always)]
    pub fn to_world(&self, t: f64) -> f64 {
        self.start + t / self.scale
    }

    /// Returns the squared distance between a point of the scene and the ray's line. The distance has an
    /// error of less than 12 ε of three times `reach`: in each coordinate, u = ε/2 for the difference, 9 u
    /// for the position of the nearest point along the line, and 3 u for that point.
    #[inline(always)]
    pub(super) fn squared_distance(&self, point: Point) -> f32 {
        let to_point = point - self.origin;
        let along = to_point.dot(self.direction) * self.per_square;
        (to_point - along * self.direction).length_squared()
    }

    /// Returns a bound on the error of the square root of [`PackedRay::squared_distance`].
    #[inline(always)]
    pub(super) fn distance_error(&self) -> f32 {
        48.0 * f32::EPSILON * self.reach
    }

    /// Returns the first two coordinates of a point of the scene in coordinates where the ray is the third
    /// axis ([`super::numeric::Shear`]). Their error is less than 4 ε of `reach`: u for the difference, 4 u
    /// for the product and 2 u for the sum.
    #[inline(always)]
    pub(super) fn sheared(&self, point: Point) -> [f32; 2] {
        let v = rotated(point - self.origin, self.axis);
        [v.x - self.shear[0] * v.z, v.y - self.shear[1] * v.z]
    }
}

/// Rotates coordinates cyclically so that the one along `axis` is the last.
#[inline(always)]
fn rotated(v: Point, axis: Axis) -> Point {
    match axis {
        Axis::X => Point::new(v.y, v.z, v.x),
        Axis::Y => Point::new(v.z, v.x, v.y),
        Axis::Z => v,
    }
}

/// Returns where a ray enters the cube from −1 to 1; `None` for a miss.
fn entry(origin: Vec3, direction: Vec3) -> Option<f64> {
    let (mut enter, mut exit) = (0.0_f64, f64::INFINITY);
    for k in 0..3 {
        let (o, d) = (origin[k], direction[k]);
        let (a, b) = ((-1.0 - o) / d, (1.0 - o) / d);
        if a.is_nan() || b.is_nan() || d == 0.0 {
            if o.abs() > 1.0 {
                return None;
            }
        } else {
            enter = enter.max(a.min(b));
            exit = exit.min(a.max(b));
        }
    }
    (enter <= exit && enter.is_finite()).then_some(enter)
}
