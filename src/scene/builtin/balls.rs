//! `balls`: the sphereflake (E. Haines, Standard Procedural Databases).

use super::entry::{Builtin, SPD_BACKGROUND, margin_note};
use super::percent_g::{round_g, round_point};
use crate::geometry::Vec3;
use crate::primitive::{Polygon, Primitive, Sphere};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;
use glam::DMat3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

pub(super) const BUILTIN: Builtin = Builtin {
    name: "balls",
    about: "A sphere with nine spheres on it, each a third as large, and so on, above a floor",
    default_size: 4,
    sizes: 0..=6,
    generate,
};

const ROOT_RADIUS: f64 = 0.5;
const FLOOR_HALF: f64 = 12.0;

/// Generates the floor and Σ 9^i spheres, i from 0 to `size`.
fn generate(size: u32) -> SceneParts {
    let floor = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
        .map(|(x, y)| Vec3::new(x * FLOOR_HALF, y * FLOOR_HALF, -ROOT_RADIUS))
        .to_vec();
    let floor = Polygon::new(floor, None).expect("a square is a polygon");
    let mut objects = vec![Primitive::Polygon(floor)];
    add_sphere(
        Ball {
            center: Vec3::ZERO,
            radius: ROOT_RADIUS,
            direction: Vec3::Z,
        },
        size,
        &child_directions(),
        &mut objects,
    );
    let mut material_of = vec![1; objects.len()];
    material_of[0] = 0;
    SceneParts {
        name: format!("balls:{size}"),
        objects,
        material_of,
        materials: vec![
            Material {
                color: Vec3::new(1.0, 0.75, 0.33),
                diffuse: 0.8,
                specular: 0.0,
                shine: 100_000.0,
                transmittance: 0.0,
                index_of_refraction: 1.0,
            },
            Material {
                color: Vec3::new(1.0, 0.9, 0.7),
                diffuse: 0.5,
                specular: 0.5,
                shine: 3.0827,
                transmittance: 0.0,
                index_of_refraction: 1.0,
            },
        ],
        lights: [(4.0, 3.0, 2.0), (1.0, -4.0, 4.0), (-3.0, 1.0, 5.0)]
            .map(|position| Light {
                position: position.into(),
                color: None,
            })
            .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(2.1, 1.3, 1.7),
            at: Vec3::ZERO,
            up: Vec3::Z,
            angle: 45.0,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![margin_note()],
    }
}

/// A sphere before rounding, and its position on its parent.
struct Ball {
    center: Vec3,
    radius: f64,
    /// Unit direction away from the center of the parent.
    direction: Vec3,
}

/// Adds the ball and `levels` generations of its children, in depth-first order.
fn add_sphere(ball: Ball, levels: u32, directions: &[Vec3; 9], objects: &mut Vec<Primitive>) {
    let sphere = Sphere::new(round_point(ball.center), round_g(ball.radius));
    objects.push(Primitive::Sphere(sphere.expect("the radius is positive")));
    if levels == 0 {
        return;
    }
    let turn = rotation_from_z(ball.direction);
    for &direction in directions {
        let direction = turn * direction;
        let child = Ball {
            center: ball.center + direction * (4.0 / 3.0 * ball.radius),
            radius: ball.radius / 3.0,
            direction,
        };
        add_sphere(child, levels - 1, directions, objects);
    }
}

/// Returns the directions of the children of a ball that points along +z: three trios around the z
/// axis.
fn child_directions() -> [Vec3; 9] {
    let d = FRAC_1_SQRT_2;
    let trio = [
        Vec3::new(d, d, 0.0),
        Vec3::new(d, 0.0, -d),
        Vec3::new(0.0, d, -d),
    ];
    let tilt = rotation(Vec3::new(d, -d, 0.0), libm::asin(2.0 / 6f64.sqrt()));
    std::array::from_fn(|i| {
        let turn = rotation(Vec3::Z, (i / 3) as f64 * 2.0 * PI / 3.0);
        turn * (tilt * trio[i % 3])
    })
}

/// Returns the smallest rotation from +z to a unit direction. If z is beyond ±0.9999 it is the
/// identity or the half turn around y, because a test for exactly ±1 would depend on rounding.
fn rotation_from_z(direction: Vec3) -> DMat3 {
    if direction.z >= 0.9999 {
        DMat3::IDENTITY
    } else if direction.z <= -0.9999 {
        rotation(Vec3::Y, PI)
    } else {
        let axis = Vec3::Z.cross(direction).normalize();
        rotation(axis, libm::acos(direction.z))
    }
}

/// Returns the right-handed rotation around a unit axis. Uses libm to be the same on every
/// platform.
fn rotation(axis: Vec3, angle: f64) -> DMat3 {
    let (sin, cos) = libm::sincos(angle);
    let turned = |v: Vec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    DMat3::from_cols(turned(Vec3::X), turned(Vec3::Y), turned(Vec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;

    /// The bounding box of an object, computed directly.
    fn bounds(object: &Primitive) -> Aabb {
        match object {
            Primitive::Sphere(s) => Aabb::new(s.center - s.radius, s.center + s.radius),
            Primitive::Polygon(p) => Aabb::around(p.vertices().iter().copied()),
            other => panic!("{other:?} in balls"),
        }
    }

    #[test]
    fn the_first_direction_is_the_published_one() {
        let first = child_directions()[0];
        assert_eq!(round_point(first), Vec3::new(0.408248, 0.408248, 0.816497));
    }

    #[test]
    fn counts_follow_the_powers_of_nine() {
        for (size, count) in [(0, 2), (1, 11), (2, 92), (4, 7382)] {
            assert_eq!(generate(size).objects.len(), count);
        }
    }

    #[test]
    fn size_4_has_the_papers_share_of_bounding_boxes() {
        let parts = generate(4);
        assert_eq!(parts.lights.len(), 3);
        let boxes: Vec<_> = parts.objects.iter().map(bounds).collect();
        let scene = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(b));
        let filled: f64 = boxes.iter().map(Aabb::volume).sum();
        let percent = 100.0 * filled / scene.volume();
        assert!((percent - 0.1949).abs() < 0.00005, "{percent}");
    }

    #[test]
    fn a_child_touches_its_parent_from_outside() {
        let parts = generate(1);
        for child in &parts.objects[2..] {
            let Primitive::Sphere(s) = child else {
                panic!("{child:?}")
            };
            assert!((s.center.length() - ROOT_RADIUS * 4.0 / 3.0).abs() < 2e-6);
            assert_eq!(s.radius, 0.166667);
        }
    }
}
