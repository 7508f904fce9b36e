//! What every primitive promises, on thousands of random and tough rays and cells.

use bspscope::geometry::{Aabb, Ray, Vec3};
use bspscope::primitive::{Cone, Polygon, Shape, ShapeError, Sphere, Triangle};

/// SplitMix64 (Steele, Lea and Flood, 2014): the same numbers in every run.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    fn point(&mut self, b: &Aabb) -> Vec3 {
        Vec3::new(
            self.within(b.lo.x, b.hi.x),
            self.within(b.lo.y, b.hi.y),
            self.within(b.lo.z, b.hi.z),
        )
    }

    fn unit(&mut self) -> Vec3 {
        loop {
            let v = self.point(&Aabb::new(Vec3::NEG_ONE, Vec3::ONE));
            if (1e-3..=1.0).contains(&v.length()) {
                return v.normalize();
            }
        }
    }
}

fn cube(center: Vec3, half: f64) -> Aabb {
    Aabb::new(center - half, center + half)
}

/// A ray of one of the tough kinds at the box of an object.
fn tough_ray(random: &mut Random, bounds: &Aabb, kind: usize) -> Ray {
    let size = bounds.size().max_element();
    let target = random.point(bounds);
    let away = random.unit();
    match kind % 6 {
        0 => Ray::new(target - 3.0 * size * away, away),
        1 => Ray::new(target, away),
        2 => Ray::new(target - 1e8 * size * away, away),
        3 => {
            // Parallel to an axis, with either sign of zero.
            let mut direction = Vec3::select(away.cmplt(Vec3::ZERO), Vec3::splat(-0.0), Vec3::ZERO);
            direction[random.below(3)] = if random.below(2) == 0 { 1.0 } else { -1.0 };
            Ray::new(target - 3.0 * size * direction, direction)
        }
        4 => {
            let mut direction = away;
            direction[random.below(3)] = 1e-310;
            Ray::new(target - 3.0 * size * direction, direction)
        }
        _ => {
            let length = [1e-250, 1e-6, 1e7, 1e250][random.below(4)];
            Ray::new(target - 3.0 * size * away, length * away)
        }
    }
}

/// Checks thousands of hits; `off` is the distance of a point from the true surface.
fn check_hits(shape: &impl Shape, off: impl Fn(Vec3) -> f64, seed: u64) {
    let bounds = shape.bounds();
    let scale = bounds.magnitude();
    let mut random = Random(seed);
    let mut hits = [0; 6];
    for i in 0..30_000 {
        let ray = tough_ray(&mut random, &bounds, i);
        let Some(t) = shape.intersect(&ray, f64::INFINITY) else {
            continue;
        };
        hits[i % 6] += 1;
        assert!(t >= 0.0 && t.is_finite(), "{ray:?} {t}");
        let surface = shape.surface(&ray, t);
        let reach = scale + ray.origin.length();
        let met = ray.at(t);
        assert!(off(met) <= 1e-12 * reach, "{ray:?} off by {}", off(met));
        assert!(bounds.contains(surface.point), "{ray:?} {surface:?}");
        // The checker's own rounding is a few units of precision itself.
        let allowed = surface.error + 8.0 * f64::EPSILON * scale;
        assert!(off(surface.point) <= allowed, "{ray:?} {surface:?}");
        assert!(surface.error <= 1e-14 * scale);
        assert!((surface.normal.length() - 1.0).abs() < 1e-14);
        assert!((surface.shading_normal.length() - 1.0).abs() < 1e-14);

        // The interval is closed at both ends, and the hit is the first.
        assert_eq!(shape.intersect(&ray, t), Some(t));
        assert_eq!(shape.intersect(&Ray { t_min: t, ..ray }, t), Some(t));
        assert_eq!(shape.intersect(&ray, t.next_down()), None);
    }
    assert!(hits.iter().all(|&n| n > 20), "{hits:?}");
}

