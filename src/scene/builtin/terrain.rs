//! `terrain`: hills of triangles, as models of landscapes have them: one surface, seen from aslant.

use super::entry::Builtin;
use crate::geometry::Vec3;
use crate::primitive::{Primitive, Triangle};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "terrain",
    about: "Hills of triangles: one closed surface in a flat box",
    default_size: 32,
    sizes: 1..=2500,
    generate,
};

/// Octaves of the hills, each of half the height and about half the width of the one before.
const OCTAVES: u32 = 9;

/// Generates a square of `size` × `size` quadrangles of two triangles each, from −1 to 1. All coordinates are
/// representable as `f32`.
fn generate(size: u32) -> SceneParts {
    let point = |i: u32, j: u32| {
        let [x, y] = [i, j].map(|i| f64::from(i) / f64::from(size));
        let point = Vec3::new(2.0 * x - 1.0, 2.0 * y - 1.0, height(x, y));
        point.as_vec3().as_dvec3()
    };
    let mut objects = Vec::with_capacity(2 * (size as usize).pow(2));
    for j in 0..size {
        for i in 0..size {
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[x, y]| point(i + x, j + y));
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let triangle = Triangle::new([corners[a], corners[b], corners[c]], None);
                objects.push(Primitive::Triangle(
                    triangle.expect("half a quadrangle has area"),
                ));
            }
        }
    }
    SceneParts {
        name: format!("terrain:{size}"),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material {
            color: Vec3::new(0.45, 0.6, 0.35),
            diffuse: 0.9,
            specular: 0.1,
            shine: 10.0,
            ..Material::default()
        }],
        lights: vec![Light {
            position: Vec3::new(-6.0, 2.0, 3.0),
            color: None,
        }],
        background: Vec3::new(0.6, 0.75, 0.9),
        camera: Camera {
            from: Vec3::new(-1.3, -1.1, 0.9),
            at: Vec3::new(0.0, 0.0, 0.1),
            up: Vec3::Z,
            angle: 45.0,
            near: 0.1,
            resolution: [512, 512],
        },
        notes: Vec::new(),
    }
}

/// Returns the height at a place of the unit square: noise of several octaves.
fn height(x: f64, y: f64) -> f64 {
    let (mut frequency, mut most, mut sum) = (4.0, 0.18, 0.0);
    for octave in 0..OCTAVES {
        sum += most * noise(x * frequency, y * frequency, octave);
        // Not quite doubled, so that the lattices of the octaves do not coincide.
        frequency *= 2.03;
        most *= 0.5;
    }
    sum
}

/// Returns smooth noise from 0 to 1, from values hashed on a lattice.
fn noise(x: f64, y: f64, seed: u32) -> f64 {
    let at = |x: f64, y: f64| {
        let mut bits = (x as u32).wrapping_mul(0x9E37_79B1)
            ^ (y as u32).wrapping_mul(0x85EB_CA77)
            ^ seed.wrapping_mul(0xC2B2_AE3D);
        bits = (bits ^ bits >> 15).wrapping_mul(0x2C1B_3C6D);
        bits = (bits ^ bits >> 12).wrapping_mul(0x297A_2D39);
        f64::from(bits ^ bits >> 15) / f64::from(u32::MAX)
    };
    let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
    let (i, j) = (x.floor(), y.floor());
    let (a, b) = (smooth(x - i), smooth(y - j));
    let row = |j: f64| at(i, j) * (1.0 - a) + at(i + 1.0, j) * a;
    row(j) * (1.0 - b) + row(j + 1.0) * b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_is_closed_and_stays_in_a_flat_box() {
        let scene = generate(5);
        assert_eq!(scene.objects.len(), 50);
        for object in &scene.objects {
            let Primitive::Triangle(triangle) = object else {
                panic!("{object:?} in terrain");
            };
            for v in triangle.vertices {
                assert!((0.0..=0.36).contains(&v.z), "{v}");
            }
        }
    }
}
