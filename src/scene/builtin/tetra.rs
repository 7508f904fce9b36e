//! `tetra`: a tetrahedral pyramid (E. Haines, Standard Procedural Databases).

use super::entry::{Builtin, SPD_BACKGROUND, margin_note};
use super::percent_g::round_point;
use crate::geometry::Vec3;
use crate::primitive::{Primitive, Triangle};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "tetra",
    about: "A tetrahedron of tetrahedra, mostly empty: only triangles, no floor",
    default_size: 6,
    sizes: 1..=9,
    generate,
};

/// The corners of a cube that span a tetrahedron: those whose signs have the product +1.
const CORNERS: [Vec3; 4] = [
    Vec3::new(-1.0, -1.0, 1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::new(1.0, -1.0, -1.0),
    Vec3::new(1.0, 1.0, 1.0),
];
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [3, 2, 1], [2, 3, 0], [1, 0, 3]];

/// Generates 4^`size` triangles.
fn generate(size: u32) -> SceneParts {
    let mut objects = Vec::with_capacity(4usize.pow(size));
    add_tetrahedra(Vec3::ZERO, 1.0, size - 1, &mut objects);
    SceneParts {
        name: format!("tetra:{size}"),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material {
            color: Vec3::new(1.0, 0.2, 0.2),
            diffuse: 1.0,
            specular: 0.0,
            shine: 100_000.0,
            transmittance: 0.0,
            index_of_refraction: 0.0,
        }],
        lights: vec![Light {
            position: Vec3::new(2.0, -18.0, -5.0),
            color: None,
        }],
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(1.022846, -3.177154, -2.174512),
            at: Vec3::new(-0.004103, -0.004103, 0.216539),
            up: Vec3::new(-0.816497, -0.816497, 0.816497),
            angle: 45.0,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: vec![margin_note()],
    }
}

/// Adds the tetrahedra within a cube that is halved `halvings` times.
fn add_tetrahedra(center: Vec3, half_width: f64, halvings: u32, objects: &mut Vec<Primitive>) {
    if halvings > 0 {
        let half = half_width * 0.5;
        for corner in CORNERS {
            add_tetrahedra(center + corner * half, half, halvings - 1, objects);
        }
        return;
    }
    let vertices = CORNERS.map(|corner| round_point(center + corner * half_width));
    for face in FACES {
        let triangle = Triangle::new(face.map(|i| vertices[i]), None);
        objects.push(Primitive::Triangle(
            triangle.expect("a face of a tetrahedron has area"),
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;

    #[test]
    fn counts_are_powers_of_four() {
        for (size, count) in [(1, 4), (2, 16), (6, 4096)] {
            assert_eq!(generate(size).objects.len(), count);
        }
    }

    #[test]
    fn size_6_has_the_papers_share_of_bounding_boxes() {
        let boxes: Vec<_> = generate(6)
            .objects
            .iter()
            .map(|object| match object {
                Primitive::Triangle(t) => Aabb::around(t.vertices),
                other => panic!("{other:?} in tetra"),
            })
            .collect();
        let scene = boxes.iter().fold(Aabb::EMPTY, |all, b| all.union(b));
        assert_eq!(scene, Aabb::new(Vec3::splat(-1.0), Vec3::splat(1.0)));
        let filled: f64 = boxes.iter().map(Aabb::volume).sum();
        assert!((100.0 * filled / scene.volume() - 12.5).abs() < 0.001);
    }
}