/// Checks the overlap with cells of all sizes; `sample` gives points of the solid or surface,
/// `distance` a point's distance from it. Returns how many cells at the bounds were told apart.
fn check_overlaps(
    shape: &impl Shape,
    sample: impl Fn(&mut Random) -> Vec3,
    distance: impl Fn(Vec3) -> f64,
    seed: u64,
) -> usize {
    let bounds = shape.bounds();
    let size = bounds.size().max_element();
    let mut random = Random(seed);
    let (mut apart, mut rejected_within_bounds) = (0, 0);
    for _ in 0..20_000 {
        let point = sample(&mut random);
        let extent = size * 10f64.powf(random.within(-6.0, 0.5));
        let edges = random.point(&Aabb::new(Vec3::ZERO, Vec3::ONE)) * extent;
        // The point is inside, or on a face, an edge or a corner.
        let share = random.point(&Aabb::new(Vec3::splat(-0.5), Vec3::splat(1.5)));
        let share = share.clamp(Vec3::ZERO, Vec3::ONE);
        let lo = (point - edges * share).min(point);
        let cell = Aabb::new(lo, (lo + edges).max(point));
        // Sampled points carry rounding, which the cell takes up.
        assert!(shape.overlaps(&cell.enlarged(1e-15 * bounds.magnitude())));

        let center = random.point(&bounds.enlarged(0.1 * size));
        let half = random.unit().abs() * size * 10f64.powf(random.within(-4.0, -0.3));
        if distance(center) > half.length() * (1.0 + 1e-9) {
            apart += 1;
            let cell = Aabb::new(center - half, center + half);
            assert!(!shape.overlaps(&cell), "{cell:?}");
            rejected_within_bounds += usize::from(bounds.touches(&cell));
        }
    }
    assert!(apart > 1000);
    rejected_within_bounds
}

/// Samples of the surface come close to every face of the bounds, which are hence tight.
fn check_tightness(shape: &impl Shape, points: impl Iterator<Item = Vec3>, tolerance: f64) {
    let bounds = shape.bounds();
    let around = Aabb::around(points);
    assert!((around.lo - bounds.lo).abs().max_element() < tolerance);
    assert!((around.hi - bounds.hi).abs().max_element() < tolerance);
}

/// The bounds of an object's part within a cell hold every one of its points there, and reach no
/// further than some of its points, of which there must be many.
fn check_bounds_within(shape: &impl Shape, points: &[Vec3], random: &mut Random) {
    let bounds = shape.bounds();
    let size = bounds.size().max_element();
    let mut met = 0;
    for _ in 0..200 {
        let half = size * random.within(0.1, 0.5);
        let cell = cube(random.point(&bounds), half);
        let within: Vec<Vec3> = points
            .iter()
            .copied()
            .filter(|&p| cell.contains(p))
            .collect();
        let Some(part) = shape.bounds_within(&cell) else {
            assert!(within.is_empty(), "{within:?} in {cell:?}");
            continue;
        };
        assert!(cell.contains(part.lo) && cell.contains(part.hi));
        let held = part.enlarged(1e-9 * size);
        assert!(within.iter().all(|&p| held.contains(p)));
        if within.len() > 1000 {
            let tight = Aabb::around(within).enlarged(0.1 * size);
            assert!(
                tight.contains(part.lo) && tight.contains(part.hi),
                "{part:?}"
            );
            met += 1;
        }
    }
    assert!(met > 10, "{met}");
}

#[test]
fn bounds_within_a_cell_are_those_of_the_part() {
    let mut random = Random(5);
    let mut weights = Vec::new();
    while weights.len() < 20_000 {
        let w = random.point(&Aabb::new(Vec3::ZERO, Vec3::ONE));
        weights.push(w / w.element_sum());
    }
    let corners = [
        Vec3::new(0.1, 0.0, 0.3),
        Vec3::new(2.0, 1.0, -0.4),
        Vec3::new(0.4, 1.8, 0.9),
    ];
    let points: Vec<Vec3> = weights
        .iter()
        .map(|w| corners[0] * w.x + corners[1] * w.y + corners[2] * w.z)
        .collect();
    let triangle = Triangle::new(corners, None).unwrap();
    check_bounds_within(&triangle, &points, &mut random);
    let polygon = Polygon::new(corners.to_vec(), None).unwrap();
    check_bounds_within(&polygon, &points, &mut random);
    let center = Vec3::new(0.3, -2.0, 5.0);
    let ball: Vec<Vec3> = (0..20_000)
        .map(|_| center + 1.5 * random.unit() * random.within(0.0, 1.0).cbrt())
        .collect();
    check_bounds_within(&Sphere::new(center, 1.5).unwrap(), &ball, &mut random);
}

fn spheres() -> Vec<Sphere> {
    [
        (Vec3::ZERO, 1.0),
        (Vec3::new(3.0, -2.0, 0.5), 0.25),
        (Vec3::new(1e6, 2.0, -1e5), 1.0),
        (Vec3::new(0.1, 0.2, 0.3), 1e-9),
    ]
    .map(|(c, r)| Sphere::new(c, r).unwrap())
    .to_vec()
}

