//! A scene as triangles and spheres for the graphics card, relative to its center.

use crate::geometry::Vec3;
use crate::primitive::{Cone, Primitive};
use crate::scene::Scene;

/// A corner of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Vertex {
    pub place: [f32; 3],
    pub normal: [f32; 3],
    pub color: [u8; 4],
}

/// A sphere.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Ball {
    pub center: [f32; 3],
    pub radius: f32,
    pub color: [u8; 4],
}

/// What is drawn of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneMesh {
    /// Three for a triangle.
    pub vertices: Vec<Vertex>,
    pub balls: Vec<Ball>,
    /// Objects that would not fit onto the graphics card.
    pub left_out: usize,
}

/// Sides of a drawn cone or cylinder.
const CONE_SIDES: u32 = 20;

/// Buffers may take 256 MiB, a vertex takes 28 bytes.
const MOST_VERTICES: usize = 9_000_000;

/// What is drawn of a scene, relative to `center`.
pub fn scene_mesh(scene: &Scene, center: Vec3) -> SceneMesh {
    let mut mesh = SceneMesh::default();
    for (number, object) in (0u32..).zip(scene.objects()) {
        if mesh.vertices.len() > MOST_VERTICES || mesh.balls.len() > MOST_VERTICES {
            mesh.left_out += 1;
            continue;
        }
        let color = srgb8(scene.material(number).color);
        let mut triangle = |corners: [Vec3; 3]| {
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or(Vec3::Z).as_vec3();
            mesh.vertices.extend(corners.map(|corner| Vertex {
                place: (corner - center).as_vec3().to_array(),
                normal: normal.to_array(),
                color,
            }));
        };
        match object {
            Primitive::Sphere(sphere) => mesh.balls.push(Ball {
                center: (sphere.center - center).as_vec3().to_array(),
                radius: sphere.radius as f32,
                color,
            }),
            Primitive::Triangle(t) => triangle(t.vertices),
            Primitive::Polygon(polygon) => {
                let v = polygon.vertices();
                for corners in polygon.triangles() {
                    triangle(corners.map(|i| v[i as usize]));
                }
            }
            Primitive::Cone(cone) => cone_triangles(cone, center, color, &mut mesh.vertices),
        }
    }
    mesh
}

/// The lateral surface of a cone, with smooth normals.
fn cone_triangles(cone: &Cone, center: Vec3, color: [u8; 4], out: &mut Vec<Vertex>) {
    let axis = (cone.apex() - cone.base()).normalize_or(Vec3::Z);
    let (side, other) = axis.any_orthonormal_pair();
    let rim = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(CONE_SIDES);
        let (sin, cos) = libm::sincos(angle);
        let outwards = side * cos + other * sin;
        [
            (cone.base() + outwards * cone.base_radius(), outwards),
            (cone.apex() + outwards * cone.apex_radius(), outwards),
        ]
    };
    for k in 0..CONE_SIDES {
        let ([a, b], [c, d]) = (rim(k), rim(k + 1));
        out.extend([a, c, b, b, c, d].map(|(place, normal)| Vertex {
            place: (place - center).as_vec3().to_array(),
            normal: normal.as_vec3().to_array(),
            color,
        }));
    }
}

/// A material's color; black ones are lifted, or they could not be told from the ground.
fn srgb8(linear: Vec3) -> [u8; 4] {
    let encode = |v: f64| egui::ecolor::gamma_u8_from_linear_f32(v.max(0.03) as f32);
    [encode(linear.x), encode(linear.y), encode(linear.z), 255]
}

/// The center that a scene is drawn around.
pub fn center_of(scene: &Scene) -> Vec3 {
    let bounds = scene.bounds();
    if bounds.is_empty() {
        Vec3::ZERO
    } else {
        bounds.center()
    }
}
