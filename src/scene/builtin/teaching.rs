//! `teaching`: a small scene with every kind of primitive, small enough to follow every step in the
//! tree.

use super::entry::Builtin;
use super::percent_g::round_point;
use crate::geometry::Vec3;
use crate::primitive::{Cone, Polygon, Primitive, Sphere, Triangle};
use crate::scene::camera::Camera;
use crate::scene::material::{Light, Material};
use crate::scene::parts::SceneParts;

pub(super) const BUILTIN: Builtin = Builtin {
    name: "teaching",
    about: "Twelve objects of every kind, with a mirror and a glass sphere, to follow a tree at work",
    default_size: 1,
    sizes: 1..=1,
    generate,
};

/// Generates a floor at z = 0 and eleven objects on it, whose bounding boxes do not touch each
/// other.
///
/// The directions of slanted objects and vertex normals are Pythagorean (such as 0.6, 0.8), so that
/// all numbers are short and normals have unit length.
fn generate(size: u32) -> SceneParts {
    let (materials, objects): (Vec<_>, Vec<_>) = pieces().into_iter().unzip();
    SceneParts {
        name: format!("teaching:{size}"),
        material_of: (0..).take(objects.len()).collect(),
        objects,
        materials,
        lights: vec![
            Light {
                position: Vec3::new(6.0, -9.0, 12.0),
                color: None,
            },
            Light {
                position: Vec3::new(-9.0, -6.0, 7.0),
                color: Some(Vec3::new(0.42, 0.48, 0.6)),
            },
        ],
        background: Vec3::new(0.55, 0.68, 0.84),
        camera: Camera {
            from: Vec3::new(3.6, -13.5, 9.5),
            at: Vec3::new(-0.6, -0.5, 0.2),
            up: Vec3::Z,
            angle: 45.0,
            near: 1.0,
            resolution: [512, 512],
        },
        notes: Vec::new(),
    }
}

/// Returns the objects, each with its own material.
fn pieces() -> Vec<(Material, Primitive)> {
    vec![
        (matt(0.78, 0.74, 0.66), floor()),
        (mirror(), sphere([-2.2, 0.8, 1.3], 1.3)),
        (glass(), sphere([0.2, -1.5, 0.8], 0.8)),
        (glossy(0.95, 0.5, 0.1), sphere([-1.7, -2.7, 0.5], 0.5)),
        (glossy(0.2, 0.55, 0.8), cone([-4.0, -1.4], 0.5, 1.9, 0.5)),
        (matt(0.35, 0.65, 0.25), cone([0.4, 1.6], 0.8, 2.4, 0.0)),
        (matt(0.75, 0.35, 0.2), cone([3.2, 3.0], 1.0, 2.0, 0.55)),
        (matt(0.95, 0.8, 0.15), star()),
        (glossy(0.6, 0.3, 0.65), hexagon()),
        (glossy(0.15, 0.6, 0.55), curved_screen()),
        (matt(0.85, 0.2, 0.25), flat_triangle()),
        (glossy(0.9, 0.55, 0.65), smooth_triangle()),
    ]
}

fn matt(r: f64, g: f64, b: f64) -> Material {
    Material {
        color: Vec3::new(r, g, b),
        diffuse: 0.8,
        ..Material::default()
    }
}

fn glossy(r: f64, g: f64, b: f64) -> Material {
    Material {
        color: Vec3::new(r, g, b),
        diffuse: 0.7,
        specular: 0.2,
        shine: 30.0,
        ..Material::default()
    }
}

fn mirror() -> Material {
    Material {
        color: Vec3::new(0.9, 0.92, 0.95),
        diffuse: 0.1,
        specular: 0.8,
        shine: 200.0,
        ..Material::default()
    }
}

fn glass() -> Material {
    Material {
        color: Vec3::new(0.95, 1.0, 0.97),
        diffuse: 0.05,
        specular: 0.1,
        shine: 200.0,
        transmittance: 0.85,
        index_of_refraction: 1.5,
    }
}

fn sphere(center: [f64; 3], radius: f64) -> Primitive {
    let sphere = Sphere::new(center.into(), radius);
    Primitive::Sphere(sphere.expect("the radius is positive"))
}

/// Returns an upright cone on the floor, given by the radii at its bottom and top.
fn cone([x, y]: [f64; 2], base_radius: f64, height: f64, apex_radius: f64) -> Primitive {
    let base = Vec3::new(x, y, 0.0);
    let apex = Vec3::new(x, y, height);
    let cone = Cone::new(base, base_radius, apex, apex_radius);
    Primitive::Cone(cone.expect("the height is positive"))
}

fn polygon(vertices: Vec<Vec3>, normals: Option<Vec<Vec3>>) -> Primitive {
    let polygon = Polygon::new(vertices, normals);
    Primitive::Polygon(polygon.expect("the vertices lie in a plane and have an area"))
}

fn floor() -> Primitive {
    let corners = [(5.0, 5.0), (-5.0, 5.0), (-5.0, -5.0), (5.0, -5.0)];
    polygon(corners.map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec(), None)
}