#[test]
fn a_sphere_is_met_where_it_should_be() {
    let s = Sphere::new(Vec3::new(0.0, 0.0, 5.0), 2.0).unwrap();
    let hit = |o: Vec3, d: Vec3| s.intersect(&Ray::new(o, d), f64::INFINITY);
    assert_eq!(hit(Vec3::ZERO, Vec3::Z), Some(3.0));
    assert_eq!(hit(Vec3::new(0.0, 0.0, 5.0), Vec3::Z), Some(2.0));
    assert_eq!(hit(Vec3::new(0.0, 0.0, 8.0), Vec3::Z), None);
    assert_eq!(hit(Vec3::X * 2.0, Vec3::Z), Some(5.0));
    assert_eq!(hit(Vec3::X * 2.000_001, Vec3::Z), None);
    assert_eq!(hit(Vec3::ZERO, Vec3::Z * 4.0), Some(0.75));
    let ray = Ray::new(Vec3::ZERO, Vec3::Z);
    assert_eq!(s.surface(&ray, 3.0).normal, -Vec3::Z);
    assert_eq!(s.surface(&ray, 7.0).normal, Vec3::Z);
    assert_eq!(s.intersect(&Ray { t_min: 3.5, ..ray }, 10.0), Some(7.0));
    assert_eq!(hit(Vec3::ZERO, Vec3::ZERO), None);
}

#[test]
fn a_small_sphere_is_met_from_far_away() {
    let s = Sphere::new(Vec3::ZERO, 1.0).unwrap();
    let ray = Ray::new(Vec3::new(0.5, 0.0, -1e12), Vec3::Z);
    let t = s.intersect(&ray, f64::INFINITY).unwrap();
    assert!((ray.at(t).z + 0.75f64.sqrt()).abs() < 1e-3);
}

#[test]
fn a_ray_from_a_point_on_a_sphere_meets_it_there_exactly() {
    let s = Sphere::new(Vec3::new(3.0, 4.0, 12.0), 13.0).unwrap();
    let mut random = Random(1);
    for _ in 0..1000 {
        let ray = Ray::new(Vec3::ZERO, random.unit());
        assert_eq!(s.intersect(&ray, f64::INFINITY), Some(0.0));
    }
}

#[test]
fn hits_of_spheres_lie_on_them_and_in_their_bounds() {
    for (i, s) in spheres().iter().enumerate() {
        let off = |p: Vec3| (p.distance(s.center) - s.radius).abs();
        check_hits(s, off, i as u64);
        let poles = [Vec3::X, Vec3::Y, Vec3::Z].into_iter();
        let poles = poles.flat_map(|a| [s.center - s.radius * a, s.center + s.radius * a]);
        check_tightness(s, poles, 2e-15 * s.bounds().magnitude());
    }
}

#[test]
fn spheres_overlap_the_cells_that_hold_their_points() {
    for (i, s) in spheres().iter().take(2).enumerate() {
        let inside = |r: &mut Random| s.center + s.radius * r.within(0.0, 1.0) * r.unit();
        let distance = |p: Vec3| p.distance(s.center) - s.radius;
        assert!(check_overlaps(s, inside, distance, i as u64) > 100);
    }
}

