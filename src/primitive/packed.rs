//! Objects packed as `f32` in the coordinates of a [`UnitFrame`].
//!
//! Objects, rays and distances are rounded to `f32`. A test is an arithmetic filter (Shewchuk, "Adaptive
//! precision floating-point arithmetic and fast robust geometric predicates", Discrete & Computational
//! Geometry 18, 1997). It is decided in `f32` if the bound on rounding allows, which holds for nearly all
//! misses. Otherwise it is decided in `f64`, where the product of two `f32` is exact.
//!
//! So a hit is exact for the rounded object and ray. It lies within 4 ε (1 + o) of the exact surface, where
//! ε = 2⁻²³ and o is the largest coordinate of the ray's origin, in lengths of the frame. The parts are
//! √3 ε/2 of each coordinate of object and origin; √3 ε of the distance, which is at most √3 (o + ½),
//! for the direction and for the distance itself; and 2 ε for the derived numbers of a cone. The bound
//! holds at every angle because no sum is a difference of nearly equal rounded numbers. Traversal relies
//! on it.

use super::numeric::Shear;
use super::{
    Cone, PackedRay, Polygon, Primitive, Shape, Sphere, Triangle, UnitFrame, cone, triangle,
};
use crate::geometry::{Ray, Vec3};
use glam::Vec3 as Point;
use std::hint::select_unpredictable;

/// An object in the form that intersection uses: itself or packed.
pub trait Form: Sized + Send + Sync {
    type Of;
    /// The ray that it is tested with.
    type Ray;

    /// Converts an object.
    fn of(shape: &Self::Of, frame: &UnitFrame) -> Self;

    /// As [`Shape::intersect`]. For packed objects, `t_max` and the result are representable as `f32`.
    fn intersect(&self, ray: &Self::Ray, t_max: f64) -> Option<f64>;

    /// Runs the exact test: [`Form::intersect`] without the filter. For packed objects, the ray is that of a
    /// [`PackedRay`] in `f64`.
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64>;

    /// Returns the maximum distance, in lengths of the frame, between the form and the object, and between
    /// a point of it and the same point as `f32`; 0 where nothing is rounded.
    fn rounding(&self) -> f64;

    /// Returns its memory in bytes, including what it points to.
    fn bytes(&self) -> usize;
}

impl<S: Shape + Clone> Form for S {
    type Of = S;
    type Ray = Ray;

    fn of(shape: &S, _: &UnitFrame) -> S {
        shape.clone()
    }

    #[inline(always)]
    fn intersect(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        Shape::intersect(self, ray, t_max)
    }

    #[inline(always)]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        Shape::intersect(self, ray, t_max)
    }

    fn rounding(&self) -> f64 {
        0.0
    }

    fn bytes(&self) -> usize {
        Shape::bytes(self)
    }
}

/// Bound on the ratio between a distance that rounds to `t_max` and `t_max`.
const UP: f64 = 1.0 + f32::EPSILON as f64;

/// Rounds a distance of at most `t_max` · [`UP`]. Those that round to `t_max` count as `t_max`, so that the
/// winner of a tie does not depend on the order of the tests.
#[inline(always)]
fn rounded(t: f64, t_max: f64) -> Option<f64> {
    let t = f64::from(t as f32);
    (t <= t_max).then_some(t)
}

/// Returns [`Form::rounding`] for coordinates of at most `reach`.
fn rounding_within(reach: f32) -> f64 {
    4.0 * f64::from(f32::EPSILON * reach)
}

/// A packed sphere: 16 bytes.
pub struct PackedSphere {
    center: Point,
    radius: f32,
}

impl PackedSphere {
    #[inline(always)]
    pub(crate) fn from_center(center: Point, radius: f32) -> Self {
        PackedSphere { center, radius }
    }

    /// Returns whether the ray's line certainly misses it, decided in `f32`.
    #[inline(always)]
    fn is_missed_by(&self, ray: &PackedRay) -> bool {
        let reach = self.radius + ray.distance_error();
        ray.squared_distance(self.center) > reach * reach
    }
}

impl Form for PackedSphere {
    type Of = Sphere;
    type Ray = PackedRay;

    fn of(sphere: &Sphere, frame: &UnitFrame) -> Self {
        PackedSphere {
            center: frame.point(sphere.center).as_vec3(),
            radius: (sphere.radius * frame.scale()) as f32,
        }
    }

