//! What every primitive promises, on thousands of random and tough rays and cells.

mod cones;
mod meshes;
mod polygons;
mod spheres;
mod triangles;

use crate::support::random::Random;
use bspscope::geometry::{Aabb, Axis, Ray, Vec3};
use bspscope::primitive::{Cone, Polygon, Shape, ShapeError, Sphere, Triangle};

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

        // The limit is for the rounded distance, the ray's start for the exact one. The hit is the first.
        assert_eq!(shape.intersect(&ray, t), Some(t));
        let start = t.next_down();
        assert_eq!(
            shape.intersect(
                &Ray {
                    t_min: start,
                    ..ray
                },
                t
            ),
            Some(t)
        );
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
    check_certain_bounds_within(shape, points, true, random);
}

/// The certain bounds within a cell hold every point there, without any tolerance, also of cells whose faces are
/// within rounding of points. Of convex objects, they reach hardly
/// farther than the bounds within the cell.
fn check_certain_bounds_within(
    shape: &impl Shape,
    points: &[Vec3],
    is_convex: bool,
    random: &mut Random,
) {
    let bounds = shape.bounds();
    let size = bounds.size().max_element();
    for i in 0..400 {
        let at = random.one_of(points);
        let mut cell = cube(at, size * random.within(0.1, 0.5));
        let k = random.below(3);
        match i % 4 {
            0 => cell.lo[k] = at[k],
            1 => cell.hi[k] = at[k],
            2 => (cell.lo[k], cell.hi[k]) = (at[k], at[k].next_up()),
            _ => (),
        }
        let part = shape.certain_bounds_within(&cell).unwrap();
        let clipped = cell.intersection(&bounds);
        assert_eq!(part.intersection(&clipped), part, "{part:?} in {cell:?}");
        let within = points.iter().copied();
        let within = within.filter(|&p| clipped.contains(p));
        for point in within {
            assert!(part.contains(point), "{point} in {part:?}");
        }
        if let Some(rounded) = shape
            .bounds_within(&cell)
            .filter(|_| is_convex && i % 4 == 3)
        {
            let held = rounded.enlarged(1e-12 * bounds.magnitude());
            let is_held = held.contains(part.lo) && held.contains(part.hi);
            assert!(is_held, "{part:?} for {rounded:?}");
        }
    }
    assert_eq!(shape.certain_bounds_within(&bounds), Some(bounds));
    let beside = Aabb::new(bounds.hi + size, bounds.hi + 2.0 * size);
    assert_eq!(shape.certain_bounds_within(&beside), None);
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
    // A polygon that is not convex: an arrow.
    let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.7, 1.0]];
    let tilted = |[x, y]: [f64; 2]| Vec3::new(x, y, 0.3 * x - 0.7 * y);
    let polygon = Polygon::new(arrow.map(tilted).to_vec(), None).unwrap();
    let mut points = Vec::new();
    while points.len() < 2000 {
        let [x, y] = [(); 2].map(|()| random.within(0.0, 2.0));
        let from_middle = (y - 1.0).abs();
        let is_left = x < 0.7 * (1.0 - from_middle);
        if x <= 2.0 * (1.0 - from_middle) && !is_left {
            points.push(tilted([x, y]));
        }
    }
    check_certain_bounds_within(&polygon, &points, false, &mut random);
    let (base, apex) = (Vec3::new(0.1, 0.2, 0.3), Vec3::new(2.0, -1.0, 1.0));
    let cone = Cone::new(base, 0.3, apex, 0.3).unwrap();
    let across = (apex - base).normalize().any_orthonormal_pair();
    let points: Vec<Vec3> = (0..2000)
        .map(|_| {
            let angle = random.within(0.0, std::f64::consts::TAU);
            let outward = libm::cos(angle) * across.0 + libm::sin(angle) * across.1;
            base + random.within(0.0, 1.0) * (apex - base) + 0.299_999 * outward
        })
        .collect();
    check_certain_bounds_within(&cone, &points, true, &mut random);
    let part = cone
        .certain_bounds_within(&cone.bounds().split(Axis::X, 1.0).0)
        .unwrap();
    assert!(part.size().y < 0.8 * cone.bounds().size().y, "{part:?}");
    for shape in [&polygon as &dyn Shape, &cone, &triangle] {
        assert!(shape.least_box_area() < shape.bounds().surface_area());
    }
}
