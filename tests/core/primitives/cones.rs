//! Cones and cylinders, exact and as prisms.

use super::*;

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