    #[inline(always)]
    fn intersect(&self, ray: &PackedRay, t_max: f64) -> Option<f64> {
        if self.is_missed_by(ray) {
            return None;
        }
        self.intersect_exact(&ray.as_f64, t_max)
    }

    #[inline(always)]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let sphere = Sphere {
            center: self.center.as_dvec3(),
            radius: f64::from(self.radius),
        };
        rounded(Shape::intersect(&sphere, ray, t_max * UP)?, t_max)
    }

    fn rounding(&self) -> f64 {
        rounding_within(self.center.abs().max_element() + self.radius)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// A packed triangle: 36 bytes. Normals for shading are in the scene.
pub struct PackedTriangle {
    vertices: [Point; 3],
}

impl PackedTriangle {
    /// Returns where a ray from `origin` hits a triangle with these vertices; NaN for a miss. Coordinates are
    /// in cyclic order with the axis of the direction's largest component last. Followed by
    /// [`PackedTriangle::round_hit`] this is [`Form::intersect_exact`].
    #[inline(always)]
    pub(crate) fn crossing_rotated(
        vertices: [Vec3; 3],
        origin: Vec3,
        direction: Vec3,
        t_min: f64,
    ) -> f64 {
        let [a, b, c] = vertices;
        let shear = Shear::of_rotated(direction);
        triangle::crossing_or_nan([a - origin, b - origin, c - origin], &shear, t_min)
    }

    /// Rounds a distance of [`PackedTriangle::crossing_rotated`]; NaN if the result is above `t_max`.
    /// Branchless.
    #[inline(always)]
    pub(crate) fn round_hit(crossing: f64, t_max: f64) -> f64 {
        let t = f64::from(crossing as f32);
        let within = (t <= t_max) & (crossing <= t_max * UP);
        select_unpredictable(within, t, f64::NAN)
    }

    /// Returns whether the ray's line certainly misses it, decided in `f32`.
    #[inline(always)]
    fn is_missed_by(&self, ray: &PackedRay) -> bool {
        let [a, b, c] = self.vertices.map(|v| ray.sheared(v));
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let size = [a, b, c]
            .iter()
            .fold(0.0_f32, |m, p| m.max(p[0].abs()).max(p[1].abs()));
        // Errors of four coordinates, 4 ε of `reach` each, where `size` is at most twice `reach`; and 2 ε of
        // the products.
        let error = 24.0 * f32::EPSILON * ray.reach * size;
        u.min(v).min(w) < -error && u.max(v).max(w) > error
    }
}

impl Form for PackedTriangle {
    type Of = Triangle;
    type Ray = PackedRay;

    fn of(triangle: &Triangle, frame: &UnitFrame) -> Self {
        PackedTriangle {
            vertices: triangle.vertices.map(|v| frame.point(v).as_vec3()),
        }
    }

    #[inline(always)]
    fn intersect(&self, ray: &PackedRay, t_max: f64) -> Option<f64> {
        if self.is_missed_by(ray) {
            return None;
        }
        self.intersect_exact(&ray.as_f64, t_max)
    }

    #[inline(always)]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let triangle = Triangle {
            vertices: self.vertices.map(|v| v.as_dvec3()),
            normals: None,
        };
        rounded(Shape::intersect(&triangle, ray, t_max * UP)?, t_max)
    }

    fn rounding(&self) -> f64 {
        rounding_within(reach(&self.vertices))
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

fn reach(points: &[Point]) -> f32 {
    points
        .iter()
        .fold(0.0, |reach, p| p.abs().max_element().max(reach))
}

/// A packed polygon: the vertices of its outline, which rounding moves off their common plane.
pub struct PackedPolygon {
    vertices: Box<[Point]>,
}

impl PackedPolygon {
    /// Returns whether the ray's line certainly misses it, decided in `f32`.
    #[inline(always)]
    fn is_missed_by(&self, ray: &PackedRay) -> bool {
        let (mut lo, mut hi) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
        for &vertex in &self.vertices {
            let p = ray.sheared(vertex);
            for k in 0..2 {
                lo[k] = lo[k].min(p[k]);
                hi[k] = hi[k].max(p[k]);
            }
        }
        let error = 4.0 * f32::EPSILON * ray.reach;
        lo[0] > error || lo[1] > error || hi[0] < -error || hi[1] < -error
    }
}

impl Form for PackedPolygon {
    type Of = Polygon;
    type Ray = PackedRay;

    fn of(polygon: &Polygon, frame: &UnitFrame) -> Self {
        PackedPolygon {
            vertices: polygon
                .vertices_in_plane()
                .map(|v| frame.point(v).as_vec3())
                .collect(),
        }
    }

    #[inline(always)]
    fn intersect(&self, ray: &PackedRay, t_max: f64) -> Option<f64> {
        if self.is_missed_by(ray) {
            return None;
        }
        self.intersect_exact(&ray.as_f64, t_max)
    }

    #[inline(always)]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let t = self.crossing(ray).filter(|&t| ray.t_min <= t)?;
        rounded(t, t_max)
    }

    fn rounding(&self) -> f64 {
        rounding_within(reach(&self.vertices))
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.vertices)
    }
}

