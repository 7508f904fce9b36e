//! Exact verification: the oracle is right, and every structure and kernel agrees with it.

use crate::support::scenes::{scene, scene_of};
use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::exact::{ExactKernel, Oracle, RaySource, check_exactly};
use bspscope::primitive::{Cone, Polygon, Precision, Primitive, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{BuildSettings, Method, Tree, build};
use bspscope::trace::{Hit, RenderSettings, thread_pool};

fn trees(scene: &Scene) -> Vec<Tree> {
    let methods = Method::all().filter(|m| m.name != "none");
    let built = |method| build(scene, &BuildSettings::for_method(method), &Progress::new());
    methods.map(|method| built(method).unwrap()).collect()
}

fn assert_exact(scene: &Scene, rays: usize) {
    let (trees, pool) = (trees(scene), thread_pool(0).unwrap());
    let render = RenderSettings::default();
    let check = check_exactly(scene, &trees, &render, rays, &pool, &Progress::new()).unwrap();
    let kernels = ExactKernel::all();
    assert!(kernels.len() >= 4, "{kernels:?}");
    assert_eq!(check.faults.len(), (1 + trees.len()) * 2 * kernels.len());
    assert_eq!(check.ray_count(), rays as u64);
    assert!(check.hits > rays as u64 / 4, "{}", check.hits);
    let wrong: Vec<_> = check.faults.iter().filter(|f| f.count() > 0).collect();
    assert!(wrong.is_empty(), "{}: {wrong:#?}", scene.name());
}

/// A square across the z axis.
fn square(z: f64) -> Primitive {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| Vec3::new(x, y, z)).to_vec();
    Primitive::Polygon(Polygon::new(corners, None).unwrap())
}

fn triangle(z: f64) -> Primitive {
    let vertices = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)].map(|(x, y)| Vec3::new(x, y, z));
    Primitive::Triangle(Triangle::new(vertices, None).unwrap())
}

fn sphere(center: Vec3, radius: f64) -> Primitive {
    Primitive::Sphere(Sphere::new(center, radius).unwrap())
}

#[test]
fn every_structure_and_kernel_is_exactly_right() {
    for name in ["teaching", "balls:1", "rings:1", "tetra:2"] {
        assert_exact(&scene(name), 300);
    }
}

#[test]
fn every_structure_and_kernel_is_exactly_right_for_surfaces_that_nearly_coincide() {
    let mut objects = Vec::new();
    let mut z = 2.0f64;
    for _ in 0..4 {
        objects.extend([square(z), triangle(z), square(z)]);
        z = z.next_up();
        let radius = 1.0 + (z - 2.0);
        let cone = Cone::new(Vec3::Y * -2.0, radius, Vec3::Y * 2.0, 1.0).unwrap();
        objects.extend([sphere(Vec3::ZERO, radius), Primitive::Cone(cone)]);
    }
    assert_exact(&scene_of(objects), 300);
}

#[test]
fn the_oracle_orders_by_exact_distance_then_by_number() {
    let up = Ray::new(Vec3::ZERO, Vec3::Z);
    let closest = |objects: Vec<Primitive>, ray: &Ray| {
        Oracle::new(&scene_of(objects), Precision::F64).closest(ray)
    };
    let near = vec![square(3.0f64.next_up()), square(3.0), triangle(3.0)];
    assert_eq!(closest(near, &up), Hit { t: 3.0, object: 1 });
    // Both distances round to the same number, and the second is exactly less.
    let vertices = [
        (-1.0, -1.0, 3.0),
        (1.0, -1.0, 3.0f64.next_up()),
        (-1.0, 1.0, 3.0),
    ];
    let vertices = vertices.map(|(x, y, z)| Vec3::new(x, y, z));
    let tilted = Primitive::Triangle(Triangle::new(vertices, None).unwrap());
    let ray = Ray::new(Vec3::new(-0.75, -0.75, 0.0), Vec3::Z);
    let hit = closest(vec![tilted.clone(), square(3.0)], &ray);
    assert_eq!(hit, Hit { t: 3.0, object: 1 });
    assert_eq!(closest(vec![tilted], &ray), Hit { t: 3.0, object: 0 });
}

#[test]
fn the_oracle_includes_ends_edges_tangents_and_rims() {
    let cylinder = Cone::new(
        Vec3::new(-1.0, 0.0, 3.0),
        1.0,
        Vec3::new(1.0, 0.0, 3.0),
        1.0,
    );
    let objects = [
        square(3.0),
        sphere(Vec3::new(1.0, 0.0, 3.0), 2.0),
        Primitive::Cone(cylinder.unwrap()),
    ];
    // At the edge, at the tangent, and on the rim where the cylinder is nearest.
    let rays = [(1.0, 0.5, 3.0), (3.0, 0.0, 3.0), (1.0, 0.0, 2.0)];
    for (object, (x, y, t)) in objects.into_iter().zip(rays) {
        for precision in [Precision::F64, Precision::F32] {
            let scene = scene_of(vec![object.clone()]);
            let oracle = Oracle::new(&scene, precision);
            let origin = Vec3::new(x, y, 0.0);
            let up = Ray::new(origin, Vec3::Z);
            let hit = Hit { t, object: 0 };
            assert_eq!(oracle.closest(&up), hit, "{precision:?} {object:?}");
            let until = |t_max| oracle.closest(&Ray { t_max, ..up });
            assert_eq!(until(t), hit);
            assert_eq!(until(f64::from((t as f32).next_down())), Hit::MISS);
            let from = |t_min| oracle.closest(&Ray { t_min, ..up });
            assert_eq!(from(t), hit);
            let later = from(f64::from((t as f32).next_up()));
            assert!(!later.is_hit() || later.t > t);
            // The least beyond it, there is none.
            let beyond = Vec3::X * f64::from(f32::EPSILON) * 4.0;
            assert_eq!(
                oracle.closest(&Ray::new(origin + beyond, Vec3::Z)),
                Hit::MISS
            );
        }
    }
}

#[test]
fn the_oracle_rounds_distances_to_the_nearest_number() {
    // From the center of a sphere along a diagonal, the distance is exactly 1/√3.
    let oracle = |precision| {
        Oracle::new(&scene_of(vec![sphere(Vec3::ZERO, 1.0)]), precision)
            .closest(&Ray::new(Vec3::ZERO, Vec3::ONE))
            .t
    };
    assert_eq!(oracle(Precision::F64), 0.577_350_269_189_625_7);
    assert_eq!(
        oracle(Precision::F32),
        f64::from((1.0 / 3.0f64.sqrt()) as f32)
    );
}

#[test]
fn every_source_of_rays_occurs_and_cancelling_ends_the_check() {
    let scene = scene("teaching");
    let (trees, pool) = (trees(&scene), thread_pool(1).unwrap());
    let render = RenderSettings::default();
    let progress = Progress::new();
    let check = check_exactly(&scene, &trees[..1], &render, 400, &pool, &progress).unwrap();
    for source in RaySource::ALL {
        let count = check.rays.iter().find(|(s, _)| *s == source).unwrap().1;
        assert!(count >= 10, "{source:?}: {count}");
    }
    progress.cancel();
    assert!(check_exactly(&scene, &trees[..1], &render, 400, &pool, &progress).is_err());
}