/// Returns a concave polygon: a five-pointed star that stands on two of its points.
fn star() -> Primitive {
    let outline = [
        (0.0, 3.08),
        (-0.38, 1.91),
        (-1.62, 1.91),
        (-0.62, 1.18),
        (-1.0, 0.0),
        (0.0, 0.73),
        (1.0, 0.0),
        (0.62, 1.18),
        (1.62, 1.91),
        (0.38, 1.91),
    ];
    polygon(outline.map(|(x, z)| Vec3::new(x, 4.0, z)).to_vec(), None)
}

/// Returns a convex polygon that is not aligned with the axes.
fn hexagon() -> Primitive {
    let outline = [
        (1.0, 0.87),
        (0.5, 1.74),
        (-0.5, 1.74),
        (-1.0, 0.87),
        (-0.5, 0.0),
        (0.5, 0.0),
    ];
    let place = |(along, z)| round_point(Vec3::new(3.3 + 0.8 * along, 0.2 + 0.6 * along, z));
    polygon(outline.map(place).to_vec(), None)
}

/// Returns a flat polygon whose vertex normals make it look like part of a column.
fn curved_screen() -> Primitive {
    let (left, right) = (Vec3::new(0.28, -0.96, 0.0), Vec3::new(0.96, -0.28, 0.0));
    let vertices = vec![
        Vec3::new(-4.6, 3.2, 0.0),
        Vec3::new(-3.0, 4.4, 0.0),
        Vec3::new(-3.0, 4.4, 2.8),
        Vec3::new(-4.6, 3.2, 2.8),
    ];
    polygon(vertices, Some(vec![left, right, right, left]))
}

fn flat_triangle() -> Primitive {
    let vertices = [
        Vec3::new(2.0, -2.2, 0.0),
        Vec3::new(3.6, -1.4, 0.0),
        Vec3::new(2.7, -1.5, 1.6),
    ];
    let triangle = Triangle::new(vertices, None);
    Primitive::Triangle(triangle.expect("the triangle has an area"))
}

fn smooth_triangle() -> Primitive {
    let vertices = [
        Vec3::new(-3.6, -4.0, 0.0),
        Vec3::new(-2.2, -3.4, 0.0),
        Vec3::new(-2.9, -3.6, 1.3),
    ];
    let normals = [
        Vec3::new(-0.6, -0.8, 0.0),
        Vec3::new(0.8, -0.6, 0.0),
        Vec3::new(0.0, -0.6, 0.8),
    ];
    let triangle = Triangle::new(vertices, Some(normals));
    Primitive::Triangle(triangle.expect("the triangle has an area"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::primitive::{PrimitiveKind, Shape};

    /// Tolerance for rounding in the bounds of primitives.
    const SLACK: f64 = 1e-6;

    fn bounds() -> Vec<Aabb> {
        generate(1).objects.iter().map(Shape::bounds).collect()
    }

    #[test]
    fn every_kind_of_primitive_is_there() {
        let parts = generate(1);
        for kind in PrimitiveKind::ALL {
            assert!(parts.objects.iter().any(|o| o.kind() == kind), "{kind:?}");
        }
        let materials = &parts.materials;
        assert!(materials.iter().any(|m| m.specular >= 0.8));
        assert!(materials.iter().any(|m| m.transmittance >= 0.85));
        assert!(parts.lights.iter().any(|l| l.color.is_some()));
        assert!(parts.lights.iter().any(|l| l.color.is_none()));
    }

    #[test]
    fn objects_stand_on_the_floor() {
        let bounds = bounds();
        let floor = bounds[0].enlarged(SLACK);
        for (number, object) in bounds.iter().enumerate().skip(1) {
            assert!(object.lo.z.abs() < SLACK, "object {number}: {object:?}");
            let foot = Vec3::new(object.hi.x, object.hi.y, 0.0);
            let inside = floor.contains(object.lo) && floor.contains(foot);
            assert!(inside, "object {number}: {object:?}");
        }
    }

    #[test]
    fn no_two_objects_on_the_floor_touch() {
        let bounds = bounds();
        for (i, a) in bounds.iter().enumerate().skip(1) {
            for (j, b) in bounds.iter().enumerate().skip(i + 1) {
                assert!(!a.touches(b), "objects {i} and {j}");
            }
        }
    }

    #[test]
    fn the_whole_scene_lies_in_view() {
        let camera = generate(1).camera;
        let [forward, right, up] = camera.frame().unwrap();
        let limit = libm::tan(camera.angle.to_radians() * 0.5);
        for (number, object) in bounds().iter().enumerate() {
            for corner in object.corners() {
                let to = corner - camera.from;
                let (u, v) = (to.dot(right), to.dot(up));
                let reach = u.abs().max(v.abs()) / to.dot(forward);
                assert!(to.dot(forward) > 0.0, "object {number} lies behind");
                assert!(reach < limit, "object {number}: {reach} beyond {limit}");
            }
        }
    }
}
