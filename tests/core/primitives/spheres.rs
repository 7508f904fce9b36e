//! Spheres.

use super::*;

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
