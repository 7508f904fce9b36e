//! Scenes and rays that several cases use. They are deterministic.

use super::trial::Trial;
use crate::geometry::{Ray, Vec3};
use crate::primitive::{Polygon, Primitive, Shape, Sphere, Triangle};
use crate::scene::{Camera, Light, Material, Scene, SceneParts, builtin};
use std::borrow::Cow;

/// Returns a scene of these objects with a light and a camera outside of them.
pub fn scene_of(objects: Vec<Primitive>) -> Scene {
    let bounds = Scene::new(parts(objects.clone(), Vec3::ONE, Vec3::ZERO)).bounds();
    let (middle, radius) = if objects.is_empty() {
        (Vec3::ZERO, 1.0)
    } else {
        let radius = bounds.size().length() * 0.5;
        (bounds.center(), if radius > 0.0 { radius } else { 1.0 })
    };
    Scene::new(parts(
        objects,
        middle + 3.0 * radius * Vec3::new(0.48, -0.6, 0.64),
        middle,
    ))
}

fn parts(objects: Vec<Primitive>, from: Vec3, at: Vec3) -> SceneParts {
    SceneParts {
        name: "case".to_owned(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: vec![Light {
            position: from + (from - at).cross(Vec3::Z),
            color: None,
        }],
        background: Vec3::splat(0.25),
        camera: Camera {
            from,
            at,
            up: Vec3::Z,
            angle: 45.0,
            near: 1.0,
            resolution: [64, 64],
        },
        notes: Vec::new(),
    }
}

/// Returns the user's scene, or a built-in one with every kind of object and a mesh.
pub fn base<'a>(trial: &Trial<'a>) -> Cow<'a, Scene> {
    trial.scene.map_or_else(
        || {
            let teaching = builtin::generate("teaching", None).expect("there is such a scene");
            let mut objects = teaching.objects;
            objects.extend(torus(16, 8, Vec3::new(4.5, 4.5, 1.0), 1.2, 0.4));
            Cow::Owned(scene_of(objects))
        },
        Cow::Borrowed,
    )
}

/// Returns a closed triangle mesh, a torus around the z axis through `center`.
pub fn torus(around: u32, across: u32, center: Vec3, radius: f64, tube: f64) -> Vec<Primitive> {
    let vertex = |i: u32, j: u32| {
        let turn = |k: u32, n: u32| std::f64::consts::TAU * f64::from(k % n) / f64::from(n);
        let (a, b) = (turn(i, around), turn(j, across));
        let out = radius + tube * libm::cos(b);
        center + Vec3::new(out * libm::cos(a), out * libm::sin(a), tube * libm::sin(b))
    };
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
            triangles.extend([triangle(a, b, c), triangle(a, c, d)]);
        }
    }
    triangles
}

/// Creates a triangle.
///
/// # Panics
/// If the triangle has no area. None of the built-in triangles is degenerate.
pub fn triangle(a: Vec3, b: Vec3, c: Vec3) -> Primitive {
    Primitive::Triangle(Triangle::new([a, b, c], None).expect("it has an area"))
}

/// Creates a polygon.
///
/// # Panics
/// If the polygon has no area. None of the built-in polygons is degenerate.
pub fn polygon(vertices: &[[f64; 3]]) -> Primitive {
    let vertices = vertices.iter().copied().map(Vec3::from_array).collect();
    Primitive::Polygon(Polygon::new(vertices, None).expect("it has an area"))
}

/// Creates a sphere.
///
/// # Panics
/// If the radius is negative. None of the built-in radii is.
pub fn sphere(center: Vec3, radius: f64) -> Primitive {
    Primitive::Sphere(Sphere::new(center, radius).expect("it has a radius"))
}

/// Returns point `i` of a low-discrepancy sequence in the six-dimensional unit cube (M. Roberts,
/// "The unreasonable effectiveness of quasirandom sequences", 2018).
pub fn spread(i: usize) -> [f64; 6] {
    /// The root above 1 of x⁷ = x + 1.
    const ROOT: f64 = 1.112_775_684_278_706;
    let mut step = 1.0;
    std::array::from_fn(|_| {
        step /= ROOT;
        (0.5 + step * i as f64).fract()
    })
}

/// Maps two numbers from 0 to 1 to a unit vector, uniformly over the sphere.
pub fn unit(u: f64, v: f64) -> Vec3 {
    let z = 1.0 - 2.0 * u;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let turn = std::f64::consts::TAU * v;
    Vec3::new(r * libm::cos(turn), r * libm::sin(turn), z)
}

/// Returns the center of a scene and the radius of its bounding sphere. The radius is never 0.
pub fn ball(scene: &Scene) -> (Vec3, f64) {
    let bounds = scene.bounds();
    if bounds.is_empty() {
        return (Vec3::ZERO, 1.0);
    }
    let radius = 0.5 * bounds.size().length();
    let least = bounds.magnitude() * 1e-6 + f64::MIN_POSITIVE;
    (bounds.center(), radius.max(least))
}

/// Returns rays from all around the scene, aimed at points within the objects' boxes.
pub fn aims(scene: &Scene, count: usize) -> Vec<Ray> {
    aims_from(scene, count, 2.0)
}

/// Returns the rays of [`aims`] with origins at a distance of `away` scene radii.
pub fn aims_from(scene: &Scene, count: usize, away: f64) -> Vec<Ray> {
    let (middle, radius) = ball(scene);
    (0..count)
        .map(|i| {
            let [u, v, x, y, z, pick] = spread(i);
            let objects = scene.objects();
            let target = match objects.get((pick * objects.len() as f64) as usize) {
                Some(object) => {
                    let bounds = object.bounds();
                    bounds.lo + bounds.size() * Vec3::new(x, y, z)
                }
                None => Vec3::new(x, y, z) - 0.5,
            };
            let origin = middle + away * radius * unit(u, v);
            Ray::new(origin, (target - origin).normalize())
        })
        .collect()
}

/// Returns points where rounding matters: vertices, points on edges, tips, and the extreme points
/// of curved surfaces along the axes. At most `most`, evenly distributed over the scene.
pub fn features(scene: &Scene, most: usize) -> Vec<Vec3> {
    let mut all = Vec::new();
    for object in scene.objects() {
        match object {
            Primitive::Triangle(t) => along_edges(&t.vertices, &mut all),
            Primitive::Polygon(p) => along_edges(p.vertices(), &mut all),
            Primitive::Sphere(s) => {
                for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
                    all.extend([s.center + s.radius * axis, s.center - s.radius * axis]);
                }
            }
            Primitive::Cone(c) => {
                let across = (c.apex() - c.base()).any_orthonormal_vector();
                all.extend([
                    c.base(),
                    c.apex(),
                    c.base() + c.base_radius() * across,
                    c.apex() - c.apex_radius() * across,
                ]);
            }
        }
    }
    let every = all.len().div_ceil(most.max(1)).max(1);
    all.into_iter().step_by(every).collect()
}

fn along_edges(vertices: &[Vec3], points: &mut Vec<Vec3>) {
    for (i, &a) in vertices.iter().enumerate() {
        let b = vertices[(i + 1) % vertices.len()];
        points.extend([a, 0.5 * a + 0.5 * b, a + (b - a) / 3.0]);
    }
}
