//! Measures beyond the paper: SAH cost, overlap, box tests, leaf deviation, break-even.

use crate::support::scenes::{render_sized, scene, scene_of, settings, tree_by, tree_with};
use bspscope::geometry::{Aabb, Vec3};
use bspscope::measure::{
    BreakEven, Comparison, Measured, Measurement, Times, TreeFacts, measure, parameter, ray_figures,
};
use bspscope::primitive::{Polygon, Primitive, Shape, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{BuildSettings, NodeKind, Tree, TreeIndex};
use bspscope::trace::{RayKind, TimedRender, record_pixel};
use std::time::Duration;

fn measured_with(scene: &Scene, build: &BuildSettings) -> Measured {
    let render = render_sized(scene, [40, 30]);
    measure(scene, build, &render, &Progress::new()).unwrap()
}

fn measured(scene: &Scene, method: &str) -> Measured {
    measured_with(scene, &settings(method))
}

fn value(of: &Measured, symbol: &str) -> Option<f64> {
    parameter(symbol).value(&of.measurement)
}

#[track_caller]
fn assert_near(found: Option<f64>, expected: f64, tolerance: f64) {
    let found = found.expect("a value");
    assert!(
        (found - expected).abs() <= tolerance,
        "{found}, expected {expected}"
    );
}

/// A rectangle at z = 0 from `x` to `x` + 2, of height 1.
fn rectangle(x: f64) -> Primitive {
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    let corners = corners.map(|[dx, y]| Vec3::new(x + dx, y, 0.0));
    Primitive::Polygon(Polygon::new(corners.to_vec(), None).unwrap())
}

#[test]
fn two_rectangles_that_overlap_have_the_costs_computed_by_hand() {
    let scene = scene_of(vec![rectangle(0.0), rectangle(1.0)]);
    let mut one_each = settings("bvh-sweep");
    one_each.constants.insert("max-leaf".into(), 1.0);
    let of = measured_with(&scene, &one_each);
    assert_eq!(of.measurement.tree.leaves, 2);
    // Boxes are wider than rounding, in `f32`.
    assert_near(value(&of, "C_SAH"), 1.2 + 8.0 / 6.0, 1e-5);
    assert_near(value(&of, "EPO"), 0.5, 1e-5);
    assert_eq!(value(&of, "F_W"), Some(1.0));
    assert_eq!(value(&of, "N_MOIL"), Some(1.0));
    assert_eq!(value(&of, "D_LEAF"), Some(1.0));
    assert_eq!(value(&of, "M_NODE"), Some(32.0));
    assert_eq!(
        value(&of, "M_TREE/N_O"),
        Some((3 * 32 + 2 * 4) as f64 / 2.0)
    );
}

#[test]
fn cells_of_planes_do_not_overlap() {
    let scene = scene("balls:2");
    for method in ["midpoint", "sah-cut", "octree", "grid"] {
        let of = measured(&scene, method);
        for symbol in ["EPO", "V_SOV", "N_BT", "N_BT/ray"] {
            assert_eq!(value(&of, symbol), Some(0.0), "{method} {symbol}");
        }
        for symbol in ["F_W", "V_LEAF/V_ROOT", "N_CULL"] {
            assert_eq!(value(&of, symbol), None, "{method} {symbol}");
        }
        let tests = if method == "grid" {
            "N_VLS"
        } else {
            "N_INODES"
        };
        assert_eq!(value(&of, "N_PT"), value(&of, tests), "{method}");
    }
    let grid = measured(&scene, "grid");
    for symbol in ["C_SAH", "D_LEAF", "D_MAX", "N_OILF"] {
        assert_eq!(value(&grid, symbol), None, "{symbol}");
    }
    let bvh = measured(&scene, "bvh-sweep");
    for symbol in [
        "EPO",
        "V_SOV",
        "N_BT",
        "N_BT/ray",
        "N_CULL",
        "F_W",
        "V_LEAF/V_ROOT",
        "D_MAX",
    ] {
        assert!(
            value(&bvh, symbol).is_some_and(|value| value > 0.0),
            "{symbol}"
        );
    }
    assert_near(value(&bvh, "N_PT"), 6.0 * value(&bvh, "N_BT").unwrap(), 0.0);
}

#[test]
fn the_sah_cost_of_a_kd_tree_is_what_a_line_through_it_expects() {
    let scene = scene("tetra:3");
    for method in ["midpoint", "sah-cut"] {
        let tree = tree_by(&scene, method);
        let index = TreeIndex::new(&tree, scene.objects().len());
        let leaves = (0..tree.nodes().len() as u32)
            .filter(|&node| matches!(tree.kind(node), NodeKind::Leaf { .. }));
        let leaf_area: f64 = leaves.map(|leaf| index.of(leaf).area).sum();
        let root = index.of(0);
        let expected = root.expected_visits + root.tests - leaf_area / root.area;
        let facts = TreeFacts::of(&tree);
        let cost = (facts.inner_area + facts.test_area) / facts.root_area;
        assert_near(Some(cost), expected, 1e-9 * expected);
    }
}

/// The end-point overlap of triangles from its definition, with areas from clipping to one node at a time.
fn overlap_by_definition(scene: &Scene, tree: &Tree) -> f64 {
    let index = TreeIndex::new(tree, scene.objects().len());
    let corners = |object: &Primitive| match object {
        Primitive::Triangle(Triangle { vertices, .. }) => *vertices,
        _ => unreachable!("triangles only"),
    };
    let area = |points: &[Vec3]| {
        let fan = (2..points.len()).map(|i| {
            let [a, b] = [i - 1, i].map(|k| points[k] - points[0]);
            a.cross(b)
        });
        0.5 * fan.sum::<Vec3>().length()
    };
    let clipped = |mut points: Vec<Vec3>, cell: &Aabb| {
        for k in 0..3 {
            for (limit, side) in [(cell.lo[k], 1.0), (cell.hi[k], -1.0)] {
                let from = points.clone();
                points.clear();
                for (i, &a) in from.iter().enumerate() {
                    let b = from[(i + 1) % from.len()];
                    let [da, db] = [a, b].map(|p| (p[k] - limit) * side);
                    if da >= 0.0 {
                        points.push(a);
                    }
                    if (da < 0.0) != (db < 0.0) {
                        points.push(a + (b - a) * (da / (da - db)));
                    }
                }
            }
        }
        points
    };
    let (mut whole, mut sum) = (0.0, 0.0);
    for (number, object) in scene.objects().iter().enumerate() {
        whole += area(&corners(object));
        for cell in tree.cells() {
            let below = cell.node..index.of(cell.node).end;
            let leaves = index.leaves_of(number as u32);
            if leaves.iter().any(|leaf| below.contains(leaf)) {
                continue;
            }
            let cost = match tree.kind(cell.node) {
                NodeKind::Inner => 1.2,
                NodeKind::Leaf { count, .. } => f64::from(count),
            };
            if object.bounds().touches(&cell.bounds) {
                sum += cost * area(&clipped(corners(object).to_vec(), &cell.bounds));
            }
        }
    }
    sum / whole
}

#[test]
fn end_point_overlap_agrees_with_its_definition_for_every_width() {
    // Large triangles in disorder, so that boxes overlap much.
    let mut random = 1_u64;
    let mut next = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (random >> 40) as f64 / f64::from(1 << 24)
    };
    let mut point = |at: Vec3| at + Vec3::new(next(), next(), next());
    let objects = (0..200).map(|_| {
        let center = 2.0 * point(Vec3::ZERO);
        let corners = [point(center), point(center), point(center)];
        Primitive::Triangle(Triangle::new(corners, None).unwrap())
    });
    let scene = scene_of(objects.collect());
    for method in ["bvh-sweep", "bvh-binned"] {
        for width in [2.0, 4.0, 8.0] {
            let mut settings = settings(method);
            settings.constants.insert("width".into(), width);
            let tree = tree_with(&scene, &settings);
            let mut facts = TreeFacts::of(&tree);
            assert_eq!((facts.end_point_overlap, facts.empty_volume), (None, None));
            facts
                .find_overlaps(&scene, &tree, &Progress::new())
                .unwrap();
            let expected = overlap_by_definition(&scene, &tree);
            assert!(expected > 0.1);
            assert_near(facts.end_point_overlap, expected, 1e-9 * expected);
        }
    }
}

