//! The record of a pixel: its rays sum to what the counting kernel counted for that pixel, and its
//! colour is the picture's.

use crate::support::scenes::{render_sized, scene_file, tree_by};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::trace::{
    Children, LeafOutcome, PendingNode, PixelTallies, RayKind, RenderSettings, Step, record_pixel,
    record_pixel_within, render_counted, render_timed, thread_pool,
};
use std::collections::HashMap;
use std::sync::Mutex;

const SIZE: u32 = 64;

fn small(scene: &Scene) -> RenderSettings {
    render_sized(scene, [SIZE, SIZE])
}

#[test]
fn a_pixels_record_sums_to_what_the_counting_kernel_counted() {
    let pool = thread_pool(0).unwrap();
    for name in ["balls", "rings", "tetra", "teaching"] {
        let scene = scene_file(name);
        let settings = small(&scene);
        for method in ["midpoint", "sah-cut", "bvh-binned"] {
            let tree = tree_by(&scene, method);
            let counted: Mutex<HashMap<(u32, u32), PixelTallies>> = Mutex::default();
            render_counted(&scene, &tree, &settings, &pool, &Progress::new(), |part| {
                let mut counted = counted.lock().unwrap();
                for (i, tallies) in part.pixels.iter().enumerate() {
                    counted.insert(part.tile.pixel(i as u32), *tallies);
                }
            })
            .unwrap();
            let counted = counted.into_inner().unwrap();
            let colors: Mutex<HashMap<(u32, u32), _>> = Mutex::default();
            render_timed(
                &scene,
                &tree,
                &settings,
                0,
                &pool,
                &Progress::new(),
                |tile, tile_colors| {
                    let mut colors = colors.lock().unwrap();
                    for (i, color) in tile_colors.iter().enumerate() {
                        colors.insert(tile.pixel(i as u32), *color);
                    }
                },
            )
            .unwrap();
            let colors = colors.into_inner().unwrap();
            assert_eq!(counted.len(), (SIZE * SIZE) as usize);
            let mut kinds = [0; 4];
            for i in 0..100 {
                // A hundred pixels from all over the picture.
                let (x, y) = (i * 37 % SIZE, i * 41 % SIZE);
                let record = record_pixel(&scene, &tree, &settings, [x, y]).unwrap();
                assert_eq!(record.tallies(), counted[&(x, y)], "{name}, pixel {x}, {y}");
                let off = (record.color - colors[&(x, y)]).abs().max_element();
                assert!(off < 1e-12, "{name}: colours differ by rounding at most");
                for ray in &record.rays {
                    kinds[ray.path.kind as usize] += 1;
                }
            }
            assert!(kinds[RayKind::Primary as usize] == 100 && kinds[RayKind::Shadow as usize] > 0);
            let reflects = kinds[RayKind::Reflected as usize] > 0;
            assert_eq!(reflects, scene.requirements().reflects, "{name}");
        }
    }
}

#[test]
fn a_walk_is_a_path_through_the_tree() {
    let scene = scene_file("teaching");
    let tree = tree_by(&scene, "sah-cut");
    let settings = small(&scene);
    let mut ways = [0; 3];
    let mut popped = 0;
    for i in 0..300 {
        let (x, y) = (i * 37 % SIZE, i * 11 % SIZE);
        let record = record_pixel(&scene, &tree, &settings, [x, y]).unwrap();
        for (place, ray) in record.rays.iter().enumerate() {
            assert!(ray.parent.is_none_or(|parent| parent < place));
            let steps = &ray.path.steps;
            for (step, next) in steps.iter().zip(&steps[1.min(steps.len())..]) {
                let Step::Inner(inner) = step else {
                    continue;
                };
                ways[inner.children as usize] += 1;
                let children: Vec<u32> = tree.child_nodes(inner.node).collect();
                let [below, above] = children[..] else {
                    panic!("a leaf was recorded as an inner node");
                };
                let along = ray.path.ray.direction[inner.axis.index()];
                let near = if along.is_sign_negative() {
                    above
                } else {
                    below
                };
                assert_eq!(inner.near, near);
                assert_eq!(inner.far, above + below - near);
                let expected = if inner.children == Children::Far {
                    inner.far
                } else {
                    inner.near
                };
                assert_eq!(next.node(), expected);
            }
            // What waits is what the walk goes on with after a leaf, with the same interval.
            for i in 1..steps.len() {
                if !matches!(steps[i - 1], Step::Leaf(_)) {
                    continue;
                }
                let [t_enter, t_exit] = steps[i].interval();
                let expected = PendingNode {
                    node: steps[i].node(),
                    t_enter,
                    t_exit,
                };
                assert_eq!(ray.path.pending(i - 1).last(), Some(&expected));
                popped += 1;
            }
            let last = ray.path.leaves().last().map(|leaf| leaf.outcome);
            let done = [
                LeafOutcome::HitNearer,
                LeafOutcome::Blocked,
                LeafOutcome::NoLeafLeft,
            ];
            assert!(last.is_none_or(|after| done.contains(&after)));
            for leaf in ray.path.leaves().all_but_last() {
                assert!(!done.contains(&leaf.outcome));
            }
        }
    }
    assert!(ways.iter().all(|&n| n > 100), "{ways:?}");
    assert!(popped > 100, "{popped}");
}

#[test]
fn a_record_stays_within_its_limit() {
    let scene = scene_file("balls");
    let tree = tree_by(&scene, "sah-cut");
    let settings = small(&scene);
    let middle = [SIZE / 2, SIZE / 2];
    let record = |most| record_pixel_within(&scene, &tree, &settings, middle, most).unwrap();
    let (whole, cut) = (record(usize::MAX), record(1));
    assert!(!whole.cut && whole.rays.len() > 2);
    assert!(cut.cut);
    assert_eq!(cut.rays, whole.rays[..1]);
}

/// All but the last of an iterator.
trait AllButLast: Iterator + Sized {
    fn all_but_last(self) -> impl Iterator<Item = Self::Item> {
        let mut items: Vec<_> = self.collect();
        items.pop();
        items.into_iter()
    }
}

impl<I: Iterator> AllButLast for I {}
