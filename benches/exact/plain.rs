//! Tests of objects in `f64` as most ray tracers do them: without a bound on the error.

use bspscope::geometry::{Axis, Ray, Vec3};
use bspscope::primitive::{Cone, Polygon, Primitive, Sphere, Triangle};

pub fn intersect(object: &Primitive, ray: &Ray, t_max: f64) -> Option<f64> {
    match object {
        Primitive::Sphere(shape) => sphere(shape, ray, t_max),
        Primitive::Triangle(shape) => triangle(shape, ray, t_max),
        Primitive::Polygon(shape) => polygon(shape, ray, t_max),
        Primitive::Cone(shape) => cone(shape, ray, t_max),
    }
}

/// Haines, Günther and Akenine-Möller, "Precision improvements for ray/sphere intersection" (Ray Tracing
/// Gems, 2019, ch. 7).
fn sphere(sphere: &Sphere, ray: &Ray, t_max: f64) -> Option<f64> {
    let a = ray.direction.length_squared();
    let to_center = sphere.center - ray.origin;
    let b = to_center.dot(ray.direction);
    let offset = to_center - (b / a) * ray.direction;
    let squared_radius = sphere.radius * sphere.radius;
    let discriminant = squared_radius - offset.length_squared();
    if discriminant < 0.0 {
        return None;
    }
    let q = b + (a * discriminant).sqrt().copysign(b);
    let c = to_center.length_squared() - squared_radius;
    first([c / q, q / a], ray, t_max, |_| true)
}

/// Returns the first root within reach that is on the surface.
fn first(roots: [f64; 2], ray: &Ray, t_max: f64, is_on: impl Fn(f64) -> bool) -> Option<f64> {
    let [a, b] = roots;
    let (near, far) = if a < b { (a, b) } else { (b, a) };
    [near, far]
        .into_iter()
        .find(|&t| ray.t_min <= t && t <= t_max && is_on(t))
}

/// Returns coordinates in cyclic order with that along `axis` last.
fn rotated(v: Vec3, axis: Axis) -> Vec3 {
    match axis {
        Axis::X => Vec3::new(v.y, v.z, v.x),
        Axis::Y => Vec3::new(v.z, v.x, v.y),
        Axis::Z => v,
    }
}

/// Woop, Benthin and Wald, "Watertight ray/triangle intersection" (JCGT 2(1), 2013).
fn triangle(triangle: &Triangle, ray: &Ray, t_max: f64) -> Option<f64> {
    let size = ray.direction.abs();
    let axis = if size.x > size.y && size.x > size.z {
        Axis::X
    } else if size.y > size.z {
        Axis::Y
    } else {
        Axis::Z
    };
    let d = rotated(ray.direction, axis);
    let sz = 1.0 / d.z;
    let (sx, sy) = (d.x * sz, d.y * sz);
    let [a, b, c] = triangle.vertices.map(|v| {
        let v = rotated(v - ray.origin, axis);
        Vec3::new(v.x - sx * v.z, v.y - sy * v.z, sz * v.z)
    });
    let u = c.x * b.y - c.y * b.x;
    let v = a.x * c.y - a.y * c.x;
    let w = b.x * a.y - b.y * a.x;
    if u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0 {
        return None;
    }
    let t = (u * a.z + v * b.z + w * c.z) / (u + v + w);
    (ray.t_min <= t && t <= t_max).then_some(t)
}

/// The plane, then the crossings of a half-line with the outline (Haines, "Point in polygon strategies",
/// Graphics Gems IV, 1994).
fn polygon(polygon: &Polygon, ray: &Ray, t_max: f64) -> Option<f64> {
    let vertices = polygon.vertices();
    let normal = polygon.normal();
    let t = normal.dot(vertices[0] - ray.origin) / normal.dot(ray.direction);
    if !(ray.t_min <= t && t <= t_max) {
        return None;
    }
    let axis = polygon.projection_axis();
    let point = rotated(ray.at(t), axis);
    let mut a = rotated(vertices[vertices.len() - 1], axis);
    let mut inside = false;
    for &vertex in vertices {
        let b = rotated(vertex, axis);
        if (a.y > point.y) != (b.y > point.y) {
            let x = a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x);
            inside ^= x > point.x;
        }
        a = b;
    }
    inside.then_some(t)
}

/// The quadratic equation relative to the point of the ray nearest to the middle.
fn cone(cone: &Cone, ray: &Ray, t_max: f64) -> Option<f64> {
    let along = cone.apex() - cone.base();
    let length = cone.length();
    let (axis, middle) = (along / length, cone.base() + 0.5 * along);
    let slope = (cone.apex_radius() - cone.base_radius()) / length;
    let middle_radius = 0.5 * (cone.base_radius() + cone.apex_radius());
    let direction = ray.direction;
    let from_middle = ray.origin - middle;
    let t_nearest = -from_middle.dot(direction) / direction.length_squared();
    let nearest = from_middle + t_nearest * direction;
    let (height, rise) = (nearest.dot(axis), direction.dot(axis));
    let (radius, growth) = (middle_radius + slope * height, slope * rise);
    let across = nearest - height * axis;
    let drift = direction - rise * axis;
    let a = drift.length_squared() - growth * growth;
    let b = across.dot(drift) - radius * growth;
    let c = across.length_squared() - radius * radius;
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return None;
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    let roots = [q / a, c / q].map(|s| t_nearest + s);
    let is_on = |t: f64| (height + (t - t_nearest) * rise).abs() <= 0.5 * length;
    first(roots, ray, t_max, is_on)
}