/// Distance of a point from a triangle (Ericson, Real-time collision detection, 2005, 5.1.5).
fn distance_to_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> f64 {
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

fn triangles() -> Vec<Triangle> {
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

/// Concave and large outlines in a tilted plane.
fn polygons() -> Vec<Polygon> {
    let l_shape = [(0., 0.), (3., 0.), (3., 1.), (1., 1.), (1., 2.), (0., 2.)];
    let star = (0..600).map(|i| {
        let radius = [1.0, 0.4, 0.8][i % 3];
        let angle = std::f64::consts::TAU * i as f64 / 600.0;
        (radius * angle.cos(), radius * angle.sin())
    });
    let quad = [(0., 0.), (2., 0.1), (2.5, 1.), (-0.3, 0.9)];
    let arrow = [(0., 0.), (2., 1.), (0., 2.), (0.5, 1.)];
    let comb = (0..40).map(|i| (f64::from(i / 2), f64::from((i / 2 + i) % 2) * 3.0));
    let comb = comb.chain([(20., 4.), (-1., 4.)]);
    let outlines: [Vec<(f64, f64)>; 5] = [
        l_shape.to_vec(),
        star.collect(),
        quad.to_vec(),
        arrow.to_vec(),
        comb.collect(),
    ];
    let mut polygons = Vec::new();
    for (i, outline) in outlines.into_iter().enumerate() {
        let flat = outline.iter().map(|&(x, y)| Vec3::new(x, y, 2.0));
        polygons.push(Polygon::new(flat.collect(), None).unwrap());
        let turn = glam::DQuat::from_euler(glam::EulerRot::XYZ, 0.4 + i as f64, 0.7, 0.2);
        let tilted = outline
            .iter()
            .map(|&(x, y)| turn * Vec3::new(x, y, 0.0) + Vec3::new(1.0, -2.0, 0.5));
        polygons.push(Polygon::new(tilted.collect(), None).unwrap());
    }
    polygons
}

/// The polygon as triangles of its vertices.
fn parts(p: &Polygon) -> Vec<[Vec3; 3]> {
    let corners = |t: &[u32; 3]| t.map(|i| p.vertices()[i as usize]);
    p.triangles().iter().map(corners).collect()
}

fn distance_to_outline(p: &Polygon, point: Vec3) -> f64 {
    let v = p.vertices();
    let distance = |i: usize| {
        let (a, b) = (v[i], v[(i + 1) % v.len()]);
        let s = (point - a).dot(b - a) / (b - a).length_squared();
        point.distance(a + s.clamp(0.0, 1.0) * (b - a))
    };
    (0..v.len()).map(distance).fold(f64::INFINITY, f64::min)
}

#[test]
fn polygons_refuse_what_they_cannot_be() {
    let (o, x, y) = (Vec3::ZERO, Vec3::X, Vec3::Y);
    let new = |v: Vec<Vec3>| Polygon::new(v, None).map(|p| p.normal());
    assert_eq!(new(vec![o, x]), Err(ShapeError::TooFewVertices(2)));
    assert_eq!(new(vec![o, x, x * 2.0, x * 3.0]), Err(ShapeError::ZeroArea));
    assert_eq!(new(vec![o; 5]), Err(ShapeError::ZeroArea));
    assert_eq!(new(vec![o, x, y / 0.0]), Err(ShapeError::NotFinite));
    let bent = new(vec![o, x, x + y + Vec3::Z * 0.1, y]);
    assert!(matches!(bent, Err(ShapeError::NotPlanar(d)) if (0.02..0.03).contains(&d)));
    assert!(new(vec![o, x, x + y + Vec3::Z * 1e-6, y]).is_ok());
    assert_eq!(new(vec![o, x, x, x * 2.0, y]), Ok(Vec3::Z));
    let count = ShapeError::NormalCount {
        vertices: 3,
        normals: 2,
    };
    assert_eq!(Polygon::new(vec![o, x, y], Some(vec![x, y])), Err(count));
}

#[test]
fn hits_of_polygons_lie_on_them_and_in_their_bounds() {
    for (i, p) in polygons().iter().enumerate() {
        let parts = parts(p);
        let off = |q: Vec3| {
            let distances = parts.iter().map(|&t| distance_to_triangle(q, t));
            distances.fold(f64::INFINITY, f64::min)
        };
        check_hits(p, off, i as u64);
        check_tightness(
            p,
            p.vertices().iter().copied(),
            1e-14 * p.bounds().magnitude(),
        );
    }
}

#[test]
fn bounds_of_a_rounded_polygon_hold_its_hits() {
    let mut random = Random(3);
    let rounded = |x: f64| (x * 1e6).round() / 1e6;
    for p in polygons() {
        let vertices = p.vertices().iter().map(|v| v.map(rounded)).collect();
        let p = Polygon::new(vertices, None).unwrap();
        let center = p.bounds().center();
        let mut hits = 0;
        for i in 0..2000 {
            let v = p.vertices()[i % p.vertices().len()];
            let target = v + random.within(-1e-7, 1e-6) * (center - v) + 1e-6 * random.unit();
            let ray = Ray::new(target - 2.0 * p.normal(), p.normal());
            if let Some(t) = p.intersect(&ray, f64::INFINITY) {
                hits += 1;
                assert!(p.bounds().enlarged(1e-14).contains(ray.at(t)));
                assert!(p.overlaps(&cube(ray.at(t), 1e-14)));
            }
        }
        assert!(hits > 50);
    }
}

#[test]
fn polygons_agree_with_their_triangulation() {
    for (i, p) in polygons().iter().enumerate() {
        let triangles: Vec<_> = parts(p)
            .into_iter()
            // Between vertices on a line, rounding may leave an ear without area.
            .filter_map(|t| Triangle::new(t, None).ok())
            .collect();
        assert!(triangles.iter().all(|t| t.normal().dot(p.normal()) > 0.99));
        let mut random = Random(i as u64);
        let (mut hits, mut misses) = (0, 0);
        for kind in 0..6000 {
            let ray = tough_ray(&mut random, &p.bounds(), [0, 3, 4][kind % 3]);
            let exact = p.intersect(&ray, f64::INFINITY);
            let found = triangles
                .iter()
                .filter_map(|t| t.intersect(&ray, f64::INFINITY));
            let found = found.reduce(f64::min);
            match (exact, found) {
                (Some(a), Some(b)) => {
                    hits += 1;
                    let grazing = ray.direction.dot(p.normal()).abs().max(1e-4);
                    assert!((a - b).abs() < 1e-11 / grazing, "{ray:?} {a} {b}");
                }
                (None, None) => misses += 1,
                (Some(t), None) | (None, Some(t)) => {
                    assert!(distance_to_outline(p, ray.at(t)) < 1e-9, "{ray:?}");
                }
            }
        }
        assert!(hits > 200 && misses > 200, "{i} {hits} {misses}");
    }
}

#[test]
fn triangles_agree_with_polygons_of_three_vertices() {
    for (i, t) in triangles().iter().enumerate() {
        let p = Polygon::new(t.vertices.to_vec(), None).unwrap();
        assert!((p.normal() - t.normal()).length() < 1e-13);
        let mut random = Random(i as u64);
        let mut hits = 0;
        for kind in 0..6000 {
            let ray = tough_ray(&mut random, &t.bounds(), [0, 3, 4][kind % 3]);
            let (a, b) = (p.intersect(&ray, 1e9), t.intersect(&ray, 1e9));
            if let (Some(a), Some(b)) = (a, b) {
                hits += 1;
                let grazing = ray.direction.dot(t.normal()).abs().max(1e-4);
                assert!((a - b).abs() < 1e-11 / grazing);
            } else if let Some(t) = a.or(b) {
                assert!(distance_to_outline(&p, ray.at(t)) < 1e-9, "{ray:?}");
            }
        }
        assert!(hits > 200);
    }
}

#[test]
fn polygons_overlap_the_cells_that_hold_their_points() {
    let mut told_apart = 0;
    for (i, p) in polygons().iter().enumerate() {
        let parts = parts(p);
        let inside = |r: &mut Random| {
            let [a, b, c] = parts[r.below(parts.len())];
            let (mut u, mut v) = (r.within(0.0, 1.0), r.within(0.0, 1.0));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            a + u * (b - a) + v * (c - a)
        };
        let distance = |q: Vec3| {
            let distances = parts.iter().map(|&t| distance_to_triangle(q, t));
            distances.fold(f64::INFINITY, f64::min)
        };
        told_apart += check_overlaps(p, inside, distance, i as u64);
    }
    assert!(told_apart > 1000, "{told_apart}");
}

#[test]
fn a_hole_between_the_teeth_is_no_overlap_but_the_middle_is() {
    let p = &polygons()[0];
    assert!(!p.overlaps(&cube(Vec3::new(2.0, 1.5, 2.0), 0.4)));
    assert!(p.overlaps(&cube(Vec3::new(2.0, 1.5, 2.0), 0.5)));
    assert!(p.overlaps(&cube(Vec3::new(0.5, 0.5, 2.0), 0.1)));
    assert!(p.overlaps(&cube(Vec3::new(0.5, 0.5, 2.125), 0.125)));
    assert!(!p.overlaps(&cube(Vec3::new(0.5, 0.5, 2.126), 0.125)));
    let flat = Aabb::new(Vec3::new(0.4, 0.4, 2.0), Vec3::new(0.5, 0.5, 2.0));
    assert!(p.overlaps(&flat));
}

#[test]
fn a_self_crossing_polygon_is_empty_where_it_winds_twice() {
    let corner = |k: usize| {
        let angle = std::f64::consts::TAU * (2 * k) as f64 / 5.0;
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    };
    let pentagram = Polygon::new((0..5).map(corner).collect(), None).unwrap();
    let hit = |x: f64| pentagram.intersect(&Ray::new(Vec3::new(x, 0.0, 1.0), -Vec3::Z), 9.0);
    assert_eq!(hit(0.0), None);
    assert_eq!(hit(0.8), Some(1.0));
}

#[test]
fn normals_of_a_polygon_take_the_values_at_its_vertices_and_are_linear_between() {
    let p = &polygons()[1];
    // Directions that are a linear function of the place, so that a mean of sum 1 gives them back.
    let turned = |q: Vec3| p.normal() * 5.0 + q;
    let normals: Vec<_> = p.vertices().iter().map(|&v| turned(v)).collect();
    let bare = Polygon::new(p.vertices().to_vec(), Some(normals.clone())).unwrap();
    let look = |q: Vec3| bare.surface(&Ray::new(q + p.normal(), -p.normal()), 1.0);
    for (v, n) in p.vertices().iter().zip(&normals) {
        assert!((look(*v).shading_normal - n.normalize()).length() < 1e-7);
    }
    let same = vec![Vec3::new(1.0, 2.0, 2.0); p.vertices().len()];
    let same = Polygon::new(p.vertices().to_vec(), Some(same)).unwrap();
    let mut random = Random(5);
    for t in parts(p) {
        for _ in 0..100 {
            let (u, v) = (random.within(0.0, 0.5), random.within(0.0, 0.5));
            let q = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
            let ray = Ray::new(q + p.normal(), -p.normal());
            let n = same.surface(&ray, 1.0).shading_normal;
            assert!((n - Vec3::new(1.0, 2.0, 2.0) / 3.0).length() < 1e-12);
        }
    }
    // On an edge only its ends count.
    let [a, b] = [0, 1].map(|i| (p.vertices()[i], normals[i].normalize()));
    let middle = look(0.25 * a.0 + 0.75 * b.0).shading_normal;
    assert!((middle - (0.25 * a.1 + 0.75 * b.1).normalize()).length() < 1e-7);
}

#[test]
fn triangulations_cover_the_area_of_loops_even_if_not_planar() {
    let area = |t: [Vec3; 3]| 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
    for p in polygons() {
        let v = p.vertices();
        let newell: Vec3 = (0..v.len()).map(|i| v[i].cross(v[(i + 1) % v.len()])).sum();
        let sum: f64 = parts(&p).into_iter().map(area).sum();
        assert!((sum - 0.5 * newell.length()).abs() < 1e-12 * sum * v.len() as f64);
    }
    let bent = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.5), Vec3::Y];
    let triangles = Polygon::triangulate(&bent);
    assert_eq!(triangles.len(), 2);
    assert!(Polygon::triangulate(&bent[..2]).is_empty());
    assert!(Polygon::triangulate(&[]).is_empty());
}

