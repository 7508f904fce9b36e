//! The torture set: every case by every method is right.

use crate::support::scenes::{scene, scene_of};
use bspscope::geometry::Vec3;
use bspscope::measure::stability::{CASES, Cell, KERNELS, Outcome, Trial, run};
use bspscope::primitive::{Precision, Primitive, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::{Scene, builtin};
use bspscope::structure::Method;
use bspscope::structure::split::Structure;
use bspscope::trace::thread_pool;
use std::collections::BTreeSet;

fn matrix(scene: Option<&Scene>, methods: &[Method]) -> Vec<Cell> {
    run(
        scene,
        methods,
        true,
        &thread_pool(0).unwrap(),
        &Progress::new(),
    )
    .unwrap()
}

/// Cases with objects too small beside others, or too thin, for 24 bits.
const NOT_IN_F32: [&str; 4] = [
    "cylinders and cones",
    "earth-sized ground",
    "mixed sizes",
    "slivers",
];

fn assert_right(cells: &[Cell]) {
    let wrong: Vec<_> = cells
        .iter()
        .filter(|cell| matches!(cell.outcome, Outcome::Fail { .. }))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_case_is_right_by_every_kind_of_method() {
    // Of hierarchies, one that keeps objects whole and one that splits them: the others differ in the order of
    // nodes alone, and `bspscope stability` runs them.
    let is_tried = |m: &Method| {
        let is_hierarchy = m.structure == Structure::Bvh;
        m.name != "none" && (!is_hierarchy || ["bvh-sweep", "bvh-spatial"].contains(&m.name))
    };
    let methods: Vec<Method> = Method::all().filter(is_tried).collect();
    let cells = matrix(None, &methods);
    let cases: usize = CASES.iter().map(|(_, cases)| cases.len()).sum();
    assert!(cases >= 30 && methods.len() >= 3);
    assert_eq!(cells.len(), cases * methods.len() * KERNELS.len());
    assert_right(&cells);
    // Nothing passed because nothing was asked.
    let mut not_in_f32 = BTreeSet::new();
    for cell in &cells {
        match cell.outcome {
            Outcome::Pass { rays } => {
                let asks = ["transforms", "rays"].contains(&cell.theme);
                assert!(!asks || rays >= 20, "{cell:?}");
            }
            _ => {
                assert_eq!(cell.precision, Precision::F32);
                not_in_f32.insert(cell.case);
            }
        }
    }
    // What f32 cannot hold is known; the rest passes in it, too.
    assert_eq!(not_in_f32.into_iter().collect::<Vec<_>>(), NOT_IN_F32);
}

#[test]
fn the_cases_for_any_scene_are_right_on_generated_ones() {
    let applicable: usize = CASES
        .iter()
        .map(|(_, c)| c.iter().filter(|c| c.any_scene).count())
        .sum();
    for (name, size) in [("tetra", 3), ("rings", 1)] {
        let scene = Scene::new(builtin::generate(name, Some(size)).unwrap());
        let cells = matrix(Some(&scene), &Method::of_the_paper());
        assert_eq!(cells.len(), applicable * 2 * KERNELS.len());
        assert_right(&cells);
    }
}

/// A sphere of triangles, in rings from pole to pole.
fn ball_of_triangles(around: u32, rings: u32) -> Scene {
    let vertex = |i: u32, j: u32| {
        let (turn, tilt) = (
            std::f64::consts::TAU * f64::from(i % around) / f64::from(around),
            std::f64::consts::PI * f64::from(j) / f64::from(rings),
        );
        let across = libm::sin(tilt);
        Vec3::new(
            across * libm::cos(turn),
            across * libm::sin(turn),
            libm::cos(tilt),
        )
    };
    let mut objects = Vec::new();
    for i in 0..around {
        for j in 0..rings {
            let [a, b] = [vertex(i, j), vertex(i + 1, j)];
            let [c, d] = [vertex(i + 1, j + 1), vertex(i, j + 1)];
            for corners in [[a, b, c], [a, c, d]] {
                objects.extend(Triangle::new(corners, None).ok().map(Primitive::Triangle));
            }
        }
    }
    scene_of(objects)
}

/// A mesh, a symmetric scene with many ties, and all kinds of objects.
#[test]
fn a_scaled_scene_keeps_its_tree_by_every_method() {
    let case = CASES
        .iter()
        .flat_map(|(_, cases)| cases.iter())
        .find(|case| case.name == "tree of a scaled scene")
        .unwrap();
    let ball = ball_of_triangles(20, 14);
    assert!(ball.objects().len() > 500);
    let mut wrong = Vec::new();
    for (name, scene) in [
        ("ball", ball),
        ("tetra:3", scene("tetra:3")),
        ("teaching", scene("teaching")),
    ] {
        for method in Method::all() {
            for kernel in KERNELS {
                let trial = Trial {
                    scene: Some(&scene),
                    method,
                    kernel,
                    quick: true,
                    progress: &Progress::new(),
                };
                let outcome = (case.run)(&trial);
                if !matches!(outcome, Outcome::Pass { rays } if rays > 500) {
                    wrong.push((name, method.name, kernel.precision, outcome));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
