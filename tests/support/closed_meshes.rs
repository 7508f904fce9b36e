//! Closed meshes with rays from inside at their vertices and edges.

use super::random::Random;
use super::scenes::scene_of;
use bspscope::geometry::{Ray, Vec3};
use bspscope::primitive::Precision;
use bspscope::primitive::{Polygon, Primitive, Triangle};
use bspscope::progress::Progress;
use bspscope::structure::{BuildSettings, Method, build};
use bspscope::trace::{Batch, Hit, RayKind, RayTracer, ScalarKernel};
use rayon::prelude::*;

/// A mesh by its faces, with points inside from which every face can be seen or something before it.
struct Mesh {
    name: &'static str,
    faces: Vec<Vec<Vec3>>,
    inside: Vec<Vec3>,
}

/// What came of one mesh and method.
pub struct Leaks {
    pub name: String,
    pub rays: u64,
    /// Rays that hit nothing.
    pub leaked: u64,
    /// One of them.
    pub example: Option<Ray>,
}

/// Traces about `count` rays, evenly over meshes, methods and precisions.
pub fn leaks(count: u64) -> Vec<Leaks> {
    const CHUNK: u64 = 4096;
    let methods: Vec<_> = Method::all().collect();
    let meshes = meshes();
    let parts = meshes.len() * methods.len() * Precision::ALL.len();
    let each = count.div_ceil(parts as u64);
    let mut found = Vec::new();
    for mesh in &meshes {
        let scene = scene_of(objects_of(&mesh.faces));
        for &method in &methods {
            let settings = BuildSettings::for_method(method);
            let tree = build(&scene, &settings, &Progress::new()).unwrap();
            let progress = Progress::new();
            let leaking = |precision: Precision, chunk: u64| {
                let range = chunk * CHUNK..each.min((chunk + 1) * CHUNK);
                let rays: Vec<Ray> = range.map(|i| ray(mesh, i)).collect();
                let mut hits: Vec<Hit> = Vec::new();
                let batch = Batch {
                    kind: RayKind::Primary,
                    rays: &rays,
                    pixels: &[],
                };
                ScalarKernel::new(&tree, scene.shapes(precision), &progress)
                    .closest_hits(batch, &mut hits);
                let all = rays.into_iter().zip(hits);
                let leaking = all.filter(|(_, hit)| !hit.is_hit());
                leaking.fold((0, None), |(n, first), (ray, _)| {
                    (n + 1, first.or(Some(ray)))
                })
            };
            for precision in Precision::ALL {
                let (leaked, example) = (0..each.div_ceil(CHUNK))
                    .into_par_iter()
                    .map(|chunk| leaking(precision, chunk))
                    .reduce(|| (0, None), |a, b| (a.0 + b.0, a.1.or(b.1)));
                found.push(Leaks {
                    name: format!("{}, {}, {}", mesh.name, method.name, precision.name()),
                    rays: each,
                    leaked,
                    example,
                });
            }
        }
    }
    found
}

/// Ray number `i`: at a vertex, at points of an edge, or one rounding beside them.
fn ray(mesh: &Mesh, i: u64) -> Ray {
    let mut random = Random(i);
    let mut next = |n: usize| random.below(n);
    let face = &mesh.faces[next(mesh.faces.len())];
    let k = next(face.len());
    let (a, b) = (face[k], face[(k + 1) % face.len()]);
    let share = next(1 << 20) as f64 / f64::from(1 << 20);
    let mut target = if next(3) == 0 { a } else { a + share * (b - a) };
    if next(2) == 0 {
        let axis = next(3);
        let x = target[axis];
        target[axis] = if next(2) == 0 {
            x.next_up()
        } else {
            x.next_down()
        };
    }
    let origin = mesh.inside[next(mesh.inside.len())];
    let direction = target - origin;
    // As long as it is, or of unit length, as the renderer has it.
    let unit = next(2) == 0;
    Ray::new(
        origin,
        if unit {
            direction.normalize()
        } else {
            direction
        },
    )
}

