//! Terrain of any size. All coordinates are representable as `f32`.

use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Triangle};
use bspscope::scene::{Camera, Material, Scene, SceneParts};

fn triangle(vertices: [Vec3; 3]) -> Option<Primitive> {
    let rounded = vertices.map(|v| v.as_vec3().as_dvec3());
    Triangle::new(rounded, None).ok().map(Primitive::Triangle)
}

/// Returns hills of nine octaves of noise over a square of `n` × `n` quadrangles of two triangles each.
pub fn scene(n: usize) -> Scene {
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
        near: 0.1,
        resolution: [512, 512],
    };
    let objects: Vec<Primitive> = objects.collect();
    Scene::new(SceneParts {
        name: "terrain".into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera,
        notes: Vec::new(),
    })
}

/// Returns smooth noise from 0 to 1, from values hashed on a lattice.
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