#[test]
fn the_empty_volume_of_a_hierarchy_is_outside_of_the_union_of_its_leaves() {
    let ball = |x: f64| Primitive::Sphere(Sphere::new(Vec3::new(x, 0.0, 0.0), 1.0).unwrap());
    let scene = scene_of(vec![ball(0.0), ball(1.0), ball(9.0)]);
    let mut one_each = settings("bvh-sweep");
    one_each.constants.insert("max-leaf".into(), 1.0);
    one_each.constants.insert("cost-traversal".into(), 0.0);
    let of = measured_with(&scene, &one_each);
    assert_eq!(of.measurement.tree.leaves, 3);
    let root = of.measurement.tree.root_volume;
    // The first two cubes have half of a cube in common.
    assert_near(value(&of, "V_EMPTY"), root - 20.0, 1e-4);
    assert_near(value(&of, "R_FVWV"), 20.0 / root, 1e-5);
    assert_near(value(&of, "V_LEAF/V_ROOT"), 24.0 / root, 1e-5);
    assert_near(value(&of, "V_SOV"), 4.0 / root, 1e-5);
}

#[test]
fn counters_are_those_of_recorded_paths() {
    let scene = scene("balls:2");
    for method in ["bvh-sweep", "bvh-binned", "sah-cut"] {
        let of = measured(&scene, method);
        let (mut rays, mut leaves, mut squares) = (0_u64, 0_u64, 0_u64);
        let mut sums = [0_u64; 4];
        for y in 0..30 {
            for x in 0..40 {
                let render = &of.measurement.render;
                let record = record_pixel(&scene, &of.tree, render, [x, y]).unwrap();
                for ray in &record.rays {
                    let counts = ray.path.counts();
                    let of_ray = [
                        counts.box_tests,
                        counts.culled,
                        counts.tests,
                        counts.test_hits,
                    ];
                    for (sum, count) in sums.iter_mut().zip(of_ray) {
                        *sum += u64::from(count);
                    }
                    rays += 1;
                    leaves += u64::from(counts.leaves);
                    squares += u64::from(counts.leaves).pow(2);
                }
            }
        }
        let [box_tests, culled, tests, hits] = sums.map(|sum| sum as f64);
        assert_eq!(value(&of, "N_BT"), Some(box_tests), "{method}");
        assert_eq!(value(&of, "N_BT/ray"), Some(box_tests / rays as f64));
        let is_bvh = method.starts_with("bvh");
        assert_eq!(is_bvh, box_tests > 0.0);
        assert_eq!(value(&of, "N_CULL"), is_bvh.then_some(culled));
        assert_eq!(value(&of, "U_LEAF"), Some(hits / tests));
        assert!(hits > 0.0 && hits <= tests);
        let mean = leaves as f64 / rays as f64;
        let deviation = (squares as f64 / rays as f64 - mean * mean).sqrt();
        assert_near(value(&of, "LCV"), deviation, 1e-9);
        let facts = &of.measurement;
        let nodes = match is_bvh {
            true => 32.0 * (box_tests + rays as f64),
            false => 8.0 * value(&of, "N_NODES").unwrap(),
        };
        let per_object = facts.object_bytes as f64 / facts.scene.objects as f64;
        let bytes = (nodes + (4.0 + per_object) * tests) / rays as f64;
        assert_near(value(&of, "B_RAY"), bytes, 1e-9 * bytes);
    }
}

