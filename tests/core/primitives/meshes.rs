//! Closed meshes and common edges lose no ray.

use super::*;

/// A closed mesh about the origin: vertices and faces.
fn icosahedron() -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let mut vertices = Vec::new();
    for (a, b) in [(1.0, phi), (1.0, -phi), (-1.0, phi), (-1.0, -phi)] {
        vertices.push(Vec3::new(0.0, a, b));
        vertices.push(Vec3::new(a, b, 0.0));
        vertices.push(Vec3::new(b, 0.0, a));
    }
    // Turned, so that no coordinate is a round number.
    let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.9);
    let vertices: Vec<_> = vertices.into_iter().map(|v| turn * v).collect();
    let adjacent = |i: usize, j: usize| (vertices[i].distance(vertices[j]) - 2.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for i in 0..12 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                if adjacent(i, j) && adjacent(j, k) && adjacent(k, i) {
                    faces.push([i, j, k]);
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    (vertices, faces)
}

fn tetrahedron() -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let v = Vec3::new;
    let vertices = vec![
        v(1.0, 1.1, 0.9),
        v(-1.0, -1.2, 1.0),
        v(-0.9, 1.0, -1.0),
        v(1.0, -1.0, -1.3),
    ];
    (vertices, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
}

fn check_no_leaks(
    mesh: (Vec<Vec3>, Vec<[usize; 3]>),
    face: impl Fn([Vec3; 3], usize) -> Box<dyn Shape>,
) {
    let (vertices, faces) = mesh;
    let shapes: Vec<_> = faces
        .iter()
        .enumerate()
        .map(|(i, f)| face(f.map(|k| vertices[k]), i))
        .collect();
    let mut random = Random(7);
    for i in 0..20_000 {
        let f = faces[random.below(faces.len())].map(|k| vertices[k]);
        let target = if i % 2 == 0 {
            f[0]
        } else {
            f[0] + random.within(0.0, 1.0) * (f[1] - f[0])
        };
        // A line through a point well inside and one on an edge meets a convex mesh.
        let inner = 0.3 * random.unit() * random.within(0.0, 1.0);
        let direction = (target - inner).normalize();
        for origin in [inner, inner - 10.0 * direction, target + 9.0 * direction] {
            let direction = (target - origin).normalize();
            let ray = Ray::new(origin, direction);
            let hit = shapes
                .iter()
                .any(|s| s.intersect(&ray, f64::INFINITY).is_some());
            assert!(hit, "{ray:?}");
        }
    }
}

#[test]
fn closed_meshes_of_triangles_leak_no_ray() {
    for mesh in [icosahedron(), tetrahedron()] {
        check_no_leaks(mesh, |v, _| Box::new(Triangle::new(v, None).unwrap()));
    }
}

#[test]
fn closed_meshes_of_polygons_leak_no_ray_nor_do_mixed_ones() {
    for mesh in [icosahedron(), tetrahedron()] {
        let polygon = |v: [Vec3; 3]| Polygon::new(v.to_vec(), None).unwrap();
        check_no_leaks(mesh.clone(), |v, _| Box::new(polygon(v)));
        check_no_leaks(mesh, |v, i| {
            if i % 2 == 0 {
                Box::new(polygon(v))
            } else {
                Box::new(Triangle::new(v, None).unwrap())
            }
        });
    }
}

#[test]
fn coplanar_polygons_lose_no_ray_on_their_common_edge() {
    let mut random = Random(11);
    let (u, v) = Vec3::new(0.3, 0.5, 0.7).normalize().any_orthonormal_pair();
    let at = |x: f64, y: f64| Vec3::new(1.0, 2.0, 3.0) + x * u + y * v;
    let (p, q) = (at(0.1, -0.9), at(-0.2, 0.8));
    let left = Polygon::new(vec![p, q, at(-2.0, 0.9), at(-1.5, -1.1)], None).unwrap();
    let right = Polygon::new(vec![q, p, at(1.0, -1.0), at(0.2, -0.1), at(1.3, 2.0)], None).unwrap();
    for _ in 0..20_000 {
        let target = p + random.within(0.01, 0.99) * (q - p);
        let direction = random.unit();
        let ray = Ray::new(target - 5.0 * direction, direction);
        let hit = |s: &Polygon| s.intersect(&ray, f64::INFINITY).is_some();
        assert!(hit(&left) || hit(&right), "{ray:?}");
    }
}