impl PackedPolygon {
    /// Returns where the ray's line crosses the polygon, by the even–odd rule. The outline is inside.
    ///
    /// In coordinates where the ray is the third axis, the chord of the outline along the first axis
    /// through the origin ends on two edges. `t` at the origin is interpolated between the ends of the
    /// chord, and there between the vertices of the edges. So the hit stays on the polygon however small
    /// the angle. Adjacent polygons decide an edge from the same numbers. A ray within rounding of the
    /// plane has no hit, as with triangles.
    ///
    /// ```text
    /// a = last vertex, sheared
    /// for each vertex b, sheared:
    ///     the edge a–b contains the origin: remember its t there
    ///     else if it crosses the first axis at x:
    ///         x > 0: toggle inside; remember the edge if it is the nearest to the right
    ///         x < 0: remember the edge if it is the nearest to the left
    ///     a = b
    /// no hit if the area is within rounding of 0
    /// hit on an edge, or if inside: interpolate between the left and the right edge
    /// ```
    fn crossing(&self, ray: &Ray) -> Option<f64> {
        let shear = Shear::of(ray.direction)?;
        let (mut distance, mut perimeter, mut area) = (0.0_f64, 0.0, 0.0);
        let mut apply = |vertex: &Point| {
            let from_origin = vertex.as_dvec3() - ray.origin;
            distance = distance.max(from_origin.abs().max_element());
            shear.apply(from_origin)
        };
        let mut a = apply(self.vertices.last()?);
        // Where the nearest edges on both sides of the origin cross the axis, and their vertices.
        let (mut left, mut right) = ((f64::NEG_INFINITY, a, a), (f64::INFINITY, a, a));
        let (mut inside, mut on_edge) = (false, None);
        for vertex in &self.vertices {
            let b = apply(vertex);
            // Reversing the edge only changes the sign.
            let cross = a.x * b.y - a.y * b.x;
            area += cross;
            perimeter += (b.x - a.x).abs() + (b.y - a.y).abs();
            if cross == 0.0 && a.x.min(b.x) <= 0.0 && a.x.max(b.x) >= 0.0 {
                on_edge = on_edge.or(t_of_origin(a, b));
            } else if (a.y > 0.0) != (b.y > 0.0) {
                let x = cross / (b.y - a.y);
                if x > 0.0 {
                    inside = !inside;
                    right = if x < right.0 { (x, a, b) } else { right };
                } else {
                    left = if x > left.0 { (x, a, b) } else { left };
                }
            }
            a = b;
        }
        if area.abs() <= 16.0 * f64::EPSILON * distance * perimeter {
            return None;
        }
        let chord = || {
            let t_on = |a: Vec3, b: Vec3| (a.z * b.y - a.y * b.z) / (b.y - a.y);
            let (t_left, t_right) = (t_on(left.1, left.2), t_on(right.1, right.2));
            let t = (t_right * -left.0 + t_left * right.0) / (right.0 - left.0);
            t.is_finite().then_some(t)
        };
        on_edge.or_else(|| if inside { chord() } else { None })
    }
}

