//! Builders of bounding volume hierarchies: valid trees for any width, the hits of testing every object, the
//! same tree for any number of threads, degenerate scenes, and costs next to those of another library.

use crate::support::random::Random;
use crate::support::scenes::{self, scene, scene_of, tree_with};
use bspscope::geometry::{Aabb, Vec3};
use bspscope::measure::exact::check_exactly;
use bspscope::measure::{answer, compare, sample_rays, unsplit};
use bspscope::primitive::{Cone, Polygon, Precision, Primitive, Shape, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::split::Structure;
use bspscope::structure::{
    BuildError, BuildSettings, Constants, MaxDepth, Method, NodeKind, StopReason, Tree, build,
    validate,
};
use bspscope::trace::{RenderSettings, thread_pool};
use glam::Vec3A;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::time::{Duration, Instant};

const SCENES: [&str; 6] = [
    "teaching",
    "balls:2",
    "tetra:3",
    "m-fluid:1",
    "rings:2",
    "room",
];

fn builders() -> impl Iterator<Item = Method> {
    Method::all().filter(|method| method.structure == Structure::Bvh)
}

fn with(method: &str, constants: &[(&str, f64)]) -> BuildSettings {
    BuildSettings {
        constants: Constants::from_iter(constants.iter().map(|&(k, v)| (k.to_owned(), v))),
        ..scenes::settings(method)
    }
}

/// The settings of all builders with all widths.
fn settings() -> Vec<BuildSettings> {
    let widths = [2.0, 4.0, 8.0];
    let of = |method: Method| widths.map(|width| with(method.name, &[("width", width)]));
    let all: Vec<BuildSettings> = builders().flat_map(of).collect();
    assert!(all.len() >= 3 * 7);
    all
}

fn checked(scene: &Scene, settings: &BuildSettings) -> Tree {
    let tree = tree_with(scene, settings);
    if let Err(wrong) = validate(scene, &tree) {
        panic!("{} by {settings:?}: {wrong}", scene.name());
    }
    tree
}

/// Returns the cost of a tree by the surface-area heuristic, with the default costs.
fn cost(tree: &Tree) -> f64 {
    let sum: f64 = tree
        .cells()
        .map(|cell| {
            let cost = match tree.kind(cell.node) {
                NodeKind::Inner => 1.2,
                NodeKind::Leaf { count, .. } => f64::from(count),
            };
            cost * cell.bounds.surface_area()
        })
        .sum();
    sum / tree.root().bounds.surface_area()
}

fn cost_by(scene: &Scene, method: &str, constants: &[(&str, f64)]) -> f64 {
    cost(&checked(scene, &with(method, constants)))
}

fn point(at: Vec3) -> Primitive {
    Primitive::Sphere(Sphere::new(at, 0.0).unwrap())
}

fn triangle(corners: [Vec3; 3]) -> Primitive {
    Primitive::Triangle(Triangle::new(corners, None).unwrap())
}

#[test]
fn trees_of_any_width_are_valid_and_do_not_depend_on_threads() {
    let pools = [1, 2].map(|threads| thread_pool(threads).unwrap());
    for name in SCENES {
        let scene = scene(name);
        for settings in settings() {
            let [one, two] = pools
                .each_ref()
                .map(|pool| pool.install(|| checked(&scene, &settings)));
            assert!(one.nodes() == two.nodes(), "{name}: {settings:?}");
            assert!(one.references() == two.references(), "{name}: {settings:?}");
        }
    }
    // Large enough to be divided among threads.
    let many = scene("balls:4");
    assert!(many.objects().len() > 7000);
    for method in builders() {
        let settings = BuildSettings::for_method(method);
        let [one, two] = pools
            .each_ref()
            .map(|pool| pool.install(|| checked(&many, &settings)));
        assert!(one.nodes() == two.nodes(), "{settings:?}");
        assert!(one.references() == two.references(), "{settings:?}");
    }
}

/// The box of an inner node is the union of those of its children, no node has more children than asked for, and
/// every object is in a leaf.
#[test]
fn boxes_are_unions_and_every_object_is_in_a_leaf() {
    for name in SCENES {
        let scene = scene(name);
        for settings in settings() {
            let tree = checked(&scene, &settings);
            let width = settings.constant("width") as usize;
            let mut is_held = vec![false; scene.objects().len()];
            let mut widest = 0;
            for cell in tree.cells() {
                let children: Vec<_> = tree.children(&cell).collect();
                widest = widest.max(children.len());
                let boxes = children.iter().map(|child| child.bounds);
                if let Some(union) = boxes.reduce(|a, b| a.union(&b)) {
                    assert_eq!(union, cell.bounds, "{name}: {settings:?}");
                }
                for &object in tree.leaf_objects(cell.node) {
                    is_held[object as usize] = true;
                }
            }
            assert!(is_held.iter().all(|&held| held), "{name}: {settings:?}");
            assert!(widest <= width, "{name}: {widest} children");
            assert!(scene.objects().len() < 100 || widest == width);
            let root = tree.root().bounds;
            let size = scene.bounds().size().max_element();
            assert!((root.lo - scene.bounds().lo).abs().max_element() < 1e-5 * size);
            assert!((root.hi - scene.bounds().hi).abs().max_element() < 1e-5 * size);
        }
    }
}

#[test]
fn hits_are_those_of_testing_every_object() {
    let (pool, progress) = (thread_pool(0).unwrap(), Progress::new());
    for name in SCENES {
        let scene = scene(name);
        let everything = unsplit(&scene, &progress).unwrap();
        let render = RenderSettings::for_camera(*scene.camera());
        let rays = sample_rays(&scene, &everything, &render, 400, &pool, &progress).unwrap();
        let answers = |tree: &Tree| {
            let of = |p| answer(&scene, tree, p, &rays, &pool, &progress).unwrap();
            Precision::ALL.map(of)
        };
        let expected = answers(&everything);
        for settings in settings() {
            let found = answers(&tree_with(&scene, &settings));
            for (expected, found) in expected.iter().zip(&found) {
                let result = compare(&scene, &rays, expected, found, None);
                assert!(result.rays[0] >= 400 && result.rays[1] > 0);
                assert!(
                    result.is_identical(),
                    "{name} by {settings:?}: {:?}",
                    result.others
                );
            }
        }
    }
}

/// Long and slanted objects of all kinds, many of which are split.
fn needles() -> Scene {
    let mut random = Random(7);
    let mut objects = Vec::new();
    while objects.len() < 240 {
        let (a, b) = (random.vector(), random.vector());
        let [c, d] = [(); 2].map(|()| 0.03 * random.vector());
        let radius = random.within(0.0, 0.04);
        objects.extend(
            [
                Triangle::new([a, b, b + c], None).map(Primitive::Triangle),
                Polygon::new(vec![b, a, a + d, b + d], None).map(Primitive::Polygon),
                Cone::new(a, radius, -b, 0.01).map(Primitive::Cone),
                Sphere::new(a, 5.0 * radius).map(Primitive::Sphere),
            ]
            .into_iter()
            .flatten(),
        );
    }
    scene_of(objects)
}

#[test]
fn parts_of_objects_have_exactly_the_hits_of_the_objects() {
    let needles = needles();
    let pool = thread_pool(0).unwrap();
    let split = ["bvh-spatial", "bvh-presplit"].map(|method| {
        let tree = checked(&needles, &with(method, &[("budget", 4.0)]));
        let (parts, objects) = (tree.references().len(), needles.objects().len());
        assert!(parts > objects * 4 / 3, "{method}: {parts} of {objects}");
        assert!(parts <= 5 * objects, "{method}: {parts} of {objects}");
        tree
    });
    let render = RenderSettings::default();
    let check = check_exactly(&needles, &split, &render, 1500, &pool, &Progress::new()).unwrap();
    let wrong: Vec<_> = check.faults.iter().filter(|f| f.count() > 0).collect();
    assert!(check.hits > 500 && wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn splits_keep_to_their_budget_and_pay() {
    let needles = needles();
    let objects = needles.objects().len() as f64;
    for (method, of_objects) in [("bvh-spatial", 0.0), ("bvh-presplit", 1.0)] {
        for budget in [1.0, 1.1, 2.0] {
            let tree = checked(&needles, &with(method, &[("budget", budget)]));
            let most = (of_objects + budget) * objects;
            assert!(tree.references().len() as f64 <= most, "{method} {budget}");
        }
    }
    let none = checked(&needles, &with("bvh-presplit", &[("budget", 0.0)]));
    let sweep = checked(&needles, &with("bvh-sweep", &[]));
    assert!(none.nodes() == sweep.nodes());
    let whole = cost_by(&needles, "bvh-binned", &[("bins", 32.0)]);
    assert_eq!(cost_by(&needles, "bvh-spatial", &[("budget", 1.0)]), whole);
    assert_eq!(cost_by(&needles, "bvh-spatial", &[("alpha", 1.0)]), whole);
    for method in ["bvh-spatial", "bvh-presplit"] {
        let split = cost_by(&needles, method, &[]);
        assert!(split < 0.95 * whole, "{method}: {split} against {whole}");
    }
}

#[test]
fn better_builders_have_lower_costs() {
    for name in ["balls:2", "rings:2", "m-fluid", "room"] {
        let scene = scene(name);
        let of = |method, constants: &[(&str, f64)]| cost_by(&scene, method, constants);
        let (sweep, lbvh) = (of("bvh-sweep", &[]), of("bvh-lbvh", &[]));
        assert!(sweep <= lbvh, "{name}: {sweep} against {lbvh}");
        let ploc = of("bvh-ploc", &[]);
        assert!(ploc <= lbvh, "{name}: {ploc} against {lbvh}");
        // Boxes are rounded outwards.
        for (start, before) in [(0.0, sweep), (1.0, of("bvh-binned", &[]))] {
            let after = of("bvh-reinsert", &[("start", start)]);
            assert!(
                after <= before * (1.0 + 1e-5),
                "{name}: {after} against {before}"
            );
            let none = of("bvh-reinsert", &[("start", start), ("rounds", 0.0)]);
            assert!(
                none <= before * (1.0 + 1e-5),
                "{name}: {none} against {before}"
            );
        }
        for (start, before) in [(2.0, lbvh), (3.0, ploc)] {
            let after = of("bvh-reinsert", &[("start", start)]);
            assert!(after <= before, "{name}: {after} against {before}");
            let none = of("bvh-reinsert", &[("start", start), ("rounds", 0.0)]);
            assert_eq!(none, before, "{name}");
        }
    }
}

/// Objects that no plane separates, as many as stress a builder that needs a level or a round for each.
#[test]
fn coincident_and_nested_objects_are_built_quickly_and_not_deep() {
    let corners = [
        Vec3::ZERO,
        Vec3::new(2.0, 0.0, 1.0),
        Vec3::new(0.0, 1.0, 1.5),
    ];
    let nested = (1..=50_000).map(|i| Sphere::new(Vec3::ZERO, f64::from(i)).unwrap());
    let line = (0..1000).map(|i| point(Vec3::X * libm::exp2(-f64::from(i))));
    let cases = [
        ("triangles", vec![triangle(corners); 100_000]),
        ("points", vec![point(Vec3::ONE); 100_000]),
        ("nested", nested.map(Primitive::Sphere).collect()),
        ("line", line.collect()),
    ];
    for (name, objects) in cases {
        let scene = scene_of(objects);
        for method in builders() {
            let start = Instant::now();
            let tree = checked(&scene, &BuildSettings::for_method(method));
            let time = start.elapsed();
            assert!(
                time < Duration::from_secs(20),
                "{name} by {method:?}: {time:?}"
            );
            // Of nested boxes, a chain has the lowest cost.
            let is_chain = method.name == "bvh-reinsert";
            assert!(
                is_chain || tree.depth_reached() < 400,
                "{name} by {method:?}"
            );
            let largest = tree.cells().map(|cell| tree.leaf_objects(cell.node).len());
            // Near D_MAX, a division may be so uneven that halves no longer suffice.
            assert!(largest.max() <= Some(16), "{name} by {method:?}");
        }
    }
}

#[test]
fn few_flat_huge_and_tiny_objects_are_built() {
    let mut random = Random(3);
    let mut scattered = |count: usize, scale: f64, flat: Vec3| {
        let mut objects = Vec::new();
        while objects.len() < count {
            let at = random.vector();
            let corners = [at, at + 0.2 * random.vector(), at + 0.2 * random.vector()];
            let corners = corners.map(|corner| corner * flat * scale);
            objects.extend(Triangle::new(corners, None).map(Primitive::Triangle));
        }
        scene_of(objects)
    };
    let scenes = [
        scattered(1, 1.0, Vec3::ONE),
        scattered(2, 1.0, Vec3::ONE),
        scattered(3, 1.0, Vec3::ONE),
        scattered(300, 1.0, Vec3::new(1.0, 1.0, 0.0)),
        scattered(300, 1e140, Vec3::ONE),
        scattered(300, 1e-140, Vec3::ONE),
        scene_of(
            (0..300)
                .map(|i| point(Vec3::X * f64::from(i % 40)))
                .collect(),
        ),
        scene_of(vec![
            point(Vec3::splat(1e300)),
            point(Vec3::splat(-1e300)),
            point(Vec3::splat(1e-310)),
            point(Vec3::splat(3e-310)),
        ]),
    ];
    for scene in scenes {
        for settings in settings() {
            let tree = checked(&scene, &settings);
            if scene.objects().len() == 1 {
                assert_eq!(tree.nodes().len(), 1, "{settings:?}");
            }
        }
    }
}

#[test]
fn leaves_say_why_they_stopped() {
    let balls = scene("balls:2");
    let stops = |settings: &BuildSettings| {
        let tree = checked(&balls, settings);
        let cells = tree.cells();
        let stops = cells.filter_map(|cell| match tree.kind(cell.node) {
            NodeKind::Leaf { stop, .. } => Some(stop),
            NodeKind::Inner => None,
        });
        let mut stops: Vec<_> = stops.collect();
        stops.dedup();
        stops
    };
    let single = with("bvh-lbvh", &[("max-leaf", 1.0)]);
    assert_eq!(stops(&single), [StopReason::FewObjects]);
    let cheap = with("bvh-ploc", &[("cost-traversal", 100.0), ("max-leaf", 1e6)]);
    assert_eq!(stops(&cheap), [StopReason::Collapsed]);
    let roomy = BuildSettings {
        n_oilf: 1_000_000,
        ..with("bvh-lbvh", &[])
    };
    // N_OILF is for builders from the root downward.
    assert_eq!(stops(&roomy), stops(&with("bvh-lbvh", &[])));
    for method in ["bvh-lbvh", "bvh-ploc"] {
        let mut found = stops(&with(method, &[]));
        found.sort_by_key(|stop| *stop as u8);
        found.dedup();
        assert_eq!(found, [StopReason::FewObjects, StopReason::Collapsed]);
    }
}

#[test]
fn builders_from_the_root_keep_to_the_depth_limit_and_others_do_not_need_it() {
    let balls = scene("balls:3");
    for method in builders() {
        let tree = |d_max| {
            let settings = BuildSettings {
                d_max: MaxDepth::Fixed(d_max),
                ..BuildSettings::for_method(method)
            };
            checked(&balls, &settings)
        };
        let shallow = tree(5);
        if method.has_limits {
            assert!(shallow.depth_reached() <= 5, "{method:?}");
        } else {
            assert!(shallow.depth_reached() > 5, "{method:?}");
        }
    }
    let obeys = |name: &str| Method::named(name).unwrap().has_limits;
    for name in ["midpoint", "bvh-sweep", "bvh-spatial", "bvh-presplit"] {
        assert!(obeys(name), "{name}");
    }
    for name in ["grid", "bvh-lbvh", "bvh-ploc", "bvh-reinsert"] {
        assert!(!obeys(name), "{name}");
    }
}

#[test]
fn builds_can_be_cancelled_at_any_time() {
    let balls = scene("balls:5");
    for method in builders() {
        let settings = BuildSettings::for_method(method);
        for after in [0, 5, 30] {
            let progress = Progress::new();
            let canceller = {
                let progress = progress.clone();
                std::thread::spawn(move || {
                    std::thread::sleep(Duration::from_millis(after));
                    progress.cancel();
                    Instant::now()
                })
            };
            if after == 0 {
                progress.cancel();
            }
            let result = build(&balls, &settings, &progress);
            let late = canceller.join().unwrap().elapsed();
            assert!(late < Duration::from_secs(2), "{method:?}: {late:?}");
            if after == 0 {
                assert!(
                    matches!(result, Err(BuildError::Cancelled(_))),
                    "{method:?}"
                );
            }
        }
    }
}

/// The cost of a hierarchy of obvhs.
fn cost_of(bvh: &Bvh2) -> f64 {
    let area = |bounds: &obvhs::aabb::Aabb| f64::from(bounds.half_area());
    let sum: f64 = bvh
        .nodes
        .iter()
        .map(|node| {
            let cost = if node.is_leaf() {
                f64::from(node.prim_count)
            } else {
                1.2
            };
            cost * area(node.aabb())
        })
        .sum();
    sum / area(bvh.nodes[0].aabb())
}

fn boxes(scene: &Scene) -> Vec<obvhs::aabb::Aabb> {
    let of = |Aabb { lo, hi }: Aabb| {
        obvhs::aabb::Aabb::new(Vec3A::from(lo.as_vec3()), Vec3A::from(hi.as_vec3()))
    };
    scene.objects().iter().map(|o| of(o.bounds())).collect()
}

/// obvhs orders its curve and breaks ties differently, so costs are only about equal.
#[test]
fn costs_are_about_those_of_another_library() {
    for name in ["balls:3", "tetra:5", "rings:3", "m-fluid", "room"] {
        let scene = scene(name);
        let boxes = boxes(&scene);
        let mut theirs = PlocBuilder::new().build(
            PlocSearchDistance::High,
            &boxes,
            (0..boxes.len() as u32).collect(),
            SortPrecision::U64,
            0,
        );
        let radius = ("radius", 24.0);
        let single = ("max-leaf", 1.0);
        let close = |what: &str, ours: f64, theirs: &Bvh2| {
            let theirs = cost_of(theirs);
            assert!(
                ours < 1.1 * theirs,
                "{name}, {what}: {ours} against {theirs}"
            );
        };
        let ours = cost_by(&scene, "bvh-ploc", &[radius, single]);
        assert!(ours > 0.9 * cost_of(&theirs), "{name}: {ours}");
        close("ploc", ours, &theirs);
        let mut collapsed = theirs.clone();
        leaf_collapser::collapse(&mut collapsed, 8, 1.2);
        close(
            "collapsed",
            cost_by(&scene, "bvh-ploc", &[radius]),
            &collapsed,
        );
        ReinsertionOptimizer::default().run(&mut theirs, 0.05, Some(vec![1.0; 3]));
        let start = ("start", 3.0);
        let ours = cost_by(&scene, "bvh-reinsert", &[start, radius, single]);
        close("reinserted", ours, &theirs);
    }
}
