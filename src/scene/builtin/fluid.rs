//! `fluid`: a flow around a ball, visualized by spheres along its streamlines. A reconstruction:
//! the data of the paper were never published.
//!
//! The original has 2514 spheres, a bounding box of about 4.07 : 1 : 2.29, and the figures of the
//! paper's Tables 4 and 6. Here an ideal fluid flows along x around a ball (potential flow, as in
//! L. M. Milne-Thomson, Theoretical Hydrodynamics, chapter 15), with beads on every streamline at
//! equal time steps.

use super::entry::{Builtin, SPD_BACKGROUND, reconstruction_note};
use super::percent_g::round_point;
use crate::geometry::Vec3;
use crate::primitive::{Primitive, Sphere};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "fluid",
    about: "A flow around a ball as beads on streamlines: a reconstruction of the scene in the paper",
    default_size: 1,
    sizes: 1..=1,
    generate,
};

/// The ball and the beads; as many as in the paper.
const SPHERES: usize = 2514;
const BALL_RADIUS: f64 = 0.25;
/// Chosen so that all bounding boxes together take 42.0 % of the volume of the scene.
const BEAD_RADIUS: f64 = 0.05735;
/// Streamlines by height (y) and across (z).
const LINES: [u32; 2] = [5, 9];
const BEADS_PER_LINE: u32 = 56;
/// Streamlines begin this far upstream of the ball, in a window of this height and width.
const UPSTREAM: f64 = 1.5;
const WINDOW: [f64; 2] = [0.805, 2.163];
/// Distance that undisturbed fluid travels along a streamline.
const LENGTH: f64 = 3.952;
/// Integration steps from bead to bead.
const STEPS: u32 = 4;

fn generate(size: u32) -> SceneParts {
    let (objects, material_of) = flow();
    SceneParts {
        name: format!("fluid:{size}"),
        objects,
        material_of,
        materials: materials().to_vec(),
        lights: [
            (5.0, 6.0, 6.0),
            (-4.0, 5.0, 3.0),
            (0.0, 4.0, 9.0),
            (2.0, -6.0, 5.0),
        ]
        .map(light)
        .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(2.5, 3.0, 9.5),
            at: Vec3::new(0.5, 0.0, 0.0),
            up: Vec3::Y,
            angle: 49.88,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![reconstruction_note("fluid")],
    }
}

pub(super) fn light(position: (f64, f64, f64)) -> Light {
    Light {
        position: position.into(),
        color: None,
    }
}

/// Returns the materials of the ball and of the beads.
pub(super) fn materials() -> [Material; 2] {
    let material = |color, specular| Material {
        color,
        diffuse: 0.8,
        specular,
        shine: 20.0,
        ..Material::default()
    };
    [
        material(Vec3::new(0.9, 0.3, 0.15), 0.3),
        material(Vec3::new(1.0, 0.9, 0.7), 0.1),
    ]
}

/// Returns the ball, then the beads of one streamline after the other, and the materials of all.
pub(super) fn flow() -> (Vec<Primitive>, Vec<u32>) {
    let [rows, columns] = LINES;
    let place = |i: u32, n: u32| f64::from(i) / f64::from(n - 1) - 0.5;
    let starts = (0..columns).flat_map(|column| {
        (0..rows).map(move |row| {
            let (y, z) = (place(row, rows), place(column, columns));
            Vec3::new(-UPSTREAM, y * WINDOW[0], z * WINDOW[1])
        })
    });
    let mut objects = vec![sphere(Vec3::ZERO, BALL_RADIUS)];
    let beads = starts.flat_map(streamline);
    objects.extend(
        beads
            .take(SPHERES - 1)
            .map(|bead| sphere(bead, BEAD_RADIUS)),
    );
    let mut material_of = vec![1; objects.len()];
    material_of[0] = 0;
    (objects, material_of)
}

fn sphere(center: Vec3, radius: f64) -> Primitive {
    Primitive::Sphere(Sphere::new(round_point(center), radius).expect("radii are positive"))
}

/// Returns the positions of a particle at equal time steps.
fn streamline(start: Vec3) -> impl Iterator<Item = Vec3> {
    let step = LENGTH / f64::from((BEADS_PER_LINE - 1) * STEPS);
    let advance = move |place: &Vec3| Some((0..STEPS).fold(*place, |at, _| rk4_step(at, step)));
    std::iter::successors(Some(start), advance).take(BEADS_PER_LINE as usize)
}

/// Advances a particle by one time step (fourth-order Runge–Kutta).
fn rk4_step(at: Vec3, step: f64) -> Vec3 {
    let first = velocity(at);
    let second = velocity(at + first * (step * 0.5));
    let third = velocity(at + second * (step * 0.5));
    let fourth = velocity(at + third * step);
    at + (first + 2.0 * second + 2.0 * third + fourth) * (step / 6.0)
}

/// Returns the velocity of an ideal fluid around the ball; far away it is 1 along x.
fn velocity(at: Vec3) -> Vec3 {
    let distance = at.length();
    let dipole = BALL_RADIUS.powi(3) / (2.0 * distance.powi(3));
    Vec3::X * (1.0 + dipole) - at * (3.0 * dipole * at.x / (distance * distance))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fluid_does_not_enter_the_ball() {
        for direction in [Vec3::X, Vec3::Y, Vec3::new(0.6, 0.48, -0.64)] {
            let through_the_surface = velocity(direction * BALL_RADIUS).dot(direction);
            assert!(through_the_surface.abs() < 1e-12);
        }
        let far = velocity(Vec3::new(30.0, 40.0, 0.0));
        assert!((far - Vec3::X).length() < 1e-6);
    }
}