fn objects_of(faces: &[Vec<Vec3>]) -> Vec<Primitive> {
    let object = |face: &Vec<Vec3>| match face[..] {
        [a, b, c] => Primitive::Triangle(Triangle::new([a, b, c], None).unwrap()),
        _ => Primitive::Polygon(Polygon::new(face.clone(), None).unwrap()),
    };
    faces.iter().map(object).collect()
}

fn meshes() -> Vec<Mesh> {
    let turn = |k: u32, n: u32| std::f64::consts::TAU * f64::from(k % n) / f64::from(n);
    // The same product for both of a seam's faces: a vertex is one point.
    let sphere_at = |i: u32, j: u32| {
        let (around, down) = (turn(i, 32), std::f64::consts::PI * f64::from(j) / 16.0);
        let ring = if j.is_multiple_of(16) {
            0.0
        } else {
            down.sin()
        };
        Vec3::new(ring * around.cos(), ring * around.sin(), down.cos())
    };
    let mut sphere = Vec::new();
    for i in 0..32 {
        for j in 0..16 {
            let [a, b] = [sphere_at(i, j), sphere_at(i + 1, j)];
            let [c, d] = [sphere_at(i + 1, j + 1), sphere_at(i, j + 1)];
            if j > 0 {
                sphere.push(vec![a, b, c]);
            }
            if j < 15 {
                sphere.push(vec![a, c, d]);
            }
        }
    }
    let torus_at = |i: u32, j: u32| {
        let out = 2.0 + 0.7 * turn(j, 12).cos();
        let (c, s) = (turn(i, 24).cos(), turn(i, 24).sin());
        Vec3::new(out * c, out * s, 0.7 * turn(j, 12).sin())
    };
    let mut torus = Vec::new();
    for i in 0..24 {
        for j in 0..12 {
            let [a, b] = [torus_at(i, j), torus_at(i + 1, j)];
            let [c, d] = [torus_at(i + 1, j + 1), torus_at(i, j + 1)];
            torus.extend([vec![a, b, c], vec![a, c, d]]);
        }
    }
    let ring = (0..24).map(|k| Vec3::new(2.0 * turn(k, 24).cos(), 2.0 * turn(k, 24).sin(), 0.0));
    // A box of quadrilaterals, each side of 4 × 4.
    let mut cube = Vec::new();
    for axis in 0..3 {
        for end in [-1.0, 1.0] {
            let corner = |i: u32, j: u32| {
                let mut v = Vec3::splat(end);
                v[(axis + 1) % 3] = f64::from(i) * 0.5 - 1.0;
                v[(axis + 2) % 3] = f64::from(j) * 0.5 - 1.0;
                v
            };
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                cube.push(vec![
                    corner(i, j),
                    corner(i + 1, j),
                    corner(i + 1, j + 1),
                    corner(i, j + 1),
                ]);
            }
        }
    }
    let near_middle =
        || (0..27).map(|i| Vec3::new((i % 3).into(), (i / 3 % 3).into(), (i / 9).into()) * 0.11);
    vec![
        turned("sphere of triangles", sphere, near_middle().collect()),
        turned("torus of triangles", torus, ring.collect()),
        Mesh {
            name: "box of quadrilaterals",
            faces: cube.clone(),
            inside: near_middle().collect(),
        },
        turned(
            "turned box of quadrilaterals",
            cube,
            near_middle().collect(),
        ),
    ]
}

/// The mesh turned about an axis that is none of the three, and moved.
fn turned(name: &'static str, faces: Vec<Vec<Vec3>>, inside: Vec<Vec3>) -> Mesh {
    let axis = Vec3::new(0.48, 0.6, 0.64);
    let (sine, cosine) = 0.7f64.sin_cos();
    let turn = |v: Vec3| {
        let turned = v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine));
        turned + Vec3::new(0.1, -20.3, 3.7)
    };
    Mesh {
        name,
        faces: faces
            .into_iter()
            .map(|face| face.into_iter().map(turn).collect())
            .collect(),
        inside: inside.into_iter().map(turn).collect(),
    }
}