#[test]
fn leaves_per_ray_deviate_by_kind_as_computed_by_hand() {
    // Half of the rays visit one leaf, the others three.
    let mut of = measured(&scene("balls:1"), "bvh-sweep").measurement;
    let counted = of.counted.as_mut().unwrap();
    let [primary, shadow] = [RayKind::Primary, RayKind::Shadow].map(|kind| kind as usize);
    counted.tallies = Default::default();
    (
        counted.tallies[primary].rays,
        counted.tallies[primary].leaves,
    ) = (10, 20);
    (counted.tallies[shadow].rays, counted.tallies[shadow].leaves) = (10, 60);
    counted.leaves_squared = [0; 4];
    counted.leaves_squared[primary] = 5 + 5 * 9;
    counted.leaves_squared[shadow] = 10 * 36;
    let figure = ray_figures().iter().find(|f| f.key == "leaves_deviation");
    let figure = figure.expect("a figure");
    assert_eq!(figure.of(&of, RayKind::Primary), Some(1.0));
    assert_eq!(figure.of(&of, RayKind::Shadow), Some(0.0));
    assert_eq!(figure.of(&of, RayKind::Reflected), None);
    // All together: mean 4, mean square 20.5.
    assert_near(parameter("LCV").value(&of), 4.5f64.sqrt(), 1e-12);
}

