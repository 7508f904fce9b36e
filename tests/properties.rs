//! Random scenes on a coarse lattice, and rays made to meet vertices, edges, faces and split planes
//! exactly: every tree must answer as testing every object does, bit by bit.

use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::{RaySample, answer, compare, judge};
use bspscope::primitive::{Cone, Polygon, Precision, Primitive, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::{Camera, Material, Scene, SceneParts};
use bspscope::trace::{RayKind, thread_pool};
use bspscope::tree::{BuildSettings, MaxDepth, Method, OverlapRule, build, validate};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::OnceLock;

/// The suite runs the same cases everywhere; other seeds are for searching.
const SEED: u64 = 1;

/// Lattice points: many coordinates coincide with each other and with midpoint planes.
fn lattice() -> impl Strategy<Value = Vec3> {
    (-4i32..=4, -4i32..=4, -4i32..=4).prop_map(|(x, y, z)| Vec3::new(x.into(), y.into(), z.into()))
}

fn primitive() -> impl Strategy<Value = Primitive> {
    prop_oneof![
        (lattice(), 1u32..=4).prop_filter_map("sphere", |(center, r)| {
            Some(Primitive::Sphere(
                Sphere::new(center, f64::from(r) * 0.5).ok()?,
            ))
        }),
        (lattice(), lattice(), lattice()).prop_filter_map("no area", |(a, b, c)| {
            Some(Primitive::Triangle(Triangle::new([a, b, c], None).ok()?))
        }),
        // Axis-aligned squares: they lie in split planes.
        (lattice(), 0usize..3, 1u32..=3).prop_filter_map("square", |(corner, axis, side)| {
            let mut u = Vec3::ZERO;
            let mut v = Vec3::ZERO;
            u[(axis + 1) % 3] = f64::from(side);
            v[(axis + 2) % 3] = f64::from(side);
            let loop_ = vec![corner, corner + u, corner + u + v, corner + v];
            Some(Primitive::Polygon(Polygon::new(loop_, None).ok()?))
        }),
        (lattice(), lattice(), 0u32..=2, 0u32..=2).prop_filter_map("cone", |(a, b, r, s)| {
            let (r, s) = (f64::from(r) * 0.5, f64::from(s) * 0.5);
            Some(Primitive::Cone(Cone::new(a, r, b, s).ok()?))
        }),
    ]
}

fn scene_of(objects: Vec<Primitive>) -> Scene {
    Scene::new(SceneParts {
        name: "random".into(),
        material_of: vec![0; objects.len()],
        objects,
        materials: vec![Material::default()],
        lights: Vec::new(),
        background: Vec3::ZERO,
        camera: Camera {
            from: Vec3::new(9.0, 8.0, 7.0),
            at: Vec3::ZERO,
            up: Vec3::Z,
            angle: 45.0,
            hither: 1.0,
            resolution: [8, 8],
        },
        notes: Vec::new(),
    })
}

/// Along axes and diagonals with exact zeros of both signs, from lattice points and from far away;
/// at vertices; along split planes; and at random.
fn ray() -> impl Strategy<Value = Ray> {
    let component = prop_oneof![
        4 => Just(0.0),
        2 => Just(-0.0),
        3 => Just(1.0),
        3 => Just(-1.0),
        1 => Just(5e-324),
        1 => Just(-1e-300),
    ];
    let stiff =
        (component.clone(), component.clone(), component).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    let aimed = (lattice(), lattice(), 0.0f64..3.0).prop_map(|(from, to, away)| {
        let d = to - from;
        (from - d * 10f64.powf(away * 2.0), d)
    });
    let free = (
        prop::array::uniform3(-6.0f64..6.0),
        prop::array::uniform3(-1.0f64..1.0),
    )
        .prop_map(|(o, d)| (Vec3::from_array(o), Vec3::from_array(d)));
    prop_oneof![
        3 => (lattice(), stiff).prop_map(|(o, d)| (o, d)),
        3 => aimed,
        2 => free,
    ]
    .prop_filter("a direction", |(_, d)| d.abs().max_element() > 1e-200)
    .prop_map(|(o, d)| Ray::new(o, d))
}

fn settings() -> impl Strategy<Value = BuildSettings> {
    let methods: Vec<_> = Method::all().filter(|m| m.name != "none").collect();
    (
        prop::sample::select(methods),
        prop::sample::select(OverlapRule::ALL.to_vec()),
        0u32..=14,
        0u32..=3,
        prop::sample::select(vec![0.0, 0.001, 1.0]),
    )
        .prop_map(
            |(method, overlap, depth, n_oilf, root_margin)| BuildSettings {
                overlap,
                d_max: MaxDepth::Fixed(depth),
                n_oilf,
                root_margin,
                ..BuildSettings::for_method(method)
            },
        )
}

fn pool() -> &'static rayon::ThreadPool {
    static POOL: OnceLock<rayon::ThreadPool> = OnceLock::new();
    POOL.get_or_init(|| thread_pool(1).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, max_local_rejects: 1_000_000, failure_persistence: None, rng_seed: RngSeed::Fixed(SEED), ..ProptestConfig::default() })]

    #[test]
    fn a_tree_answers_as_testing_every_object_does(
        objects in prop::collection::vec(primitive(), 0..24),
        rays in prop::collection::vec(ray(), 64),
        settings in settings(),
    ) {
        let scene = scene_of(objects);
        let progress = Progress::new();
        let tree = build(&scene, &settings, &progress).unwrap();
        prop_assert_eq!(validate(&scene, &tree), Ok(()));
        let naive = judge(&scene, &progress).unwrap();
        let mut sample = RaySample::default();
        sample.rays[RayKind::Primary as usize] = rays.clone();
        // Shadow rays end: some before, some on, some beyond what they meet.
        sample.rays[RayKind::Shadow as usize] = rays
            .iter()
            .zip([0.5, 1.0, 2.0, 1e3].into_iter().cycle())
            .map(|(ray, end)| Ray { t_max: end, ..*ray })
            .collect();
        for precision in Precision::ALL {
            let expected = answer(&scene, &naive, precision, &sample, pool(), &progress).unwrap();
            let found = answer(&scene, &tree, precision, &sample, pool(), &progress).unwrap();
            let result = compare(&sample, &expected, &found);
            prop_assert!(result.passed(), "{:?}, {:?}: {:?}", settings, precision, result);
        }
    }
}
