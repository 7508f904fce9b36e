//! Counts of how often the rays of an image visit each node of the tree.

use super::query::{any_hit, closest_hit};
use super::render::over_tiles;
use super::{
    Batch, BoxTest, Children, Hit, Probe, RayTracer, RenderError, RenderSettings, Scratch, Shading,
    trace_samples,
};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{NodeKind, Tree};
use std::sync::{Mutex, PoisonError};

/// The number of visits of each node, and the number of nodes that each ray visits.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Visits {
    /// Number of rays that visit each node. No ray visits a node twice.
    pub by_node: Vec<u64>,
    /// Number of rays by the number of nodes that they visit, which is 0 for rays that miss the root cell.
    /// Empty without rays.
    pub rays_by_nodes: Vec<u64>,
    /// Pairs of a pixel, counted row by row, and the number of nodes that a ray of it visits. Ascending,
    /// each pair once.
    pub pixels_by_nodes: Vec<(u32, u32)>,
}

impl Visits {
    /// Returns the number of rays of all kinds.
    pub fn rays(&self) -> u64 {
        self.rays_by_nodes.iter().sum()
    }

    /// Returns the pixels, counted row by row, with a ray that visits from `lo` to `hi` nodes. Ascending.
    pub fn pixels_within(&self, [lo, hi]: [u32; 2]) -> Vec<u32> {
        let within = self.pixels_by_nodes.iter();
        let mut pixels: Vec<u32> = within
            .filter(|(_, nodes)| (lo..=hi).contains(nodes))
            .map(|(pixel, _)| *pixel)
            .collect();
        pixels.dedup();
        pixels
    }

    /// Returns the leaves of the visited tree, most visited first; of equals the lower index first.
    pub fn leaves_by_visits(&self, tree: &Tree) -> Vec<u32> {
        let mut leaves: Vec<u32> = (0..tree.nodes().len() as u32)
            .filter(|&node| matches!(tree.kind(node), NodeKind::Leaf { .. }))
            .collect();
        leaves.sort_by_key(|&leaf| std::cmp::Reverse(self.by_node[leaf as usize]));
        leaves
    }

    fn merge(&mut self, other: &Visits) {
        for (sums, parts) in [
            (&mut self.by_node, &other.by_node),
            (&mut self.rays_by_nodes, &other.rays_by_nodes),
        ] {
            sums.resize(sums.len().max(parts.len()), 0);
            for (sum, part) in sums.iter_mut().zip(parts) {
                *sum += part;
            }
        }
        self.pixels_by_nodes
            .extend_from_slice(&other.pixels_by_nodes);
    }
}

/// Counts the visits of one ray.
struct Visitor<'a> {
    by_node: &'a mut [u64],
    nodes: u32,
}

impl Visitor<'_> {
    #[inline(always)]
    fn visit(&mut self, node: u32) {
        self.by_node[node as usize] += 1;
        self.nodes += 1;
    }
}

impl Probe for Visitor<'_> {
    #[inline(always)]
    fn inner(&mut self, node: u32, _: [f64; 2], _: f64, _: f64, _: Children) {
        self.visit(node);
    }

    #[inline(always)]
    fn boxes(&mut self, node: u32, _: [f64; 2], _: &[BoxTest]) {
        self.visit(node);
    }

    #[inline(always)]
    fn culled(&mut self, _: u32, _: f64, _: f64) {}

    #[inline(always)]
    fn leaf(&mut self, node: u32, _: &[u32], _: [f64; 2]) {
        self.visit(node);
    }

    #[inline(always)]
    fn test(&mut self, _: u32, _: impl FnOnce() -> Option<f64>) {}
}

/// The kernel that counts visits, for one tile.
struct Visiting<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: &'a Progress,
    scratch: Scratch,
    visits: &'a mut Visits,
    /// Indices in the image of the tile's pixels.
    pixels: &'a [u32],
}

impl Visiting<'_> {
    fn run_all<A: Clone>(
        &mut self,
        batch: Batch<'_>,
        answers: &mut Vec<A>,
        miss: A,
        query: impl Fn(&Ray, &mut Scratch, &mut Visitor<'_>) -> A,
    ) {
        answers.clear();
        for (ray, &pixel) in batch.rays.iter().zip(batch.pixels) {
            if self.progress.is_cancelled() {
                break;
            }
            let visits = &mut *self.visits;
            let mut visitor = Visitor {
                by_node: &mut visits.by_node,
                nodes: 0,
            };
            let scratch = &mut self.scratch;
            answers.push(query(ray, scratch, &mut visitor));
            let nodes = visitor.nodes;
            let bins = &mut visits.rays_by_nodes;
            bins.resize(bins.len().max(nodes as usize + 1), 0);
            bins[nodes as usize] += 1;
            let pixel = self.pixels[pixel as usize];
            visits.pixels_by_nodes.push((pixel, nodes));
        }
        answers.resize(batch.rays.len(), miss);
    }
}

impl RayTracer for Visiting<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        let (tree, shapes) = (self.tree, self.shapes);
        self.run_all(batch, hits, Hit::MISS, |ray, scratch, visitor| {
            closest_hit(tree, shapes, ray, scratch, visitor)
        });
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        let (tree, shapes) = (self.tree, self.shapes);
        self.run_all(batch, blocked, false, |ray, scratch, visitor| {
            any_hit(tree, shapes, ray, scratch, visitor)
        });
    }
}

/// Counts the visits of all rays of sample 0, the same rays as those of [`super::render_counted`]. The
/// result does not depend on the number of threads.
///
/// # Errors
/// A camera without a view, a resolution out of range, or cancellation.
pub fn count_visits(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<Visits, RenderError> {
    let shading = Shading::new(scene, settings)?;
    let nothing = || Visits {
        by_node: vec![0; tree.nodes().len()],
        ..Visits::default()
    };
    // One array per thread, so that no thread waits for a lock.
    let by_thread: Vec<_> = (0..pool.current_num_threads())
        .map(|_| Mutex::new(nothing()))
        .collect();
    over_tiles(
        settings,
        pool,
        progress,
        |_, pixels| {
            let thread = rayon::current_thread_index().unwrap_or(0);
            let mut visits = by_thread[thread]
                .lock()
                .unwrap_or_else(PoisonError::into_inner);
            let numbers: Vec<u32> = pixels.iter().map(|(x, y)| y * settings.width + x).collect();
            let before = visits.pixels_by_nodes.len();
            let mut tracer = Visiting {
                tree,
                shapes: shading.shapes,
                progress,
                scratch: Scratch::default(),
                visits: &mut visits,
                pixels: &numbers,
            };
            trace_samples(&shading, pixels, 0, &mut tracer, &mut Vec::new());
            // Many rays of a pixel visit the same number of nodes: each number is kept once.
            let mut of_tile = visits.pixels_by_nodes.split_off(before);
            of_tile.sort_unstable();
            of_tile.dedup();
            visits.pixels_by_nodes.extend(of_tile);
        },
        |(), ()| (),
        || (),
    )?;
    let mut sum = nothing();
    for part in by_thread {
        sum.merge(&part.into_inner().unwrap_or_else(PoisonError::into_inner));
    }
    sum.pixels_by_nodes.sort_unstable();
    Ok(sum)
}