/// A measurement in which building took these milliseconds, and 1000 rays these.
fn timed(measurement: &Measurement, build: u64, rays: u64) -> Measurement {
    Measurement {
        building: Times {
            cpu: Duration::from_millis(build),
            ..Times::default()
        },
        rendering: Some(TimedRender {
            rays: 1000,
            tracing: Duration::from_millis(rays),
            ..TimedRender::default()
        }),
        ..measurement.clone()
    }
}

#[test]
fn a_tree_breaks_even_when_its_rays_made_up_for_its_build() {
    let of = measured(&scene("balls:1"), "bvh-sweep").measurement;
    let slow = timed(&of, 100, 10);
    let Some(BreakEven::Rays(rays)) = BreakEven::of(&slow, &timed(&of, 150, 5)) else {
        panic!("it pays off");
    };
    // 50 ms more, 5 µs less per ray.
    assert!((rays - 10_000.0).abs() < 1e-6, "{rays}");
    for build in [100, 50] {
        let faster = timed(&of, build, 5);
        assert_eq!(BreakEven::of(&slow, &faster), Some(BreakEven::Rays(0.0)));
    }
    for rays in [10, 11] {
        assert_eq!(
            BreakEven::of(&slow, &timed(&of, 50, rays)),
            Some(BreakEven::Never)
        );
    }
    let untimed = Measurement {
        rendering: None,
        ..of
    };
    assert_eq!(BreakEven::of(&slow, &untimed), None);
    assert_near(parameter("rays/s").value(&slow), 1e5, 1e-6);
}

#[test]
fn nodes_of_different_structures_have_different_units() {
    let scene = scene("balls:1");
    let mut wide = settings("bvh-sweep");
    wide.constants.insert("width".into(), 4.0);
    let [kd, octree, grid, bvh] =
        ["sah-cut", "octree", "grid", "bvh-sweep"].map(|method| measured(&scene, method));
    let wide = measured_with(&scene, &wide);
    let is_other = |symbol: &str, a: &Measured, b: &Measured| {
        parameter(symbol).compare(&a.measurement, &b.measurement) == Comparison::OtherUnit
    };
    for symbol in ["N_AT", "N_NODES"] {
        assert!(
            is_other(symbol, &kd, &grid) && is_other(symbol, &kd, &bvh),
            "{symbol}"
        );
        assert!(
            is_other(symbol, &bvh, &wide) && !is_other(symbol, &kd, &octree),
            "{symbol}"
        );
    }
    for symbol in ["N_INODES", "N_IN", "D_REACH", "D_LEAF"] {
        assert!(
            is_other(symbol, &kd, &bvh) && is_other(symbol, &bvh, &wide),
            "{symbol}"
        );
    }
    for symbol in ["N_RPRT", "N_LS", "N_PT", "B_RAY", "N_VLS", "T_TR", "C_SAH"] {
        assert!(
            !is_other(symbol, &kd, &bvh) && !is_other(symbol, &bvh, &wide),
            "{symbol}"
        );
    }
    let nodes = ray_figures().iter().find(|f| f.key == "nodes_mean");
    let compared = nodes.map(|f| f.compare(&kd.measurement, &bvh.measurement, RayKind::Primary));
    assert_eq!(compared, Some(Comparison::OtherUnit));
}
