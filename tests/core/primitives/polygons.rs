//! Polygons, planar or nearly, of any outline.

use super::triangles::{distance_to_triangle, triangles};
use super::*;

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
