//! Comparisons are refused unless conditions and images are equal.

use crate::support::scenes::{render_sized, scene, settings};
use bspscope::geometry::Vec3;
use bspscope::measure::{Measured, Unequal, measure, parameter, ray_figures, unequal};
use bspscope::primitive::{Primitive, Sphere};
use bspscope::progress::Progress;
use bspscope::scene::{Sampling, Scene};
use bspscope::structure::{BuildSettings, MaxDepth};
use bspscope::trace::{RayCounts, RayKind, RayMaxima, RenderSettings, render_counted, thread_pool};

fn measured(
    scene: &Scene,
    method: &str,
    change: impl FnOnce(&mut BuildSettings, &mut RenderSettings),
) -> Measured {
    let mut build = settings(method);
    let mut render = render_sized(scene, [40, 30]);
    change(&mut build, &mut render);
    measure(scene, &build, &render, &Progress::new()).unwrap()
}

fn reasons(a: &Measured, b: &Measured) -> Vec<Unequal> {
    unequal((&a.measurement, &a.picture), (&b.measurement, &b.picture))
}

/// What is unequal, in a word each, in alphabetical order.
fn symbols(reasons: &[Unequal]) -> Vec<&'static str> {
    let mut symbols: Vec<_> = reasons
        .iter()
        .map(|reason| match reason {
            Unequal::Parameter { symbol, .. } => *symbol,
            Unequal::Setting { name, .. } => *name,
            Unequal::Camera => "camera",
            Unequal::Pixels { .. } => "pixels",
            Unequal::Size => "size",
        })
        .collect();
    symbols.sort_unstable();
    symbols
}

#[test]
fn two_methods_under_equal_conditions_may_be_compared() {
    let scene = scene("balls:2");
    let one = measured(&scene, "midpoint", |_, _| ());
    for method in ["sah-cut", "object-median", "none"] {
        assert_eq!(reasons(&one, &measured(&scene, method, |_, _| ())), []);
    }
}

#[test]
fn unequal_parameters_are_named() {
    let scene = scene("balls:2");
    let one = measured(&scene, "midpoint", |_, _| ());
    let deeper = measured(&scene, "sah-cut", |build, _| {
        build.d_max = MaxDepth::Fixed(12);
        build.n_oilf = 2;
    });
    assert_eq!(symbols(&reasons(&one, &deeper)), ["D_MAX", "N_OILF"]);
    let moved = measured(&scene, "midpoint", |_, render| {
        render.sampling = Sampling::Corner;
    });
    assert!(symbols(&reasons(&one, &moved)).contains(&"sampling"));
    let turned = measured(&scene, "midpoint", |_, render| {
        render.camera.angle = Some(20.0);
    });
    assert!(symbols(&reasons(&one, &turned)).contains(&"camera"));
    let wider = measured(&scene, "midpoint", |_, render| render.width = 41);
    let found = reasons(&one, &wider);
    assert!(symbols(&found).contains(&"N_X") && symbols(&found).contains(&"size"));
}

#[test]
fn one_object_moved_is_refused_with_the_pixels_that_show_it() {
    let scene = scene("balls:2");
    let mut parts = scene.parts().clone();
    let sphere = parts.objects.iter_mut().find_map(|object| match object {
        Primitive::Sphere(sphere) if sphere.radius > 0.1 => Some(sphere),
        _ => None,
    });
    let sphere = sphere.unwrap();
    *sphere = Sphere::new(sphere.center + Vec3::new(0.0, 0.05, 0.0), sphere.radius).unwrap();
    let moved = Scene::new(parts);
    let one = measured(&scene, "midpoint", |_, _| ());
    let two = measured(&moved, "midpoint", |_, _| ());
    let found = reasons(&one, &two);
    let pixels = found.iter().find_map(|reason| match reason {
        Unequal::Pixels { count, first } => Some((*count, first.clone())),
        _ => None,
    });
    let (count, first) = pixels.expect("pixels differ");
    let differ = |[x, y]: [u32; 2]| one.picture.get(x, y) != two.picture.get(x, y);
    assert!(count >= first.len() && !first.is_empty());
    assert!(first.into_iter().all(differ));
    assert!(reasons(&two, &two).is_empty());
}

/// A figure of the rays of a kind.
fn figure(measured: &Measured, key: &str, kind: RayKind) -> f64 {
    let figure = ray_figures().iter().find(|figure| figure.key == key);
    figure.unwrap().of(&measured.measurement, kind).unwrap()
}

#[test]
fn figures_of_all_kinds_of_rays_sum_to_the_papers() {
    let scene = scene("balls:2");
    let one = measured(&scene, "sah-cut", |_, _| ());
    for (key, symbol) in [
        ("nodes", "N_NODES"),
        ("inner_nodes", "N_INODES"),
        ("leaves", "N_VLS"),
        ("empty_leaves", "N_VELS"),
        ("full_leaves", "N_VFLS"),
    ] {
        let sum: f64 = RayKind::ALL.into_iter().map(|k| figure(&one, key, k)).sum();
        assert_eq!(
            Some(sum),
            parameter(symbol).value(&one.measurement),
            "{symbol}"
        );
    }
    assert_eq!(
        Some(figure(&one, "tests", RayKind::Primary)),
        parameter("N_PRIT").value(&one.measurement)
    );
    for kind in [RayKind::Primary, RayKind::Shadow, RayKind::Reflected] {
        let of = |key: &str| figure(&one, key, kind);
        for counted in [
            "tests",
            "nodes",
            "inner_nodes",
            "leaves",
            "empty_leaves",
            "full_leaves",
        ] {
            let [mean, most] = ["mean", "most"].map(|what| of(&format!("{counted}_{what}")));
            assert_eq!(mean, of(counted) / of("rays"), "{counted}");
            assert!(
                mean <= most && most <= of(counted),
                "{counted}: {mean} {most}"
            );
        }
    }
    // No sphere of this scene refracts.
    let none = ray_figures()
        .iter()
        .map(|f| f.of(&one.measurement, RayKind::Refracted));
    assert!(none.flatten().all(|value| value == 0.0));
}

#[test]
fn the_most_of_a_ray_is_that_of_the_pixel_with_the_most() {
    let scene = scene("balls:2");
    let one = measured(&scene, "midpoint", |_, _| ());
    let most = std::sync::Mutex::new(RayMaxima::default());
    let pool = thread_pool(2).unwrap();
    let render = &one.measurement.render;
    render_counted(&scene, &one.tree, render, &pool, &Progress::new(), |tile| {
        // A pixel has one primary ray.
        for tallies in tile.pixels {
            let tally = tallies[RayKind::Primary as usize];
            most.lock().unwrap().add(&RayCounts {
                inner_nodes: tally.inner_nodes,
                leaves: tally.leaves,
                empty_leaves: tally.empty_leaves,
                tests: tally.tests,
                test_hits: tally.test_hits,
                box_tests: tally.box_tests,
                culled: tally.culled,
            });
        }
    })
    .unwrap();
    let most = most.into_inner().unwrap();
    for (key, expected) in [
        ("tests_most", most.tests),
        ("nodes_most", most.nodes),
        ("inner_nodes_most", most.inner_nodes),
        ("leaves_most", most.leaves),
        ("empty_leaves_most", most.empty_leaves),
        ("full_leaves_most", most.full_leaves),
    ] {
        assert!(expected > 0, "{key}");
        assert_eq!(
            figure(&one, key, RayKind::Primary),
            f64::from(expected),
            "{key}"
        );
    }
}
