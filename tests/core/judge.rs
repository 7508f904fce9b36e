//! The judge: ties, roundings and faults are told apart, and the intersection tests stand before it.

use crate::support::scenes::scene_of;
use crate::support::tough::{primitive, ray};
use bspscope::geometry::{Ray, Vec3};
use bspscope::measure::judge::{
    Answer, Answerer, Case, Standing, Tolerance, Verdict, examine, scale_of, settle,
};
use bspscope::measure::{ask, unsplit};
use bspscope::primitive::Precision;
use bspscope::primitive::{Cone, Polygon, Primitive, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{BuildSettings, RootMargin};
use bspscope::trace::{Hit, RayKind};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const FAULT_OF_B: Verdict = Verdict::Fault {
    a_is_wrong: false,
    b_is_wrong: true,
};

fn hit(object: u32, t: f64) -> Answer {
    Answer::Nearest(Hit { t, object })
}

const MISS: Answer = Answer::Nearest(Hit::MISS);

/// A triangle across the z axis.
fn across(z: f64) -> Primitive {
    let vertices = [(-1.0, -1.0), (2.0, -1.0), (-1.0, 2.0)].map(|(x, y)| Vec3::new(x, y, z));
    Primitive::Triangle(Triangle::new(vertices, None).unwrap())
}

fn sphere(center: Vec3, radius: f64) -> Primitive {
    Primitive::Sphere(Sphere::new(center, radius).unwrap())
}

fn within(scene: &Scene, ray: &Ray, precision: Precision) -> Option<Tolerance> {
    Some(Tolerance::of(precision, scale_of(scene, ray)))
}

#[test]
fn objects_at_the_same_distance_tie_and_those_behind_do_not() {
    let scene = scene_of(vec![across(3.0), across(3.0), across(3.5)]);
    let up = Ray::new(Vec3::ZERO, Vec3::Z);
    assert_eq!(
        settle(&scene, &up, [hit(0, 3.0), hit(1, 3.0)], None),
        Verdict::Tie
    );
    assert_eq!(
        settle(&scene, &up, [hit(0, 3.0), hit(2, 3.5)], None),
        FAULT_OF_B
    );
    assert_eq!(settle(&scene, &up, [hit(0, 3.0), MISS], None), FAULT_OF_B);
    let blocked = [Answer::Blocked(true), Answer::Blocked(false)];
    assert_eq!(settle(&scene, &up, blocked, None), FAULT_OF_B);
    // One object at two distances is no tie.
    let fault = settle(&scene, &up, [hit(0, 3.0), hit(0, 3.0f64.next_up())], None);
    assert!(matches!(fault, Verdict::Fault { .. }));
}

#[test]
fn what_is_nearer_by_the_least_is_nearer_unless_numbers_were_rounded() {
    let scene = scene_of(vec![across(3.0), across(3.0f64.next_up())]);
    let up = Ray::new(Vec3::ZERO, Vec3::Z);
    let answers = [hit(0, 3.0), hit(1, 3.0f64.next_up())];
    assert_eq!(settle(&scene, &up, answers, None), FAULT_OF_B);
    for precision in [Precision::F64, Precision::F32] {
        let rounding = within(&scene, &up, precision);
        assert_eq!(settle(&scene, &up, answers, rounding), Verdict::Rounding);
    }
    // 1e-6 apart can be mixed up in f32 and not in f64; 1e-3 in neither.
    let scene = scene_of(vec![across(3.0), across(3.0 + 1e-6), across(3.0 + 1e-3)]);
    for (object, z, f64_says, f32_says) in [
        (1, 3.0 + 1e-6, FAULT_OF_B, Verdict::Rounding),
        (2, 3.0 + 1e-3, FAULT_OF_B, FAULT_OF_B),
    ] {
        let answers = [hit(0, 3.0), hit(object, z)];
        let verdict = |p| settle(&scene, &up, answers, within(&scene, &up, p));
        assert_eq!(verdict(Precision::F64), f64_says);
        assert_eq!(verdict(Precision::F32), f32_says);
    }
}

#[test]
fn edges_and_tangents_may_be_hit_or_not() {
    let square = [(0.0, -1.0), (2.0, -1.0), (2.0, 1.0), (0.0, 1.0)];
    let square = square.map(|(x, y)| Vec3::new(x, y, 2.0)).to_vec();
    let cylinder = |r: f64, s: f64| {
        let (base, apex) = (Vec3::new(-3.0, 1.0, 2.0), Vec3::new(3.0, 1.0, 2.0));
        Primitive::Cone(Cone::new(base, r, apex, s).unwrap())
    };
    let objects = [
        Primitive::Polygon(Polygon::new(square, None).unwrap()),
        sphere(Vec3::new(0.0, 1.0, 2.0), 1.0),
        cylinder(1.0, 1.0),
        cylinder(0.5, 1.5),
    ];
    for object in objects {
        let name = format!("{object:?}");
        let scene = scene_of(vec![object]);
        let up = Ray::new(Vec3::ZERO, Vec3::Z);
        assert_eq!(
            settle(&scene, &up, [hit(0, 2.0), MISS], None),
            Verdict::Tie,
            "{name}"
        );
        // The least to either side, it is certain.
        for (shift, a, b) in [(1e-300, false, true), (-1e-300, true, false)] {
            let origin = match scene.objects()[0] {
                Primitive::Polygon(_) => Vec3::X * shift,
                _ => Vec3::Y * shift,
            };
            let ray = Ray::new(origin, Vec3::Z);
            let expected = Verdict::Fault {
                a_is_wrong: a,
                b_is_wrong: b,
            };
            assert_eq!(
                settle(&scene, &ray, [hit(0, 2.0), MISS], None),
                expected,
                "{name}"
            );
            let rounding = within(&scene, &ray, Precision::F64);
            let verdict = settle(&scene, &ray, [hit(0, 2.0), MISS], rounding);
            assert_eq!(verdict, Verdict::Rounding, "{name}");
        }
    }
}

#[test]
fn the_far_side_of_a_sphere_or_cylinder_is_not_its_near_side() {
    let cylinder = Cone::new(
        Vec3::new(-1.0, 0.0, 5.0),
        1.0,
        Vec3::new(1.0, 0.0, 5.0),
        1.0,
    );
    for object in [
        sphere(Vec3::Z * 5.0, 1.0),
        Primitive::Cone(cylinder.unwrap()),
    ] {
        let scene = scene_of(vec![object, across(5.0)]);
        let up = Ray::new(Vec3::ZERO, Vec3::Z);
        for wrong in [hit(0, 6.0), hit(1, 5.0), MISS] {
            assert_eq!(settle(&scene, &up, [hit(0, 4.0), wrong], None), FAULT_OF_B);
        }
        // From inside, what is behind does not count; on the surface, it may.
        let inside = Ray::new(Vec3::Z * 4.5, Vec3::Z);
        assert_eq!(
            settle(&scene, &inside, [hit(1, 0.5), hit(0, 1.5)], None),
            FAULT_OF_B
        );
        let on_it = Ray::new(Vec3::Z * 4.0, Vec3::Z);
        assert_eq!(
            settle(&scene, &on_it, [hit(0, 0.0), hit(1, 1.0)], None),
            Verdict::Tie
        );
        // A shadow ray that ends just there may be blocked or not.
        let blocked = [Answer::Blocked(true), Answer::Blocked(false)];
        let to_it = Ray::to(Vec3::ZERO, Vec3::Z, 4.0);
        assert_eq!(settle(&scene, &to_it, blocked, None), Verdict::Tie);
        let beyond = Ray::to(Vec3::ZERO, Vec3::Z, 4.0f64.next_up());
        assert_eq!(settle(&scene, &beyond, blocked, None), FAULT_OF_B);
    }
}

#[test]
fn a_line_in_the_surface_has_no_hit() {
    let up = Ray::new(Vec3::new(1.0, 0.0, -5.0), Vec3::Z);
    let cylinder = Cone::new(Vec3::ZERO, 1.0, Vec3::Z, 1.0).unwrap();
    let upright = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    for object in [
        Primitive::Cone(cylinder),
        Primitive::Triangle(Triangle::new(upright, None).unwrap()),
    ] {
        let scene = scene_of(vec![object]);
        assert_eq!(settle(&scene, &up, [MISS, hit(0, 5.0)], None), FAULT_OF_B);
    }
}

#[test]
fn crossing_and_concave_outlines_follow_the_even_odd_rule() {
    // A bow tie and an L, each with a point inside and one in what it leaves out.
    let bow = [(-1.0, -1.0), (1.0, 1.5), (1.0, -1.0), (-1.0, 1.0)];
    let ell = [
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (1.0, 1.0),
        (1.0, 2.0),
        (0.0, 2.0),
    ];
    for (outline, inside, outside) in [
        (&bow[..], (0.75, 0.1), (0.0, 0.5)),
        (&ell[..], (0.5, 1.5), (1.5, 1.5)),
    ] {
        let vertices = outline.iter().map(|&(x, y)| Vec3::new(x, y, 1.0)).collect();
        let polygon = Polygon::new(vertices, None).unwrap();
        let scene = scene_of(vec![Primitive::Polygon(polygon)]);
        for ((x, y), right, wrong) in [(inside, hit(0, 1.0), MISS), (outside, MISS, hit(0, 1.0))] {
            let ray = Ray::new(Vec3::new(x, y, 0.0), Vec3::Z);
            assert_eq!(settle(&scene, &ray, [right, wrong], None), FAULT_OF_B);
        }
    }
}

#[test]
fn a_case_reads_back_as_it_was_written() {
    let third = 1.0 / 3.0;
    let scene = scene_of(vec![
        across(third),
        sphere(Vec3::new(0.1, -0.0, 1e-310), third),
    ]);
    for (t_max, kind, expected, found) in [
        (f64::INFINITY, RayKind::Reflected, hit(0, third), MISS),
        (
            0.7,
            RayKind::Shadow,
            Answer::Blocked(true),
            Answer::Blocked(false),
        ),
    ] {
        let direction = Vec3::new(5e-324, -0.0, 1.0f64.next_down());
        let case = Case {
            scene: scene.clone(),
            by: Answerer::Tree(BuildSettings {
                root_margin: RootMargin::Length(0.1 + 0.2),
                ..BuildSettings::default()
            }),
            kind,
            ray: Ray::to(Vec3::splat(-0.1), direction, t_max),
            expected,
            found,
        };
        let text = case.to_json();
        let read = Case::from_json(&text).unwrap();
        assert_eq!(format!("{:?}", read.ray), format!("{:?}", case.ray));
        assert_eq!(read.scene.objects(), case.scene.objects());
        assert_eq!((read.expected, read.found), (expected, found));
        assert_eq!(read.by, case.by);
        // Both say the same: what the case tells was made up.
        assert_eq!(read.replay().unwrap(), None);
    }
    assert!(Case::from_json("{}").is_err());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, max_local_rejects: 1_000_000, failure_persistence: None, rng_seed: RngSeed::Fixed(2), ..ProptestConfig::default() })]

    /// The judge shares no formula with the kernels: neither can hide the other's mistake.
    #[test]
    fn intersection_tests_are_right_but_for_rounding(
        objects in prop::collection::vec(primitive(), 1..12),
        rays in prop::collection::vec(ray(), 32),
    ) {
        let scene = scene_of(objects);
        let tree = unsplit(&scene, &Progress::new()).unwrap();
        for ray in rays {
            let tolerance = Tolerance::of(Precision::F64, scale_of(&scene, &ray));
            for (kind, ray) in [(RayKind::Primary, ray), (RayKind::Shadow, Ray { t_max: 1.0, ..ray })] {
                let answer = ask(&scene, &tree, kind, &ray);
                let standing = examine(&scene, &ray, answer, tolerance);
                prop_assert_ne!(standing, Standing::Wrong, "{:?} {:?}", ray, answer);
            }
        }
    }
}
