//! `m-fluid`: [`super::fluid`] inside a hoop, above a large mirror. A reconstruction: the data of
//! the paper were never published.
//!
//! The original is *fluid* with a torus and a large mirror below, 2899 objects in total. Here these
//! are 2514 spheres, 384 quadrilaterals of a 24 × 16 torus, and the mirror, which makes the
//! bounding box so large that R_BBSC is only 1.32 %.

use super::entry::{Builtin, SPD_BACKGROUND, reconstruction_note};
use super::fluid;
use super::percent_g::round_point;
use crate::geometry::Vec3;
use crate::primitive::{Polygon, Primitive};
use crate::scene::camera::Camera;
use crate::scene::material::Material;
use crate::scene::parts::SceneParts;
use std::f64::consts::TAU;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "m-fluid",
    about: "The flow of fluid in a hoop above a mirror: a reconstruction of the scene in the paper",
    default_size: 1,
    sizes: 1..=1,
    generate,
};

/// The hoop around the flow, downstream of the ball: x coordinate, radius, and radius of the tube.
const HOOP_X: f64 = 1.2;
const HOOP_RADIUS: f64 = 0.42;
const TUBE_RADIUS: f64 = 0.06;
/// Quadrilaterals around the hoop and around its tube.
const AROUND: u32 = 24;
const AROUND_TUBE: u32 = 16;
/// Height, center and half the size of the mirror, chosen to match R_BBSC of the paper.
const MIRROR_Y: f64 = -0.95;
const MIRROR_X: f64 = 0.5;
const MIRROR_HALF: [f64; 2] = [8.0, 6.442];

fn generate(size: u32) -> SceneParts {
    let (mut objects, mut material_of) = fluid::flow();
    objects.extend(hoop());
    material_of.resize(objects.len(), 2);
    objects.push(mirror());
    material_of.push(3);
    let paint = Material {
        color: Vec3::new(0.25, 0.6, 0.3),
        diffuse: 0.8,
        specular: 0.1,
        shine: 20.0,
        ..Material::default()
    };
    let mirror = Material {
        color: Vec3::new(0.35, 0.4, 0.45),
        diffuse: 0.4,
        specular: 0.5,
        shine: 100.0,
        ..Material::default()
    };
    SceneParts {
        name: format!("m-fluid:{size}"),
        objects,
        material_of,
        materials: fluid::materials()
            .into_iter()
            .chain([paint, mirror])
            .collect(),
        lights: [(5.0, 6.0, 6.0), (-4.0, 5.0, 3.0)]
            .map(fluid::light)
            .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(3.0, 1.6, 6.0),
            at: Vec3::new(0.5, -0.35, 0.0),
            up: Vec3::Y,
            angle: 37.1,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![reconstruction_note("m-fluid")],
    }
}

/// Returns a torus around the x axis.
fn hoop() -> impl Iterator<Item = Primitive> {
    let vertex = |i: u32, j: u32| {
        let (around, tube) = (turn(i, AROUND), turn(j, AROUND_TUBE));
        let radius = HOOP_RADIUS + TUBE_RADIUS * libm::cos(tube);
        Vec3::new(
            HOOP_X + TUBE_RADIUS * libm::sin(tube),
            radius * libm::cos(around),
            radius * libm::sin(around),
        )
    };
    (0..AROUND).flat_map(move |i| {
        (0..AROUND_TUBE).map(move |j| {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            quadrangle(corners.map(|(i, j)| vertex(i, j)))
        })
    })
}

/// Returns the angle of `i` of `n` parts of a full turn. The last angle is exactly equal to the
/// first.
fn turn(i: u32, n: u32) -> f64 {
    TAU * f64::from(i % n) / f64::from(n)
}

fn mirror() -> Primitive {
    let [half_x, half_z] = MIRROR_HALF;
    let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    quadrangle(corners.map(|(x, z)| Vec3::new(MIRROR_X + x * half_x, MIRROR_Y, z * half_z)))
}

fn quadrangle(corners: [Vec3; 4]) -> Primitive {
    let polygon = Polygon::new(corners.map(round_point).to_vec(), None);
    Primitive::Polygon(polygon.expect("the corners lie in a plane and span an area"))
}
