//! Triangles.

use super::*;

/// Distance of a point from a triangle (Ericson, Real-time collision detection, 2005, 5.1.5).
pub fn distance_to_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize();
    let segment = |a: Vec3, b: Vec3| {
        let s = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a + s.clamp(0.0, 1.0) * (b - a))
    };
    let inside = |a: Vec3, b: Vec3| (b - a).cross(p - a).dot(normal) >= 0.0;
    if inside(a, b) && inside(b, c) && inside(c, a) {
        (p - a).dot(normal).abs()
    } else {
        segment(a, b).min(segment(b, c)).min(segment(c, a))
    }
}

pub fn triangles() -> Vec<Triangle> {
    let v = Vec3::new;
    [
        [Vec3::ZERO, Vec3::X, Vec3::Y],
        [v(1.0, 2.0, 3.0), v(-2.0, 0.5, 1.0), v(0.3, -4.0, 2.2)],
        [v(2.0, -1.0, 0.3), v(2.0, 5.0, 0.7), v(2.0, 1.0, 6.0)],
        [v(0.0, 0.0, 1.0), v(10.0, 3.0, 1.5), v(9.0, 2.9, 1.6)],
    ]
    .map(|t| Triangle::new(t, None).unwrap())
    .to_vec()
}

#[test]
fn a_triangle_is_met_from_both_sides_and_on_its_edges() {
    let t = Triangle::new([Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0], None).unwrap();
    let down = |x: f64, y: f64| {
        let ray = Ray::new(Vec3::new(x, y, 3.0), -Vec3::Z);
        t.intersect(&ray, f64::INFINITY)
    };
    assert_eq!(down(0.5, 0.5), Some(3.0));
    assert_eq!(down(1.0, 1.0), Some(3.0));
    assert_eq!(down(0.0, 0.0), Some(3.0));
    assert_eq!(down(1.1, 1.0), None);
    let up = Ray::new(Vec3::new(0.5, 0.5, -3.0), Vec3::Z * 0.5);
    assert_eq!(t.intersect(&up, f64::INFINITY), Some(6.0));
    assert_eq!(t.surface(&up, 6.0).normal, Vec3::Z);
    let along = Ray::new(Vec3::new(-1.0, 0.5, 0.0), Vec3::X);
    assert_eq!(t.intersect(&along, f64::INFINITY), None);
}

#[test]
fn normals_of_a_triangle_are_interpolated() {
    let vertices = [Vec3::ZERO, Vec3::X * 2.0, Vec3::Y * 2.0];
    let normals = [Vec3::Z * 5.0, Vec3::new(3.0, 0.0, 4.0), Vec3::ZERO];
    let t = Triangle::new(vertices, Some(normals)).unwrap();
    let unit = Vec3::new(0.6, 0.0, 0.8);
    assert!((t.normals.as_ref().unwrap()[1] - unit).length() < 1e-15);
    assert_eq!(t.normals.as_ref().unwrap()[2], Vec3::Z);
    let ray = Ray::new(Vec3::new(1.0, 0.0, 1.0), -Vec3::Z);
    let surface = t.surface(&ray, 1.0);
    let expected = (Vec3::Z + unit).normalize();
    assert!((surface.shading_normal - expected).length() < 1e-15);
    assert_eq!(surface.normal, Vec3::Z);
}

#[test]
fn triangles_without_area_are_refused_and_needles_are_not() {
    let (o, x) = (Vec3::ZERO, Vec3::X);
    let new = |v: [Vec3; 3]| Triangle::new(v, None).map(|t| t.normal());
    assert_eq!(new([o, x, x]), Err(ShapeError::ZeroArea));
    assert_eq!(new([o, o, o]), Err(ShapeError::ZeroArea));
    let third = Vec3::new(1.0, 2.0, 3.0) / 3.0;
    assert_eq!(new([o, third, third * 3.0]), Err(ShapeError::ZeroArea));
    assert_eq!(new([o, x, x * f64::NAN]), Err(ShapeError::NotFinite));
    assert_eq!(new([o, x, Vec3::new(0.5, 1e-13, 0.0)]), Ok(Vec3::Z));
    assert_eq!(new([o, x * 1e-170, Vec3::Y * 1e-170]), Ok(Vec3::Z));
}

#[test]
fn hits_of_triangles_lie_on_them_and_in_their_bounds() {
    for (i, t) in triangles().iter().enumerate() {
        check_hits(t, |p| distance_to_triangle(p, t.vertices), i as u64);
        check_tightness(t, t.vertices.into_iter(), 1e-14);
    }
}

#[test]
fn triangles_overlap_the_cells_that_hold_their_points() {
    let mut told_apart = 0;
    for (i, t) in triangles().iter().enumerate() {
        let [a, b, c] = t.vertices;
        let inside = |r: &mut Random| {
            let (mut u, mut v) = (r.within(0.0, 1.0), r.within(0.0, 1.0));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            a + u * (b - a) + v * (c - a)
        };
        let distance = |p: Vec3| distance_to_triangle(p, t.vertices);
        told_apart += check_overlaps(t, inside, distance, i as u64);
    }
    assert!(told_apart > 1000, "{told_apart}");
}

#[test]
fn a_ray_within_a_triangles_plane_hits_nothing() {
    // Found by random search: the edge functions were rounding alone, and of one sign by chance.
    let at = Vec3::new;
    let cases = [
        (
            [at(3.0, -4.0, -4.0), at(0.0, -3.0, 0.0), at(-1.0, -4.0, 0.0)],
            at(9.015065080795893, -0.5075325403979463, -6.522597621193839),
            at(-2.0, 1.0, 3.0),
        ),
        (
            [
                at(-4.0, 4.0, -1.0),
                at(-2.0, 0.0, -3.0),
                at(-1.0, -2.0, 2.0),
            ],
            at(-2.3498141349877066, 0.6996282699754128, -12.098884809926238),
            at(1.0, -2.0, 6.0),
        ),
    ];
    for (vertices, origin, direction) in cases {
        let ray = Ray::new(origin, direction);
        let triangle = Triangle::new(vertices, None).unwrap();
        assert_eq!(triangle.intersect(&ray, f64::INFINITY), None);
        let polygon = Polygon::new(vertices.to_vec(), None).unwrap();
        assert_eq!(polygon.intersect(&ray, f64::INFINITY), None);
    }
}
