//! Every build method on every scene file: a valid tree, the same hits as testing every object, the
//! same picture, and the same counts for any number of threads.

use crate::support::scenes::{render_sized, scene, scene_file, scene_names, tree_with};
use bspscope::measure::{answer, compare, sample_rays, unsplit};
use bspscope::primitive::Precision;
use bspscope::progress::Progress;
use bspscope::scene::{Sampling, Scene};
use bspscope::structure::{BuildSettings, Method, OverlapRule, Tree, build, validate};
use bspscope::trace::{
    CountedRender, CountingKernel, KernelChoice, Picture, RayKind, RenderSettings, Shading, Tally,
    render_counted, render_timed, thread_pool, tiles, trace_samples,
};
use std::collections::HashSet;
use std::sync::Mutex;
use std::time::Duration;

/// Returns the number of rays per kind: fewer for the reconstructions, whose many polygons take long to
/// test one by one.
fn rays_per_kind(name: &str) -> usize {
    let reconstructed = ["fluid", "m-fluid", "room"];
    if reconstructed.contains(&name) {
        5_000
    } else {
        50_000
    }
}

fn tree_of(scene: &Scene, method: Method, overlap: OverlapRule) -> Tree {
    let settings = BuildSettings {
        overlap,
        ..BuildSettings::for_method(method)
    };
    tree_with(scene, &settings)
}

fn small_picture(scene: &Scene, threads: usize) -> RenderSettings {
    RenderSettings {
        threads,
        ..render_sized(scene, [90, 70])
    }
}

fn count(scene: &Scene, tree: &Tree, settings: &RenderSettings) -> CountedRender {
    let pool = thread_pool(settings.threads).unwrap();
    let counted = render_counted(scene, tree, settings, &pool, &Progress::new(), |_| ()).unwrap();
    CountedRender {
        traversal: Duration::ZERO,
        ..counted
    }
}

fn picture(scene: &Scene, tree: &Tree, settings: &RenderSettings) -> Picture {
    let pool = thread_pool(settings.threads).unwrap();
    let picture = Mutex::new(Picture::new(settings.width, settings.height));
    for sample in 0..settings.samples {
        render_timed(
            scene,
            tree,
            settings,
            sample,
            &pool,
            &Progress::new(),
            |tile, colors| picture.lock().unwrap().add_tile(tile, sample, colors),
        )
        .unwrap();
    }
    picture.into_inner().unwrap()
}

/// One loop for all, so that each tree is built once.
#[test]
fn every_tree_is_valid_and_gives_the_hits_of_testing_every_object_and_the_same_picture() {
    let pool = thread_pool(0).unwrap();
    for name in scene_names() {
        let scene = scene_file(&name);
        let progress = Progress::new();
        let naive = unsplit(&scene, &progress).unwrap();
        let helper = tree_of(&scene, Method::all().next().unwrap(), OverlapRule::Paper);
        let settings = RenderSettings::for_camera(*scene.camera());
        let per_kind = rays_per_kind(&name);
        let rays = sample_rays(&scene, &helper, &settings, per_kind, &pool, &progress).unwrap();
        for kind in RayKind::ALL {
            let needed = match kind {
                RayKind::Primary => true,
                RayKind::Shadow => scene.requirements().casts_shadows,
                RayKind::Reflected => scene.requirements().reflects,
                RayKind::Refracted => scene.requirements().refracts,
            };
            let found = rays.rays[kind as usize].len();
            let expected = if needed { per_kind } else { 0 };
            assert_eq!(found, expected, "{kind:?} rays of {}", name);
        }
        let expected =
            Precision::ALL.map(|p| answer(&scene, &naive, p, &rays, &pool, &progress).unwrap());
        assert_ne!(
            expected[0], expected[1],
            "the precisions differ in the last places"
        );
        let small = small_picture(&scene, 0);
        let mut first: Option<Picture> = None;
        for method in Method::all() {
            for overlap in OverlapRule::ALL {
                let tree = tree_of(&scene, method, overlap);
                if let Err(wrong) = validate(&scene, &tree) {
                    panic!("{name} by {method:?}, {}: {wrong}", overlap.name());
                }
                if overlap == OverlapRule::Paper {
                    let picture = picture(&scene, &tree, &small);
                    let first = first.get_or_insert_with(|| picture.clone());
                    assert!(picture == *first, "{name} by {method:?}");
                }
                if method.name == "none" {
                    continue;
                }
                for (precision, expected) in Precision::ALL.into_iter().zip(&expected) {
                    let found = answer(&scene, &tree, precision, &rays, &pool, &progress).unwrap();
                    let result = compare(&scene, &rays, expected, &found, None);
                    assert!(
                        result.is_identical(),
                        "{name} by {method:?}, overlap {}, {precision:?}: wrong {:?} of {:?}, such \
                         as {:?}",
                        overlap.name(),
                        result.others,
                        result.rays,
                        result.faults
                    );
                }
            }
        }
        let colors: HashSet<_> = first.unwrap().to_srgb8().into_iter().collect();
        assert!(colors.len() > 10, "nothing to see in {name}");
    }
}

