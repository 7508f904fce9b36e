//! `rings`: a pyramid of interlocked rings (E. Haines, Standard Procedural Databases).

use super::entry::{Builtin, SPD_BACKGROUND, margin_note};
use super::percent_g::{round_g, round_point};
use crate::geometry::Vec3;
use crate::primitive::{Cone, Polygon, Primitive, Sphere};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;
use std::f64::consts::PI;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "rings",
    about: "Groups of six interlocked five-sided rings of spheres and cylinders in front of a wall",
    default_size: 7,
    sizes: 1..=20,
    generate,
};

/// Radius of the tubes and of the spheres at their joints.
const TUBE_RADIUS: f64 = 0.07412;
/// Distance of the joints from the center of the group, whose radius is about 1.
const RING_RADIUS: f64 = 1.0 / 1.07412;

/// Generates the wall, and 30 spheres and 30 cylinders for each of Σ i² groups, i from 1 to `size`.
fn generate(size: u32) -> SceneParts {
    let spacing = 1.0 / libm::sin(PI / 8.0);
    let layers = f64::from(size);
    let mut objects = vec![wall(spacing, layers)];
    let mut material_of = vec![0];
    let rings = six_rings();
    for layer in 0..i32::try_from(size).expect("sizes are small") {
        let y = spacing * f64::from(layer + 1);
        for x in (-layer..=layer).step_by(2) {
            for z in (-layer..=layer).step_by(2) {
                let center = Vec3::new(f64::from(x), y, f64::from(z));
                for (color, ring) in (1..).zip(&rings) {
                    add_ring(ring.map(|joint| round_point(center + joint)), &mut objects);
                    material_of.resize(objects.len(), color);
                }
            }
        }
    }
    SceneParts {
        name: format!("rings:{size}"),
        objects,
        material_of,
        materials: materials(),
        lights: [
            (3.0, -spacing, 3.0),
            (-4.0, -spacing, 1.0),
            (2.0, -spacing, -4.0),
        ]
        .map(|position| Light {
            position: round_point(position.into()),
            color: None,
        })
        .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: round_point(Vec3::new(-1.0, -spacing, 0.5)),
            at: Vec3::new(-1.0, 0.0, 0.5),
            up: Vec3::Z,
            angle: 45.0,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![margin_note()],
    }
}

/// Returns white for the wall, then one color for each ring of a group.
fn materials() -> Vec<Material> {
    let wall = Material {
        color: Vec3::ONE,
        diffuse: 1.0,
        specular: 0.0,
        shine: 100_000.0,
        transmittance: 0.0,
        index_of_refraction: 0.0,
    };
    let ring = |color: Vec3| Material {
        color,
        diffuse: 0.5,
        specular: 0.2,
        shine: 3.0827,
        transmittance: 0.0,
        index_of_refraction: 0.0,
    };
    let colors = [
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::ONE - Vec3::X,
        Vec3::ONE - Vec3::Y,
        Vec3::ONE - Vec3::Z,
    ];
    std::iter::once(wall).chain(colors.map(ring)).collect()
}

/// Returns a square behind the last layer that fills the view.
fn wall(spacing: f64, layers: f64) -> Primitive {
    let y = spacing * (layers + 1.0);
    let half = 1.01 * (layers + 2.0) * spacing * libm::tan(PI / 8.0);
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
        .map(|(x, z)| round_point(Vec3::new(x * half - 1.0, y, z * half + 0.5)));
    let square = Polygon::new(corners.to_vec(), None);
    Primitive::Polygon(square.expect("a square is a polygon"))
}

/// Returns the joints of the six pentagons of a group around the origin: the faces of half a
/// dodecahedron, one upright and five around it.
fn six_rings() -> [[Vec3; 5]; 6] {
    let degrees = |angle: f64| angle * PI / 180.0;
    let upright: [Vec3; 5] = std::array::from_fn(|i| {
        let (sin, cos) = libm::sincos(degrees(72.0 * i as f64));
        Vec3::new(cos, sin, 0.0) * RING_RADIUS
    });
    let tilt = 2.0 * libm::acos(libm::cos(degrees(60.0)) / libm::sin(degrees(36.0)));
    std::array::from_fn(|ring| {
        if ring == 0 {
            return upright;
        }
        let (tilt_sin, tilt_cos) = libm::sincos(tilt);
        let (turn_sin, turn_cos) = libm::sincos(degrees(36.0 * (2.0 * ring as f64 - 1.0)));
        upright.map(|p| {
            let (x, y, z) = (p.x, p.y * tilt_cos, p.y * tilt_sin);
            Vec3::new(x * turn_cos - y * turn_sin, x * turn_sin + y * turn_cos, z)
        })
    })
}

/// Adds a sphere at every joint and a cylinder from it to the previous joint.
fn add_ring(joints: [Vec3; 5], objects: &mut Vec<Primitive>) {
    let radius = round_g(TUBE_RADIUS);
    for (i, &joint) in joints.iter().enumerate() {
        let before = joints[(i + 4) % 5];
        let sphere = Sphere::new(joint, radius).expect("the radius is positive");
        let tube = Cone::new(joint, radius, before, radius).expect("joints lie apart");
        objects.extend([Primitive::Sphere(sphere), Primitive::Cone(tube)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::primitive::Shape;
    use crate::scene::Cylinders;

    #[test]
    fn counts_are_those_of_the_paper() {
        assert_eq!(generate(7).objects.len(), 8401);
        assert_eq!(generate(1).objects.len(), 61);
        let polygons = Cylinders::Polygons(10).apply(generate(7));
        assert_eq!(polygons.objects.len(), 46201);
        assert_eq!(polygons.lights.len(), 3);
    }

    #[test]
    fn the_first_sphere_is_the_published_one() {
        let parts = generate(7);
        let first = parts.objects.iter().find_map(|object| match object {
            Primitive::Sphere(s) => Some(*s),
            _ => None,
        });
        let first = first.unwrap();
        assert_eq!(first.center, Vec3::new(0.930995, 2.61313, 0.0));
        assert_eq!(first.radius, 0.07412);
    }

    #[test]
    fn size_7_with_prisms_has_the_papers_share_of_bounding_boxes() {
        let parts = Cylinders::Polygons(10).apply(generate(7));
        let boxes: Vec<_> = parts.objects.iter().map(Shape::bounds).collect();
        let scene = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(b));
        let filled: f64 = boxes.iter().map(Aabb::volume).sum();
        let percent = 100.0 * filled / scene.volume();
        assert!((percent - 65.603).abs() < 0.0005, "{percent}");
    }
}
