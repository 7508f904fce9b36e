//! The build driver at its limits: empty scenes, depth 0, memory, cancellation, settings.

use crate::support::scenes::{self, scene, tree_with};
use bspscope::geometry::Vec3;
use bspscope::primitive::{Primitive, Sphere, Triangle};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{
    BuildError, BuildSettings, Constants, Inseparable, MaxDepth, Method, NodeKind, OverlapRule,
    RootMargin, SettingsError, StopReason, Tree, TreeIndex, build, validate,
};

fn with(method: &str, change: impl FnOnce(&mut BuildSettings)) -> BuildSettings {
    let mut settings = scenes::settings(method);
    change(&mut settings);
    settings
}

fn stops(tree: &Tree) -> Vec<StopReason> {
    tree.cells()
        .filter_map(|cell| match tree.kind(cell.node) {
            NodeKind::Leaf { stop, .. } => Some(stop),
            NodeKind::Inner => None,
        })
        .collect()
}

#[test]
fn the_same_settings_give_the_same_tree() {
    let balls = scene("balls:3");
    for method in Method::all() {
        let settings = BuildSettings::for_method(method);
        let [one, two] = [(); 2].map(|()| tree_with(&balls, &settings));
        assert_eq!(one.nodes(), two.nodes());
        assert_eq!(one.references(), two.references());
    }
}

#[test]
fn a_scene_without_objects_is_one_empty_leaf() {
    let mut parts = scene("tetra:1").parts().clone();
    parts.objects.clear();
    parts.material_of.clear();
    let nothing = Scene::new(parts);
    for method in Method::all() {
        let settings = with(method.name, |s| s.n_oilf = 0);
        let tree = tree_with(&nothing, &settings);
        assert_eq!(stops(&tree), [StopReason::Empty]);
        assert_eq!(validate(&nothing, &tree), Ok(()));
    }
}

#[test]
fn leaves_say_why_they_stopped() {
    let tetra = scene("tetra:4");
    let leaves = |settings: &BuildSettings| {
        let tree = tree_with(&tetra, settings);
        validate(&tetra, &tree).unwrap();
        stops(&tree)
    };
    let flat = leaves(&with("midpoint", |s| s.d_max = MaxDepth::Fixed(0)));
    assert_eq!(flat, [StopReason::MaxDepth]);
    let roomy = leaves(&with("midpoint", |s| s.n_oilf = 1_000_000));
    assert_eq!(roomy, [StopReason::FewObjects]);
    let naive = leaves(&with("none", |_| ()));
    assert_eq!(naive, [StopReason::NotSplit]);
    let by_bounds = leaves(&with("sah-cut", |_| ()));
    assert!(by_bounds.contains(&StopReason::NoCandidate));
    let balls = scene("balls:3");
    let tree = tree_with(&balls, &with("sah-cut", |_| ()));
    for stop in [StopReason::CutOut, StopReason::LeafIsCheaper] {
        assert!(stops(&tree).contains(&stop), "{stop:?}");
    }
    // Two points in one place, and one that keeps the scene large.
    let mut parts = scene("balls:1").parts().clone();
    parts.objects = [0.3, 0.3, 1.0]
        .map(|x| Primitive::Sphere(Sphere::new(Vec3::splat(x), 0.0).unwrap()))
        .to_vec();
    parts.material_of = vec![0; 3];
    let points = Scene::new(parts);
    let settings = with("midpoint", |s| s.d_max = MaxDepth::Fixed(100));
    let tree = tree_with(&points, &settings);
    validate(&points, &tree).unwrap();
    assert!(stops(&tree).contains(&StopReason::TooThin));
}

#[test]
fn no_leaf_lies_deeper_than_d_max_and_the_deepest_is_d_reach() {
    let balls = scene("balls:3");
    for method in Method::all().filter(|m| m.has_limits || m.name == "none") {
        for depth in [0, 1, 7, 20] {
            let settings = with(method.name, |s| s.d_max = MaxDepth::Fixed(depth));
            let tree = tree_with(&balls, &settings);
            let deepest = tree.cells().map(|cell| cell.depth).max().unwrap();
            assert_eq!(deepest, tree.depth_reached(), "{method:?} at {depth}");
            assert!(deepest <= depth);
        }
    }
}

#[test]
fn automatic_depth_follows_the_number_of_objects() {
    // 1.2 · log2 4096 + 2 = 16.4
    let tetra = scene("tetra:6");
    let settings = with("midpoint", |s| s.d_max = MaxDepth::Automatic);
    let tree = tree_with(&tetra, &settings);
    assert_eq!(tree.depth_limit(), 16);
}

#[test]
fn clipped_objects_make_another_tree_with_fewer_expected_tests() {
    // Long and slanted ones, so that most of what their bounds hold is empty.
    let mut parts = scene("tetra:1").parts().clone();
    parts.objects = (0..300)
        .map(|i| {
            let [x, y] = [i % 20, i / 20].map(|k| f64::from(k) * 0.1);
            let corners = [
                [x, y, 0.0],
                [x + 0.5, y + 0.6, 1.0],
                [x + 0.6, y + 0.5, 1.0],
            ];
            let triangle = Triangle::new(corners.map(Vec3::from), None).unwrap();
            Primitive::Triangle(triangle)
        })
        .collect();
    parts.material_of = vec![0; parts.objects.len()];
    let slanted = Scene::new(parts);
    for (method, constants) in [
        ("sah", vec![("block".to_owned(), 1.0)]),
        ("sah-auto", vec![]),
    ] {
        let [loose, clipped] = [0.0, 1.0].map(|clip| {
            let settings = with(method, |s| {
                s.overlap = OverlapRule::Exact;
                s.constants = Constants::from_iter(constants.clone());
                s.constants.insert("clip".into(), clip);
            });
            let tree = tree_with(&slanted, &settings);
            validate(&slanted, &tree).unwrap();
            TreeIndex::new(&tree, slanted.objects().len()).of(0).tests
        });
        assert!(
            clipped < 0.99 * loose,
            "{method}: {clipped} against {loose}"
        );
    }
}