#[test]
fn trees_do_not_depend_on_the_number_of_threads() {
    let pools = [1, 2, 7].map(|threads| thread_pool(threads).unwrap());
    let check = |scene: &Scene, settings: &BuildSettings| {
        let [one, others @ ..] = pools.each_ref().map(|pool| {
            pool.install(|| build(scene, settings, &Progress::new()))
                .unwrap()
        });
        for other in others {
            let name = (scene.name(), settings);
            assert!(one.nodes() == other.nodes(), "{name:?}");
            assert!(one.references() == other.references(), "{name:?}");
            assert_eq!(one.depth_reached(), other.depth_reached(), "{name:?}");
        }
    };
    // The files are small: this one is shared out among threads many times over.
    let many = scene("balls:5");
    assert!(many.objects().len() > 60_000);
    for method in Method::all() {
        check(&many, &BuildSettings::for_method(method));
    }
    for name in scene_names() {
        let scene = scene_file(&name);
        for method in Method::all() {
            for overlap in OverlapRule::ALL {
                let settings = BuildSettings {
                    overlap,
                    ..BuildSettings::for_method(method)
                };
                check(&scene, &settings);
            }
        }
    }
}

#[test]
fn counts_and_picture_do_not_depend_on_the_number_of_threads() {
    for name in scene_names() {
        let scene = scene_file(&name);
        for method in Method::of_the_paper() {
            let tree = tree_of(&scene, method, OverlapRule::Paper);
            let of = |threads| {
                let settings = RenderSettings {
                    samples: 3,
                    sampling: Sampling::Corner,
                    ..small_picture(&scene, threads)
                };
                (
                    count(&scene, &tree, &settings),
                    picture(&scene, &tree, &settings),
                )
            };
            let one = of(1);
            assert!(one.0.tallies.iter().map(|t| t.inner_nodes).sum::<u64>() > 10_000);
            for threads in [2, 7] {
                assert_eq!(of(threads), one, "{} with {threads}", name);
            }
        }
    }
}

/// Renders an image with the counting kernel; returns it with the counts.
fn counted_picture(scene: &Scene, tree: &Tree, settings: &RenderSettings) -> (Picture, [Tally; 4]) {
    let shading = Shading::new(scene, settings).unwrap();
    let progress = Progress::new();
    let mut picture = Picture::new(settings.width, settings.height);
    let (mut tallies, mut colors) = ([Tally::default(); 4], Vec::new());
    for tile in tiles(settings.width, settings.height) {
        let pixels: Vec<_> = (0..tile.len() as u32).map(|i| tile.pixel(i)).collect();
        let mut kernel = CountingKernel::new(tree, shading.shapes, &progress, pixels.len());
        trace_samples(&shading, &pixels, 0, &mut kernel, &mut colors);
        picture.add_tile(&tile, 0, &colors);
        for (sum, tally) in tallies.iter_mut().zip(kernel.tallies) {
            *sum += tally;
        }
    }
    (picture, tallies)
}

#[test]
fn the_counting_kernel_sees_the_picture_that_every_timed_kernel_makes() {
    for name in scene_names() {
        let scene = scene_file(&name);
        let settings = small_picture(&scene, 0);
        let tree = tree_of(
            &scene,
            Method::named("midpoint").unwrap(),
            OverlapRule::Paper,
        );
        let (seen, tallies) = counted_picture(&scene, &tree, &settings);
        let colors: std::collections::HashSet<_> = seen.to_srgb8().into_iter().collect();
        assert!(colors.len() > 10, "nothing to see in {name}");
        for kernel in KernelChoice::ALL {
            let settings = RenderSettings { kernel, ..settings };
            let timed = picture(&scene, &tree, &settings);
            assert!(timed == seen, "{name} by {}", kernel.description());
        }
        let counted = count(&scene, &tree, &settings);
        assert_eq!(counted.tallies, tallies, "{name}");
        let [primary, shadow, reflected, refracted] = tallies;
        let pixels = u64::from(settings.width * settings.height);
        assert_eq!(primary.rays, pixels);
        assert!(primary.hits > 0 && primary.hits <= primary.rays);
        assert!(counted.objects_met >= primary.hits);
        for tally in [primary, shadow, reflected, refracted] {
            assert!(tally.empty_leaves <= tally.leaves);
            assert!(tally.hits <= tally.tests);
        }
    }
}

#[test]
fn what_a_scene_does_not_require_is_not_done() {
    let tetra = scene_file("tetra");
    let tree = tree_of(
        &tetra,
        Method::named("midpoint").unwrap(),
        OverlapRule::Paper,
    );
    let pass = count(&tetra, &tree, &small_picture(&tetra, 0));
    assert_eq!(pass.tallies[RayKind::Reflected as usize].rays, 0);
    assert_eq!(pass.tallies[RayKind::Refracted as usize].rays, 0);
    assert!(pass.tallies[RayKind::Shadow as usize].rays > 0);

    let mut parts = tetra.parts().clone();
    parts.lights.clear();
    let dark = Scene::new(parts);
    let pass = count(&dark, &tree, &small_picture(&dark, 0));
    assert_eq!(pass.tallies[RayKind::Shadow as usize].rays, 0);
}
