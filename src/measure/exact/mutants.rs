//! Mutation tests of exact verification: an intersection with one loosened bound must be caught.

use super::oracle::Oracle;
use super::rays::ExactRays;
use crate::geometry::{Ray, Vec3};
use crate::measure::verify::RaySample;
use crate::primitive::{Precision, Primitive, Shape, Sphere, Triangle};
use crate::progress::Progress;
use crate::scene::{Scene, builtin};
use crate::trace::{Hit, thread_pool};

/// An intersection test with `f64` objects: the distance within `t_max`.
type Test = fn(&Primitive, &Ray, f64) -> Option<f64>;

/// Tests every object. Of equal rounded distances, the exactly smaller one wins, then the lower number.
fn closest(scene: &Scene, ray: &Ray, test: Test) -> Hit {
    let mut best = Hit::MISS;
    let objects = scene.objects();
    for (object, number) in objects.iter().zip(0..) {
        let Some(t) = test(object, ray, ray.t_max) else {
            continue;
        };
        let is_nearer = t < best.t
            || t == best.t
                && object.exact_distance(ray) < objects[best.object as usize].exact_distance(ray);
        if is_nearer {
            best = Hit { t, object: number };
        }
    }
    best
}

/// Returns for each ray of a small scene of triangles and spheres whether the answer of a test is wrong.
fn is_wrong(test: Test) -> Vec<bool> {
    let mut parts = builtin::generate("tetra", Some(2)).expect("there is such a scene");
    parts.objects.truncate(60);
    parts.objects.extend((0..4).map(|i| {
        // Numbers of few bits, so that tangents along the axes are exact.
        let center = Vec3::new(0.25 * f64::from(i), 0.25, 0.75);
        Primitive::Sphere(Sphere::new(center, 0.1875).expect("it has a radius"))
    }));
    parts.material_of = vec![0; parts.objects.len()];
    let scene = Scene::new(parts);
    let oracle = Oracle::new(&scene, Precision::F64);
    let (pool, progress) = (thread_pool(1).expect("a thread"), Progress::new());
    let sample = RaySample::default();
    let rays =
        ExactRays::new(&scene, &sample, 2000, &oracle, &pool, &progress).expect("nobody cancels");
    let is_wrong = |ray| closest(&scene, ray, test) != oracle.closest(ray);
    rays.rays().iter().map(is_wrong).collect()
}

/// Returns the number of rays that only the mutant answers wrong.
fn caught(mutant: Test) -> usize {
    let answers = is_wrong(Primitive::intersect).into_iter();
    let both = answers.zip(is_wrong(mutant));
    both.filter(|(unchanged, mutant)| !unchanged && *mutant)
        .count()
}

/// Returns a triangle larger by this ratio, with the same center.
fn larger(triangle: &Triangle, ratio: f64) -> Primitive {
    let center = triangle.vertices.iter().sum::<Vec3>() / 3.0;
    let vertices = triangle.vertices.map(|v| center + ratio * (v - center));
    Primitive::Triangle(Triangle {
        vertices,
        normals: None,
    })
}

#[test]
fn the_unchanged_test_is_right() {
    assert_eq!(
        is_wrong(Primitive::intersect)
            .iter()
            .filter(|w| **w)
            .count(),
        0
    );
}

#[test]
fn ignoring_edges_by_the_12th_digit_is_caught() {
    let test: Test = |object, ray, t_max| match object {
        Primitive::Triangle(triangle) => larger(triangle, 1.0 + 1e-12).intersect(ray, t_max),
        _ => object.intersect(ray, t_max),
    };
    assert!(caught(test) > 0);
}

#[test]
fn accepting_hits_4_units_beyond_an_edge_is_caught() {
    // Only the decision about the hit is loosened, not the distance.
    let test: Test = |object, ray, t_max| match object {
        Primitive::Triangle(triangle) => {
            let is_near = larger(triangle, 1.0 + 4.0 * f64::EPSILON)
                .intersect(ray, t_max)
                .is_some();
            let plane = larger(triangle, 4.0);
            let hit = object.intersect(ray, t_max);
            hit.or_else(|| plane.intersect(ray, t_max).filter(|_| is_near))
        }
        _ => object.intersect(ray, t_max),
    };
    assert!(caught(test) > 0);
}

#[test]
fn accepting_hits_beyond_the_end_is_caught() {
    let test: Test = |object, ray, t_max| {
        let end = 4.0f64.mul_add(f64::EPSILON * t_max, t_max);
        object.intersect(&Ray { t_max: end, ..*ray }, end)
    };
    assert!(caught(test) > 0);
}

#[test]
fn a_distance_off_by_one_unit_is_caught() {
    let test: Test = |object, ray, t_max| object.intersect(ray, t_max).map(f64::next_up);
    assert!(caught(test) > 0);
}

#[test]
fn missing_tangents_is_caught() {
    let test: Test = |object, ray, t_max| match object {
        Primitive::Sphere(sphere) => {
            let smaller = Sphere {
                radius: sphere.radius * (1.0 - f64::EPSILON),
                ..*sphere
            };
            let is_inside = smaller.intersect(ray, t_max).is_some();
            object.intersect(ray, t_max).filter(|_| is_inside)
        }
        _ => object.intersect(ray, t_max),
    };
    assert!(caught(test) > 0);
}
