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

use super::estimate::{self, Estimate};
use super::exact::{ConeEnds, Known, Root, Surface};
use super::{
    Cone, PackedRay, Polygon, Precision, Primitive, Shape, Sphere, Triangle, UnitFrame, cone,
};
use crate::geometry::{Ray, Vec3};
use glam::Vec3 as Point;

/// An object in the form that intersection uses: itself or packed.
pub trait Form: Sized + PartialEq + Send + Sync {
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

    /// As [`Shape::is_hit`].
    fn is_hit(&self, ray: &Self::Ray) -> bool {
        let t_max = Self::exact_ray(ray).t_max;
        self.intersect(ray, t_max).is_some()
    }

    /// [`Form::is_hit`] without the filter.
    fn is_hit_exact(&self, ray: &Ray) -> bool {
        self.intersect_exact(ray, ray.t_max).is_some()
    }

    /// Returns the exact distance of [`Form::intersect_exact`], as a number that is not rounded. The ray must hit
    /// the object.
    fn exact_distance(&self, ray: &Ray) -> Option<Root>;

    /// Returns the ray of the exact test.
    fn exact_ray(ray: &Self::Ray) -> &Ray;

    /// Returns the maximum distance, in lengths of the frame, between the form and the object, and between
    /// a point of it and the same point as `f32`; 0 where nothing is rounded.
    fn rounding(&self) -> f64;

    /// Returns its memory in bytes, including what it points to.
    fn bytes(&self) -> usize;
}

impl<S: Shape + Clone + PartialEq> Form for S {
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

    #[inline(always)]
    fn is_hit(&self, ray: &Ray) -> bool {
        Shape::is_hit(self, ray)
    }

    #[inline(always)]
    fn is_hit_exact(&self, ray: &Ray) -> bool {
        Shape::is_hit(self, ray)
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Shape::exact_distance(self, ray)
    }

    fn exact_ray(ray: &Ray) -> &Ray {
        ray
    }

    fn rounding(&self) -> f64 {
        0.0
    }

    fn bytes(&self) -> usize {
        Shape::bytes(self)
    }
}

/// Returns [`Form::rounding`] for coordinates of at most `reach`.
fn rounding_within(reach: f32) -> f64 {
    4.0 * f64::from(f32::EPSILON * reach)
}

/// A packed sphere: 16 bytes.
#[derive(PartialEq)]
pub struct PackedSphere {
    center: Point,
    radius: f32,
}

impl PackedSphere {
    #[inline(always)]
    pub(crate) fn from_center(center: Point, radius: f32) -> Self {
        PackedSphere { center, radius }
    }