fn cones() -> Vec<Cone> {
    let v = Vec3::new;
    [
        (v(0.0, 0.0, 0.0), 1.0, v(0.0, 0.0, 2.0), 1.0),
        (v(1.0, 2.0, 3.0), 0.2, v(-2.0, 3.0, 7.0), 0.2),
        (v(1.0, 2.0, 3.0), 1.5, v(1.3, 2.5, 4.0), 0.5),
        (v(1.0, 0.0, 3.0), 0.0, v(-1.0, 0.0, 3.0), 0.7),
        (v(1.0, 2.0, -3.0), 0.5, v(0.0, 0.5, 1.0), 0.0),
        (v(0.0, 0.0, 0.0), 2.0, v(0.01, 0.02, 0.05), 1.0),
        (v(5.0, 1.0, 0.0), 0.01, v(5.0, 101.0, 0.0), 0.01),
    ]
    .map(|(b, r, a, s)| Cone::new(b, r, a, s).unwrap())
    .to_vec()
}

/// A point's distances from the axis's foot along it and from the axis.
fn cylindrical(c: &Cone, p: Vec3) -> (f64, f64) {
    let axis = (c.apex() - c.base()) / c.length();
    let height = (p - c.base()).dot(axis);
    (height, (p - c.base() - height * axis).length())
}