/// Returns the third coordinate of a segment where its first two are 0; `None` beyond its ends. The
/// origin must lie on the line of the segment in the first two coordinates.
fn t_of_origin(a: Vec3, b: Vec3) -> Option<f64> {
    if a.y.min(b.y) > 0.0 || a.y.max(b.y) < 0.0 {
        return None;
    }
    let (x, y) = (b.x - a.x, b.y - a.y);
    Some(if x == 0.0 && y == 0.0 {
        a.z
    } else if x.abs() > y.abs() {
        (a.z * b.x - a.x * b.z) / x
    } else {
        (a.z * b.y - a.y * b.z) / y
    })
}

/// A packed cylinder or cone: 40 bytes.
pub struct PackedCone {
    axis: Point,
    middle: Point,
    half_length: f32,
    middle_radius: f32,
    slope: f32,
    squared_reach: f32,
}

impl PackedCone {
    /// Converts the numbers to `f64`.
    #[inline(always)]
    fn side(&self) -> cone::Side {
        cone::Side {
            axis: self.axis.as_dvec3(),
            middle: self.middle.as_dvec3(),
            half_length: f64::from(self.half_length),
            middle_radius: f64::from(self.middle_radius),
            slope: f64::from(self.slope),
            squared_reach: f64::from(self.squared_reach),
        }
    }

    /// Returns whether the ray's line certainly misses it, decided in `f32`.
    #[inline(always)]
    fn is_missed_by(&self, ray: &PackedRay) -> bool {
        let radius = self.middle_radius + self.slope.abs() * self.half_length;
        // The distance between the ray's line and the axis, times the length of their cross product. Its
        // error is 6 ε of the size of each factor, and 8 ε of the sum.
        let normal = ray.direction.cross(self.axis);
        let speed = ray.direction.abs().max_element();
        let error = 64.0 * f32::EPSILON * ray.reach * speed;
        let apart = (ray.origin - self.middle).dot(normal).abs() - error;
        let around = radius * (1.0 + 8.0 * f32::EPSILON);
        if apart > 0.0 && apart * apart > around * around * normal.length_squared() {
            return true;
        }
        // The bounding sphere.
        let error = ray.distance_error();
        let more = error * (2.0 * (self.half_length + radius) + error);
        ray.squared_distance(self.middle) > self.squared_reach + more
    }
}

impl Form for PackedCone {
    type Of = Cone;
    type Ray = PackedRay;

    fn of(cone: &Cone, frame: &UnitFrame) -> Self {
        let side = cone.side();
        let scale = frame.scale();
        PackedCone {
            axis: side.axis.as_vec3(),
            middle: frame.point(side.middle).as_vec3(),
            half_length: (side.half_length * scale) as f32,
            middle_radius: (side.middle_radius * scale) as f32,
            slope: side.slope as f32,
            // Used to rule out hits, so it is rounded up.
            squared_reach: (side.squared_reach * scale * scale) as f32 * (1.0 + 8.0 * f32::EPSILON)
                + f32::EPSILON * f32::EPSILON,
        }
    }

    #[inline(always)]
    fn intersect(&self, ray: &PackedRay, t_max: f64) -> Option<f64> {
        if self.is_missed_by(ray) {
            return None;
        }
        self.intersect_exact(&ray.as_f64, t_max)
    }

