//! Visits of every node against the counting kernel and against the records of pixels.

use crate::support::scenes::{render_sized, scene, tree_by};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::{NodeKind, Tree};
use bspscope::trace::{
    RenderSettings, Tally, Visits, count_visits, record_pixel, render_counted, thread_pool,
};

const SIDE: u32 = 40;

fn small(source: &str, method: &str) -> (Scene, Tree, RenderSettings) {
    let scene = scene(source);
    let tree = tree_by(&scene, method);
    let render = render_sized(&scene, [SIDE, SIDE]);
    (scene, tree, render)
}

fn visits(scene: &Scene, tree: &Tree, render: &RenderSettings, threads: usize) -> Visits {
    let pool = thread_pool(threads).unwrap();
    count_visits(scene, tree, render, &pool, &Progress::new()).unwrap()
}

#[test]
fn visits_sum_to_the_counts_of_the_counting_kernel() {
    for scene in ["balls:2", "rings:2", "tetra:3", "teaching"] {
        for method in ["midpoint", "sah-cut", "none"] {
            let (scene, tree, render) = small(scene, method);
            let visits = visits(&scene, &tree, &render, 2);
            let pool = thread_pool(2).unwrap();
            let counted =
                render_counted(&scene, &tree, &render, &pool, &Progress::new(), |_| ()).unwrap();
            let all: Tally = counted.tallies.into_iter().sum();
            let [mut inner, mut leaves, mut empty] = [0; 3];
            for (node, &n) in visits.by_node.iter().enumerate() {
                match tree.kind(node as u32) {
                    NodeKind::Inner => inner += n,
                    NodeKind::Leaf { count, .. } => {
                        leaves += n;
                        empty += if count == 0 { n } else { 0 };
                    }
                }
            }
            assert_eq!(
                [inner, leaves, empty, visits.rays()],
                [all.inner_nodes, all.leaves, all.empty_leaves, all.rays]
            );
            let nodes = (0..).zip(&visits.rays_by_nodes);
            let nodes: u64 = nodes.map(|(nodes, rays)| nodes * rays).sum();
            assert_eq!(nodes, all.inner_nodes + all.leaves);
            assert!(visits.by_node.iter().all(|&n| n <= visits.rays()));
            assert!(visits.by_node[0] > 0);
        }
    }
}

#[test]
fn visits_are_the_same_for_any_number_of_threads() {
    let (scene, tree, render) = small("balls:2", "sah-cut");
    let one = visits(&scene, &tree, &render, 1);
    for threads in [2, 3] {
        assert_eq!(visits(&scene, &tree, &render, threads), one);
    }
}

#[test]
fn pixels_within_a_range_are_those_whose_records_say_so() {
    let (scene, tree, render) = small("balls:1", "midpoint");
    let visits = visits(&scene, &tree, &render, 2);
    let rays: Vec<Vec<u32>> = (0..SIDE * SIDE)
        .map(|i| {
            let record = record_pixel(&scene, &tree, &render, [i % SIDE, i / SIDE]).unwrap();
            let rays = record.rays.iter();
            rays.map(|ray| ray.path.steps.len() as u32).collect()
        })
        .collect();
    let most = visits.rays_by_nodes.len() as u32 - 1;
    for range in [
        [0, 0],
        [0, most],
        [5, 9],
        [most, most],
        [most + 1, u32::MAX],
    ] {
        let expected: Vec<u32> = (0..SIDE * SIDE)
            .filter(|&i| {
                let mut nodes = rays[i as usize].iter();
                nodes.any(|n| (range[0]..=range[1]).contains(n))
            })
            .collect();
        assert_eq!(visits.pixels_within(range), expected, "{range:?}");
    }
    let rays: Vec<u32> = rays.into_iter().flatten().collect();
    for (nodes, &count) in visits.rays_by_nodes.iter().enumerate() {
        let recorded = rays.iter().filter(|&&n| n as usize == nodes).count();
        assert_eq!(count, recorded as u64);
    }
}

#[test]
fn a_cancelled_pass_counts_nothing() {
    let (scene, tree, render) = small("balls:1", "midpoint");
    let progress = Progress::new();
    progress.cancel();
    let pool = thread_pool(1).unwrap();
    assert!(count_visits(&scene, &tree, &render, &pool, &progress).is_err());
}