fn distance_to_side(c: &Cone, p: Vec3) -> f64 {
    let (h, r) = cylindrical(c, p);
    let p = glam::DVec2::new(r, h);
    let a = glam::DVec2::new(c.base_radius(), 0.0);
    let b = glam::DVec2::new(c.apex_radius(), c.length());
    let s = (p - a).dot(b - a) / (b - a).length_squared();
    p.distance(a + s.clamp(0.0, 1.0) * (b - a))
}

fn distance_to_solid(c: &Cone, p: Vec3) -> f64 {
    let (h, r) = cylindrical(c, p);
    let radius = c.base_radius() + (c.apex_radius() - c.base_radius()) * h / c.length();
    if (0.0..=c.length()).contains(&h) && r <= radius {
        return 0.0;
    }
    let to_disc = |height: f64, radius: f64| height.hypot((r - radius).max(0.0));
    distance_to_side(c, p)
        .min(to_disc(h, c.base_radius()))
        .min(to_disc(h - c.length(), c.apex_radius()))
}

/// The point at a height (0 to 1), a radius (0 to 1) and an angle.
fn point_of(c: &Cone, height: f64, radius: f64, angle: f64) -> Vec3 {
    let (u, v) = ((c.apex() - c.base()) / c.length()).any_orthonormal_pair();
    let full = c.base_radius() + (c.apex_radius() - c.base_radius()) * height;
    let around = angle.cos() * u + angle.sin() * v;
    c.base() + height * (c.apex() - c.base()) + full * radius * around
}

