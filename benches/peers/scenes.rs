//! The scenes of the comparison. All coordinates are representable as `f32`, so that every peer has the
//! same geometry.

use bspscope::geometry::Vec3;
use bspscope::primitive::{Polygon, Primitive, Sphere, Triangle};
use bspscope::scene::builtin::generate;
use bspscope::scene::{Camera, Material, Scene, SceneParts};

/// A scene, and the target of its shadow rays.
pub struct Subject {
    pub name: &'static str,
    pub scene: Scene,
    pub light: Vec3,
}

/// A scene's name and generator.
type Entry = (&'static str, fn() -> Subject);

/// All scenes.
pub const SCENES: [Entry; 5] = [
    ("tetra", tetra),
    ("terrain", hills),
    ("balls", balls),
    ("balls-tessellated", balls_tessellated),
    ("room", room),
];

fn rounded(v: Vec3) -> Vec3 {
    v.as_vec3().as_dvec3()
}

fn triangle(vertices: [Vec3; 3]) -> Option<Primitive> {
    let triangle = Triangle::new(vertices.map(rounded), None).ok()?;
    Some(Primitive::Triangle(triangle))
}

fn subject(name: &'static str, objects: Vec<Primitive>, camera: Camera, light: Vec3) -> Subject {
    let parts = SceneParts {
        name: name.into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera,
        notes: Vec::new(),
    };
    Subject {
        name,
        scene: Scene::new(parts),
        light,
    }
}

/// Generated terrain of a million triangles.
fn hills() -> Subject {
    Subject {
        name: "terrain",
        scene: Scene::new(generate("terrain", Some(707)).expect("a generator")),
        light: Vec3::new(1.5, -1.0, 1.0),
    }
}

/// The paper's scene: 4096 triangles.
fn tetra() -> Subject {
    let parts = generate("tetra", None).expect("a generator");
    let objects = parts.objects.iter().filter_map(|object| match object {
        Primitive::Triangle(t) => triangle(t.vertices),
        _ => None,
    });
    let light = parts.lights[0].position;
    subject("tetra", objects.collect(), parts.camera, light)
}

/// An architectural scene: the paper's room, with its polygons as triangles.
fn room() -> Subject {
    let parts = generate("room", None).expect("a generator");
    let objects = parts.objects.iter().flat_map(|object| match object {
        Primitive::Triangle(t) => vec![t.vertices],
        Primitive::Polygon(p) => {
            let vertices = p.vertices();
            let corners = |numbers: [u32; 3]| numbers.map(|i| vertices[i as usize]);
            Polygon::triangulate(vertices)
                .into_iter()
                .map(corners)
                .collect()
        }
        _ => Vec::new(),
    });
    let light = parts.lights[0].position;
    subject(
        "room",
        objects.filter_map(triangle).collect(),
        parts.camera,
        light,
    )
}

/// The spheres of the paper's scene, 7381, without its floor.
fn spheres() -> (Vec<Sphere>, Camera, Vec3) {
    let parts = generate("balls", None).expect("a generator");
    let spheres = parts.objects.iter().filter_map(|object| match object {
        Primitive::Sphere(s) => {
            let radius = f64::from(s.radius as f32);
            Sphere::new(rounded(s.center), radius).ok()
        }
        _ => None,
    });
    let light = parts.lights[0].position;
    (spheres.collect(), parts.camera, light)
}

fn balls() -> Subject {
    let (spheres, camera, light) = spheres();
    let objects = spheres.into_iter().map(Primitive::Sphere).collect();
    subject("balls", objects, camera, light)
}

/// The same spheres as icosahedra divided twice, 320 triangles each: 2.4 million.
fn balls_tessellated() -> Subject {
    let (spheres, camera, light) = spheres();
    let unit = unit_sphere(2);
    let objects = spheres.iter().flat_map(|sphere| {
        let place = |v: Vec3| sphere.center + sphere.radius * v;
        unit.iter().filter_map(move |t| triangle(t.map(place)))
    });
    subject("balls-tessellated", objects.collect(), camera, light)
}

/// Returns an icosahedron whose triangles are repeatedly divided in four, with vertices on the unit sphere.
fn unit_sphere(divisions: u32) -> Vec<[Vec3; 3]> {
    let p = (1.0 + 5f64.sqrt()) / 2.0;
    let corners = [
        [-1.0, p, 0.0],
        [1.0, p, 0.0],
        [-1.0, -p, 0.0],
        [1.0, -p, 0.0],
        [0.0, -1.0, p],
        [0.0, 1.0, p],
        [0.0, -1.0, -p],
        [0.0, 1.0, -p],
        [p, 0.0, -1.0],
        [p, 0.0, 1.0],
        [-p, 0.0, -1.0],
        [-p, 0.0, 1.0],
    ]
    .map(|corner| Vec3::from(corner).normalize());
    let faces = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let mut triangles: Vec<_> = faces.iter().map(|f| f.map(|i: usize| corners[i])).collect();
    for _ in 0..divisions {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [x, y, z] = [a + b, b + c, c + a].map(Vec3::normalize);
                [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
            })
            .collect();
    }
    triangles
}