    #[inline(always)]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        let side = self.side();
        rounded(side.intersect(ray, t_max * UP)?, t_max)
    }

    fn rounding(&self) -> f64 {
        let radius = self.middle_radius + self.slope.abs() * self.half_length;
        rounding_within(self.middle.abs().max_element() + self.half_length + radius)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// A packed object of any kind.
pub enum PackedPrimitive {
    Sphere(PackedSphere),
    Triangle(PackedTriangle),
    Polygon(PackedPolygon),
    Cone(PackedCone),
}

macro_rules! each_kind {
    ($self:ident, $form:ident => $answer:expr) => {
        match $self {
            PackedPrimitive::Sphere($form) => $answer,
            PackedPrimitive::Triangle($form) => $answer,
            PackedPrimitive::Polygon($form) => $answer,
            PackedPrimitive::Cone($form) => $answer,
        }
    };
}

impl Form for PackedPrimitive {
    type Of = Primitive;
    type Ray = PackedRay;

    fn of(primitive: &Primitive, frame: &UnitFrame) -> Self {
        match primitive {
            Primitive::Sphere(s) => PackedPrimitive::Sphere(Form::of(s, frame)),
            Primitive::Triangle(t) => PackedPrimitive::Triangle(Form::of(t, frame)),
            Primitive::Polygon(p) => PackedPrimitive::Polygon(Form::of(p, frame)),
            Primitive::Cone(c) => PackedPrimitive::Cone(Form::of(c, frame)),
        }
    }

    #[inline]
    fn intersect(&self, ray: &PackedRay, t_max: f64) -> Option<f64> {
        each_kind!(self, form => form.intersect(ray, t_max))
    }

    #[inline]
    fn intersect_exact(&self, ray: &Ray, t_max: f64) -> Option<f64> {
        each_kind!(self, form => form.intersect_exact(ray, t_max))
    }

    fn rounding(&self) -> f64 {
        each_kind!(self, form => form.rounding())
    }

    fn bytes(&self) -> usize {
        let inside = each_kind!(self, form => form.bytes() - size_of_val(form));
        size_of::<Self>() + inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;

    /// Numbers from −½ to ½, the same everywhere.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 1u64;
        move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        }
    }

    /// Traces rays within a few roundings of the outline of their target: where `f64` finds a hit, `f32`
    /// must not have ruled it out.
    #[test]
    fn what_is_ruled_out_is_missed() {
        let frame = UnitFrame::around(&Aabb::new(Vec3::splat(-0.5), Vec3::splat(0.5)));
        let mut number = numbers();
        let mut vector = || Vec3::new(number(), number(), number());
        let (mut hits, mut misses) = ([0; 4], [0; 4]);
        for i in 0..100_000 {
            let [a, b, c] = [vector(), vector(), vector()];
            let (size, origin) = (10f64.powf(6.0 * vector().x - 3.0), 4.0 * vector());
            let (Ok(sphere), Ok(triangle), Ok(polygon), Ok(cone)) = (
                Sphere::new(a, 0.25 * size.min(1.0)),
                Triangle::new([a, b, c], None),
                Polygon::new(vec![a, b, c], None),
                Cone::new(a, 0.1 * size.min(1.0), b, 0.05 * size.min(1.0)),
            ) else {
                continue;
            };
            let off = 10f64.powf(-4.0 - 6.0 * vector().x) * vector();
            let across = (origin - a).any_orthonormal_vector();
            let normal = (a - origin).cross(b - a).normalize();
            let targets = [
                a + sphere.radius * across,
                a + (i % 7) as f64 / 6.0 * (b - a),
                b + (i % 5) as f64 / 4.0 * (c - b),
                0.5 * (a + b) + 0.5 * (cone.base_radius() + cone.apex_radius()) * normal,
            ];
            for (k, target) in targets.into_iter().enumerate() {
                let ray = Ray::new(origin, (target + off - origin).normalize());
                let Some(ray) = PackedRay::new(&frame, &ray) else {
                    continue;
                };
                let wide = &ray.as_f64;
                let far = f64::INFINITY;
                let (hit, missed) = match k {
                    0 => {
                        let packed = PackedSphere::of(&sphere, &frame);
                        let exact = Sphere {
                            center: packed.center.as_dvec3(),
                            radius: packed.radius.into(),
                        };
                        let hit = Shape::intersect(&exact, wide, far);
                        (hit.is_some(), packed.is_missed_by(&ray))
                    }
                    1 => {
                        let packed = PackedTriangle::of(&triangle, &frame);
                        let exact = Triangle {
                            vertices: packed.vertices.map(|v| v.as_dvec3()),
                            normals: None,
                        };
                        let hit = Shape::intersect(&exact, wide, far);
                        (hit.is_some(), packed.is_missed_by(&ray))
                    }
                    2 => {
                        let packed = PackedPolygon::of(&polygon, &frame);
                        (packed.crossing(wide).is_some(), packed.is_missed_by(&ray))
                    }
                    _ => {
                        let packed = PackedCone::of(&cone, &frame);
                        let hit = packed.side().intersect(wide, far);
                        (hit.is_some(), packed.is_missed_by(&ray))
                    }
                };
                assert!(!(hit && missed), "kind {k}, {ray:?}");
                hits[k] += usize::from(hit);
                misses[k] += usize::from(missed);
            }
        }
        assert!(
            hits.iter().chain(&misses).all(|&n| n > 1000),
            "{hits:?} {misses:?}"
        );
    }
}