#[test]
fn a_cylinder_and_a_cone_are_met_where_they_should_be() {
    let hit = |c: &Cone, o: Vec3, d: Vec3| c.intersect(&Ray::new(o, d), f64::INFINITY);
    let cylinder = Cone::new(Vec3::ZERO, 1.0, Vec3::Z * 2.0, 1.0).unwrap();
    assert!(cylinder.is_cylinder());
    let side = Vec3::new(-3.0, 0.0, 0.5);
    assert_eq!(hit(&cylinder, side, Vec3::X), Some(2.0));
    assert_eq!(hit(&cylinder, Vec3::new(0.0, 0.0, 0.5), Vec3::X), Some(1.0));
    assert_eq!(
        hit(&cylinder, Vec3::new(-3.0, 0.0, 2.0), Vec3::X),
        Some(2.0)
    );
    assert_eq!(
        hit(&cylinder, Vec3::new(-3.0, 0.0, 2.0 + 1e-9), Vec3::X),
        None
    );
    // No caps: straight through, or in at the open end and on to the side's inside.
    assert_eq!(hit(&cylinder, Vec3::new(0.5, 0.0, -3.0), Vec3::Z), None);
    assert_eq!(
        hit(
            &cylinder,
            Vec3::new(0.0, 0.0, -1.0),
            Vec3::new(1.0, 0.0, 2.0)
        ),
        Some(1.0)
    );
    let ray = Ray::new(side, Vec3::X);
    assert_eq!(cylinder.surface(&ray, 2.0).normal, -Vec3::X);
    assert_eq!(cylinder.surface(&ray, 4.0).normal, Vec3::X);

    let cone = Cone::new(Vec3::ZERO, 1.0, Vec3::Z, 0.0).unwrap();
    assert!(!cone.is_cylinder());
    assert_eq!(hit(&cone, side, Vec3::X), Some(2.5));
    // The other half of the infinite cone does not count.
    assert_eq!(hit(&cone, Vec3::new(-3.0, 0.0, 1.5), Vec3::X), None);
    // Parallel to the side: one hit, at the side across.
    let t = hit(&cone, Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.0, -1.0));
    assert_eq!(t, None);
    let t = hit(&cone, Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 1.0));
    assert_eq!(t, Some(0.5));
    let normal = cone.surface(&Ray::new(side, Vec3::X), 2.5).normal;
    let slanted = Vec3::new(-1.0, 0.0, 1.0).normalize();
    assert!((normal - slanted).length() < 1e-15);
}

#[test]
fn a_ray_parallel_to_the_side_of_a_cone_meets_the_other_side() {
    let cone = Cone::new(Vec3::ZERO, 1.0, Vec3::Z, 0.0).unwrap();
    for shift in [0.25, 0.5, 1.0] {
        // Along the generator from (1, 0, 0) to the tip, `shift` towards the axis.
        let ray = Ray::new(Vec3::new(2.0 - shift, 0.0, -1.0), Vec3::new(-1.0, 0.0, 1.0));
        let t = cone.intersect(&ray, f64::INFINITY).unwrap();
        assert!((t - (2.0 - shift / 2.0)).abs() < 1e-14, "{shift} {t}");
    }
}

#[test]
fn cones_refuse_what_they_cannot_be() {
    let (o, z) = (Vec3::ZERO, Vec3::Z);
    let new = |b, r, a, s| Cone::new(b, r, a, s).map(|c| c.length());
    assert_eq!(new(o, 1.0, o, 1.0), Err(ShapeError::NoLength));
    let far = Vec3::splat(1e17);
    assert_eq!(new(far, 1.0, far + 16.0, 1.0), Err(ShapeError::NoLength));
    assert_eq!(new(o, -1.0, z, 1.0), Err(ShapeError::NegativeRadius(-1.0)));
    assert_eq!(new(o, 0.0, z, 0.0), Err(ShapeError::ZeroArea));
    assert_eq!(new(o, f64::NAN, z, 1.0), Err(ShapeError::NotFinite));
    assert_eq!(new(o, 1.0, z / 0.0, 1.0), Err(ShapeError::NotFinite));
    assert_eq!(new(o, 0.0, z, 2.0), Ok(1.0));
}

#[test]
fn hits_of_cones_lie_on_them_and_in_their_bounds() {
    for (i, c) in cones().iter().enumerate() {
        check_hits(c, |p| distance_to_side(c, p), i as u64);
        let rims = (0..200_000).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k / 2) / 100_000.0;
            point_of(c, f64::from(k % 2), 1.0, angle)
        });
        check_tightness(c, rims, 1e-8);
    }
}

