//! The scenes of the comparison. All coordinates are those of an `f32`, so that every peer gets the
//! same geometry.

use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Sphere, Triangle};
use bspscope::scene::builtin::generate;
use bspscope::scene::{Camera, Material, Scene, SceneParts};

/// A scene and where its shadow rays go.
pub struct Subject {
    pub name: &'static str,
    pub scene: Scene,
    pub light: Vec3,
}

/// A scene's name and generator.
type Entry = (&'static str, fn() -> Subject);

/// All scenes.
pub const SCENES: [Entry; 4] = [
    ("tetra", tetra),
    ("terrain", || terrain(707)),
    ("balls", balls),
    ("balls-tessellated", balls_tessellated),
];

fn rounded(v: Vec3) -> Vec3 {
    v.as_vec3().as_dvec3()
}

fn triangle(vertices: [Vec3; 3]) -> Option<Primitive> {
    let triangle = Triangle::new(vertices.map(rounded), None).ok()?;
    Some(Primitive::Triangle(triangle))
}

fn subject(name: &'static str, objects: Vec<Primitive>, camera: Camera, light: Vec3) -> Subject {
    let parts = SceneParts {
        name: name.into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera,
        notes: Vec::new(),
    };
    Subject {
        name,
        scene: Scene::new(parts),
        light,
    }
}

/// The paper's scene: 4096 triangles.
fn tetra() -> Subject {
    let parts = generate("tetra", None).expect("a generator");
    let objects = parts.objects.iter().filter_map(|object| match object {
        Primitive::Triangle(t) => triangle(t.vertices),
        _ => None,
    });
    let light = parts.lights[0].position;
    subject("tetra", objects.collect(), parts.camera, light)
}

/// The spheres of the paper's scene, 7381, without its floor.
fn spheres() -> (Vec<Sphere>, Camera, Vec3) {
    let parts = generate("balls", None).expect("a generator");
    let spheres = parts.objects.iter().filter_map(|object| match object {
        Primitive::Sphere(s) => {
            let radius = f64::from(s.radius as f32);
            Sphere::new(rounded(s.center), radius).ok()
        }
        _ => None,
    });
    let light = parts.lights[0].position;
    (spheres.collect(), parts.camera, light)
}

fn balls() -> Subject {
    let (spheres, camera, light) = spheres();
    let objects = spheres.into_iter().map(Primitive::Sphere).collect();
    subject("balls", objects, camera, light)
}

/// The same spheres as icosahedra divided twice, 320 triangles each: 2.4 million.
fn balls_tessellated() -> Subject {
    let (spheres, camera, light) = spheres();
    let unit = unit_sphere(2);
    let objects = spheres.iter().flat_map(|sphere| {
        let place = |v: Vec3| sphere.center + sphere.radius * v;
        unit.iter().filter_map(move |t| triangle(t.map(place)))
    });
    subject("balls-tessellated", objects.collect(), camera, light)
}

/// An icosahedron whose triangles are divided in four so many times, vertices on the unit sphere.
fn unit_sphere(divisions: u32) -> Vec<[Vec3; 3]> {
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let corners = [
        [-1.0, p, 0.0],
        [1.0, p, 0.0],
        [-1.0, -p, 0.0],
        [1.0, -p, 0.0],
        [0.0, -1.0, p],
        [0.0, 1.0, p],
        [0.0, -1.0, -p],
        [0.0, 1.0, -p],
        [p, 0.0, -1.0],
        [p, 0.0, 1.0],
        [-p, 0.0, -1.0],
        [-p, 0.0, 1.0],
    ]
    .map(|corner| Vec3::from(corner).normalize());
    let faces = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let mut triangles: Vec<_> = faces.iter().map(|f| f.map(|i: usize| corners[i])).collect();
    for _ in 0..divisions {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [x, y, z] = [a + b, b + c, c + a].map(Vec3::normalize);
                [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
            })
            .collect();
    }
    triangles
}

/// Hills of nine octaves of noise over a square of `n` × `n` quadrangles, two triangles each.
fn terrain(n: usize) -> Subject {
    let place = |i: usize| i as f64 / n as f64;
    let point = |i: usize, j: usize| {
        let (x, y) = (place(i), place(j));
        let (mut frequency, mut height, mut z) = (4.0, 0.18, 0.0);
        for octave in 0..9 {
            z += height * noise(x * frequency, y * frequency, octave);
            frequency *= 2.03;
            height *= 0.5;
        }
        Vec3::new(2.0 * x - 1.0, 2.0 * y - 1.0, z)
    };
    let rows: Vec<Vec<Vec3>> = (0..=n)
        .map(|j| (0..=n).map(|i| point(i, j)).collect())
        .collect();
    let quadrangles = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let objects = quadrangles.flat_map(|(i, j)| {
        let [a, b] = [rows[j][i], rows[j][i + 1]];
        let [d, c] = [rows[j + 1][i], rows[j + 1][i + 1]];
        [[a, b, c], [a, c, d]].into_iter().filter_map(triangle)
    });
    let camera = Camera {
        from: Vec3::new(-1.3, -1.1, 0.9),
        at: Vec3::new(0.0, 0.0, 0.1),
        up: Vec3::Z,
        angle: 45.0,
        hither: 0.1,
        resolution: [512, 512],
    };
    let light = Vec3::new(1.5, -1.0, 1.0);
    subject("terrain", objects.collect(), camera, light)
}

/// Smooth noise from 0 to 1 with values hashed from a lattice.
fn noise(x: f64, y: f64, seed: u32) -> f64 {
    let at = |x: f64, y: f64| {
        let (x, y) = (x as u32, y as u32);
        let mut h = x.wrapping_mul(0x9E37_79B1)
            ^ y.wrapping_mul(0x85EB_CA77)
            ^ seed.wrapping_mul(0xC2B2_AE3D);
        h = (h ^ h >> 15).wrapping_mul(0x2C1B_3C6D);
        h = (h ^ h >> 12).wrapping_mul(0x297A_2D39);
        f64::from(h ^ h >> 15) / f64::from(u32::MAX)
    };
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (i, j) = (x.floor(), y.floor());
    let (a, b) = (smooth(x - i), smooth(y - j));
    let row = |j: f64| at(i, j) * (1.0 - a) + at(i + 1.0, j) * a;
    row(j) * (1.0 - b) + row(j + 1.0) * b
}