#[test]
fn a_tree_beyond_the_memory_limit_is_refused_before_it_is_there() {
    let tetra = scene("tetra:6");
    // A method whose planes depend on the objects: the driver cannot foresee the size of its tree.
    let settings = with("sah-sampled", |s| {
        s.constants.insert("cost-stop".into(), 0.0);
        s.d_max = MaxDepth::Fixed(100);
        s.n_oilf = 0;
        s.memory_limit = 64 << 20;
    });
    let error = build(&tetra, &settings, &Progress::new()).unwrap_err();
    let BuildError::MemoryLimit {
        limit,
        nodes,
        references,
        ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!(limit, 64 << 20);
    assert!(nodes * 8 + references * 4 < 64 << 20);
    assert!(nodes > 100_000, "it went as far as it could");
}

/// Methods that split to the depth limit wherever the objects lie stop at once; the others build a leaf.
#[test]
fn coincident_objects_that_cannot_fit_are_recognized_at_the_root() {
    let [a, b, c] = [
        Vec3::ZERO,
        Vec3::new(2.0, 0.0, 1.0),
        Vec3::new(0.0, 1.0, 1.5),
    ];
    let triangle = Primitive::Triangle(Triangle::new([a, b, c], None).unwrap());
    let ball = Primitive::Sphere(Sphere::new(a, 1.0).unwrap());
    for object in [triangle, ball] {
        let scene = scenes::scene_of(vec![object; 20_000]);
        for method in ["midpoint", "midpoint-longest", "octree", "grid"] {
            let error = build(&scene, &scenes::settings(method), &Progress::new()).unwrap_err();
            let BuildError::MemoryLimit {
                depth,
                references,
                inseparable: Some(Inseparable { objects, leaves }),
                ..
            } = error
            else {
                panic!("{method}: {error}");
            };
            assert_eq!((depth, references, objects), (0, 0, 20_000), "{method}");
            assert!(leaves > 10_000, "{method}: {leaves}");
        }
        for method in ["sah", "sah-cut", "sah-auto", "sah-sampled"] {
            let tree = tree_with(&scene, &scenes::settings(method));
            assert!(tree.references().len() < 100 * 20_000, "{method}");
        }
    }
}

/// What is foreseen is a lower bound of what is built: the limit that just suffices is not refused.
#[test]
fn coincident_objects_that_fit_are_split_to_the_depth_limit() {
    let ball = Primitive::Sphere(Sphere::new(Vec3::ZERO, 1.0).unwrap());
    let scene = scenes::scene_of(vec![ball; 50]);
    for method in ["midpoint", "midpoint-longest", "octree", "grid"] {
        let settings = with(method, |s| s.d_max = MaxDepth::Fixed(9));
        let tree = tree_with(&scene, &settings);
        assert!(method == "grid" || tree.depth_reached() == 9, "{method}");
        // The driver counts three times the size of the arrays while they grow, the bounds of the objects,
        // and the lists of the cells on the path to a cell.
        let fits = 3 * (tree.nodes().len() * 8 + tree.references().len() * 4) + 50 * (72 + 4 * 40);
        let limited = BuildSettings {
            memory_limit: fits as u64,
            ..settings
        };
        let again = tree_with(&scene, &limited);
        assert_eq!(again.nodes(), tree.nodes(), "{method}");
    }
}

#[test]
fn a_cancelled_build_stops() {
    let progress = Progress::new();
    progress.cancel();
    let result = build(&scene("tetra:6"), &with("midpoint", |_| ()), &progress);
    assert!(matches!(result, Err(BuildError::Cancelled(_))));
}

#[test]
fn settings_out_of_range_are_named() {
    let tetra = scene("tetra:1");
    let error = |settings: &BuildSettings| match build(&tetra, settings, &Progress::new()) {
        Err(BuildError::Settings(error)) => error,
        other => panic!("{other:?}"),
    };
    let depth = with("midpoint", |s| s.d_max = MaxDepth::Fixed(101));
    assert_eq!(error(&depth), SettingsError::Depth(101));
    for margin in [-1.0, f64::NAN, f64::INFINITY] {
        let settings = with("midpoint", |s| s.root_margin = RootMargin::Length(margin));
        assert!(matches!(error(&settings), SettingsError::RootMargin(_)));
    }
    let unknown = with("midpoint", |s| {
        s.constants.insert("epsilon".into(), 1.0);
    });
    assert!(matches!(
        error(&unknown),
        SettingsError::UnknownConstant { .. }
    ));
    let range = with("sah-cut", |s| {
        s.constants.insert("gap-fraction".into(), 7.0);
    });
    assert!(matches!(error(&range), SettingsError::ConstantRange { .. }));
    assert!(Method::named("octree-of-dreams").is_err());
}