#[test]
fn bounds_of_an_upright_cylinder_are_exact_to_the_last_places() {
    let b = cones()[0].bounds();
    assert!((b.lo - Vec3::new(-1.0, -1.0, 0.0)).abs().max_element() < 2e-15);
    assert!((b.hi - Vec3::new(1.0, 1.0, 2.0)).abs().max_element() < 2e-15);
}

#[test]
fn cones_overlap_the_cells_that_hold_their_points() {
    let mut told_apart = 0;
    for (i, c) in cones().iter().enumerate() {
        let inside = |r: &mut Random| {
            let radius = [1.0, r.within(0.0, 1.0)][r.below(2)];
            point_of(c, r.within(0.0, 1.0), radius, r.within(0.0, 7.0))
        };
        let distance = |p: Vec3| distance_to_solid(c, p);
        told_apart += check_overlaps(c, inside, distance, i as u64);
    }
    assert!(told_apart > 1000, "{told_apart}");
}

#[test]
fn a_cell_off_the_round_of_a_cylinder_is_apart_by_the_exact_gap() {
    let c = &cones()[0];
    let corner = Vec3::new(0.5f64.sqrt(), 0.5f64.sqrt(), 1.0);
    let cell = |gap: f64| {
        let lo = corner + gap * Vec3::new(1.0, 1.0, 0.0);
        Aabb::new(lo, lo + 0.1)
    };
    assert!(c.overlaps(&cell(-1e-9)));
    assert!(!c.overlaps(&cell(1e-9)));
    assert!(c.overlaps(&cube(Vec3::Z, 0.1)), "the inside counts");
    assert!(
        c.overlaps(&Aabb::new(Vec3::X, Vec3::ONE * 3.0)),
        "touching counts"
    );
}

#[test]
fn prisms_are_inscribed_and_near_the_exact_surface() {
    for (i, c) in cones().iter().enumerate() {
        let prism = c.prism(200);
        assert_eq!(prism.len(), 200);
        let radius = c.base_radius().max(c.apex_radius());
        let sagitta = radius * (1.0 - (std::f64::consts::PI / 200.0).cos());
        let mut random = Random(i as u64);
        let (mut hits, mut differing) = (0, 0);
        for side in &prism {
            for &v in side.vertices() {
                assert!(distance_to_side(c, v) < 1e-13 * c.bounds().magnitude());
            }
            let center = side.vertices().iter().sum::<Vec3>() / side.vertices().len() as f64;
            let height = cylindrical(c, center).0 / c.length();
            let inner = c.base() + height * (c.apex() - c.base());
            assert!(
                side.normal().dot(center - inner) > 0.0,
                "sides face outwards"
            );
        }
        for _ in 0..2000 {
            let ray = tough_ray(&mut random, &c.bounds(), 0);
            let exact = c.intersect(&ray, f64::INFINITY);
            let flat = prism
                .iter()
                .filter_map(|p| p.intersect(&ray, f64::INFINITY));
            if let Some(t) = flat.reduce(f64::min) {
                hits += 1;
                assert!(distance_to_side(c, ray.at(t)) < 1.1 * sagitta + 1e-12);
                // Only at a rim or a grazing ray may the two differ by more than the sagitta.
                let near = exact.is_some_and(|e| (e - t).abs() < 30.0 * sagitta);
                differing += usize::from(!near);
            }
        }
        assert!(
            hits > 50 && differing * 25 < hits,
            "{i}: {differing} of {hits}"
        );
    }
}

#[test]
fn vertices_of_a_prism_count_from_axis_cross_x_by_the_right_hand() {
    let c = Cone::new(Vec3::ZERO, 1.0, Vec3::Z * 2.0, 0.5).unwrap();
    let prism = c.prism(4);
    let expected = [
        Vec3::Y,
        -Vec3::X,
        Vec3::new(-0.5, 0.0, 2.0),
        Vec3::new(0.0, 0.5, 2.0),
    ];
    for (v, e) in prism[0].vertices().iter().zip(expected) {
        assert!((*v - e).length() < 1e-15);
    }
    let along_x = Cone::new(Vec3::ZERO, 1.0, Vec3::X, 0.0).unwrap().prism(5);
    assert_eq!(along_x[0].vertices().len(), 3);
    assert!((along_x[0].vertices()[0] - Vec3::Z).length() < 1e-15);
    assert_eq!(along_x[4].vertices()[1], along_x[0].vertices()[0], "closed");
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