    fn surface(&self) -> Surface<'static> {
        Surface::Sphere {
            center: self.center.as_dvec3(),
            radius: f64::from(self.radius),
        }
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
        let crossings = estimate::sphere(self.center.as_dvec3(), f64::from(self.radius), ray);
        Estimate::settle(crossings, [ray.t_min, ray.t_max], t_max, |known| {
            self.surface().intersect(known, ray, Precision::F32)
        })
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        self.surface().exact_distance(ray)
    }

    fn exact_ray(ray: &PackedRay) -> &Ray {
        &ray.as_f64
    }

    fn rounding(&self) -> f64 {
        rounding_within(self.center.abs().max_element() + self.radius)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// A packed triangle: 36 bytes. Normals for shading are in the scene.
#[derive(PartialEq)]
pub struct PackedTriangle {
    vertices: [Point; 3],
}

impl PackedTriangle {
    /// [`Form::intersect_exact`] without a limit and without an estimate; `known` as there.
    pub(crate) fn intersect_slowly(&self, known: Known, ray: &Ray) -> Option<f64> {
        Surface::Triangle(&self.wide_vertices()).intersect(known, ray, Precision::F32)
    }

    #[inline(always)]
    fn wide_vertices(&self) -> [Vec3; 3] {
        self.vertices.map(|v| v.as_dvec3())
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
        let estimate = estimate::triangle_at(&self.wide_vertices(), ray);
        Estimate::settle([estimate], [ray.t_min, ray.t_max], t_max, |known| {
            self.intersect_slowly(known, ray)
        })
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Triangle(&self.wide_vertices()).exact_distance(ray)
    }

    fn exact_ray(ray: &PackedRay) -> &Ray {
        &ray.as_f64
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
#[derive(PartialEq)]
pub struct PackedPolygon {
    vertices: Box<[Point]>,
}

impl PackedPolygon {
    fn wide_vertices(&self) -> Vec<Vec3> {
        self.vertices.iter().map(|v| v.as_dvec3()).collect()
    }

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
                .iter()
                .map(|&v| frame.point(v).as_vec3())
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
        let estimate = estimate::outline(self.vertices.iter().map(|v| v.as_dvec3()), ray);
        Estimate::settle([estimate], [ray.t_min, ray.t_max], t_max, |known| {
            Surface::Outline(&self.wide_vertices()).intersect(known, ray, Precision::F32)
        })
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Outline(&self.wide_vertices()).exact_distance(ray)
    }

    fn exact_ray(ray: &PackedRay) -> &Ray {
        &ray.as_f64
    }

    fn rounding(&self) -> f64 {
        rounding_within(reach(&self.vertices))
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + size_of_val(&*self.vertices)
    }
}

/// A packed cylinder or cone: 36 bytes.
#[derive(PartialEq)]
pub struct PackedCone {
    base: Point,
    base_radius: f32,
    apex: Point,
    apex_radius: f32,
    /// The largest distance from the middle of the axis, rounded up.
    reach: f32,
}

impl PackedCone {
    /// Converts the numbers to `f64`.
    #[inline(always)]
    fn ends(&self) -> ConeEnds {
        ConeEnds {
            base: self.base.as_dvec3(),
            base_radius: f64::from(self.base_radius),
            apex: self.apex.as_dvec3(),
            apex_radius: f64::from(self.apex_radius),
        }
    }

    /// Returns whether the ray's line certainly misses it, decided in `f32`.
    #[inline(always)]
    fn is_missed_by(&self, ray: &PackedRay) -> bool {
        let radius = self.base_radius.max(self.apex_radius);
        // The distance between the ray's line and the axis, times the length of their cross product. Its
        // error is 6 ε of the size of each factor, and 8 ε of the sum.
        let axis = self.apex - self.base;
        let normal = ray.direction.cross(axis);
        let speed = ray.direction.abs().max_element() * axis.abs().max_element();
        let error = 128.0 * f32::EPSILON * ray.reach * speed;
        let apart = (ray.origin - self.base).dot(normal).abs() - error;
        let around = radius * (1.0 + 8.0 * f32::EPSILON);
        if apart > 0.0 && apart * apart > around * around * normal.length_squared() {
            return true;
        }
        // The bounding sphere.
        let reach = self.reach + ray.distance_error();
        ray.squared_distance(0.5 * (self.base + self.apex)) > reach * reach
    }
}

impl Form for PackedCone {
    type Of = Cone;
    type Ray = PackedRay;

    fn of(cone: &Cone, frame: &UnitFrame) -> Self {
        let ends = cone.ends();
        let [base, apex] = [ends.base, ends.apex].map(|end| frame.point(end).as_vec3());
        let [base_radius, apex_radius] =
            [ends.base_radius, ends.apex_radius].map(|r| (r * frame.scale()) as f32);
        let half = 0.5 * base.as_dvec3().distance(apex.as_dvec3());
        let reach = half.hypot(f64::from(base_radius.max(apex_radius)));
        PackedCone {
            base,
            base_radius,
            apex,
            apex_radius,
            reach: (reach as f32).next_up(),
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
        let ends = self.ends();
        let crossings = cone::Side::of(&ends).estimates(ends.base, ray);
        Estimate::settle(crossings, [ray.t_min, ray.t_max], t_max, |known| {
            Surface::Cone(ends).intersect(known, ray, Precision::F32)
        })
    }

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        Surface::Cone(self.ends()).exact_distance(ray)
    }

    fn exact_ray(ray: &PackedRay) -> &Ray {
        &ray.as_f64
    }

    fn rounding(&self) -> f64 {
        let radius = self.base_radius.max(self.apex_radius);
        let reach = self.base.abs().max(self.apex.abs()).max_element();
        rounding_within(reach + radius)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>()
    }
}

/// A packed object of any kind.
#[derive(PartialEq)]
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

    fn exact_distance(&self, ray: &Ray) -> Option<Root> {
        each_kind!(self, form => form.exact_distance(ray))
    }

    fn exact_ray(ray: &PackedRay) -> &Ray {
        &ray.as_f64
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
                        (packed.intersect_exact(wide, far), packed.is_missed_by(&ray))
                    }
                    1 => {
                        let packed = PackedTriangle::of(&triangle, &frame);
                        (packed.intersect_exact(wide, far), packed.is_missed_by(&ray))
                    }
                    2 => {
                        let packed = PackedPolygon::of(&polygon, &frame);
                        (packed.intersect_exact(wide, far), packed.is_missed_by(&ray))
                    }
                    _ => {
                        let packed = PackedCone::of(&cone, &frame);
                        (packed.intersect_exact(wide, far), packed.is_missed_by(&ray))
                    }
                };
                let hit = hit.is_some();
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
