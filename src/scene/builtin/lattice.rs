//! `lattice`: balls at the points of a cubic lattice, joined by rods. Objects are spread evenly, and most rays
//! pass many of them.

use super::entry::{Builtin, SPD_BACKGROUND};
use crate::geometry::Vec3;
use crate::primitive::{Cone, Primitive, Sphere};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "lattice",
    about: "Balls of a cubic lattice, joined by rods: evenly spread objects",
    default_size: 8,
    sizes: 1..=32,
    generate,
};

/// Radii of balls and of rods, relative to the distance of neighboring balls.
const RADII: [f64; 2] = [0.16, 0.04];

fn material(color: Vec3, specular: f64) -> Material {
    Material {
        color,
        diffuse: 0.8,
        specular,
        shine: 40.0,
        ..Material::default()
    }
}

/// Generates (`size` + 1)³ balls and the rods between neighbors, in a cube from −1 to 1.
fn generate(size: u32) -> SceneParts {
    let step = 2.0 / f64::from(size);
    let point = |at: [u32; 3]| Vec3::from_array(at.map(|i| f64::from(i) * step - 1.0));
    let [ball, rod] = RADII.map(|radius| radius * step);
    let (mut objects, mut material_of) = (Vec::new(), Vec::new());
    let mut add = |object: Primitive, material| {
        objects.push(object);
        material_of.push(material);
    };
    for z in 0..=size {
        for y in 0..=size {
            for x in 0..=size {
                let at = [x, y, z];
                let center = point(at);
                let sphere = Sphere::new(center, ball);
                add(
                    Primitive::Sphere(sphere.expect("the radius is positive")),
                    0,
                );
                for axis in (0..3).filter(|&axis| at[axis] < size) {
                    let mut next = at;
                    next[axis] += 1;
                    let cone = Cone::new(center, rod, point(next), rod);
                    add(Primitive::Cone(cone.expect("a rod has a length")), 1);
                }
            }
        }
    }
    let materials = vec![
        material(Vec3::new(0.9, 0.6, 0.3), 0.3),
        material(Vec3::new(0.5, 0.6, 0.7), 0.0),
    ];
    SceneParts {
        name: format!("lattice:{size}"),
        objects,
        material_of,
        materials,
        lights: [Vec3::new(4.0, -5.0, 6.0), Vec3::new(-6.0, -3.0, 2.0)]
            .map(|position| Light {
                position,
                color: None,
            })
            .to_vec(),
        background: SPD_BACKGROUND,
        camera: Camera {
            from: Vec3::new(2.2, -3.0, 1.7),
            at: Vec3::ZERO,
            up: Vec3::Z,
            angle: 45.0,
            near: 0.1,
            resolution: [512, 512],
        },
        notes: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_neighbors_is_joined_once() {
        for size in [1, 3] {
            let (n, scene) = (size as usize, generate(size));
            let of = |material| scene.material_of.iter().filter(|m| **m == material).count();
            assert_eq!(of(0), (n + 1).pow(3));
            assert_eq!(of(1), 3 * n * (n + 1).pow(2));
        }
    }
}
