//! The counting kernel.

use super::query::{AnyHit, ClosestHit, Query, run};
use super::scalar_kernel::RAYS_PER_CANCEL_CHECK;
use super::space::{Space, SpaceRay, World, with_shapes};
use super::{
    Batch, Hit, LeafVisitor, PixelTallies, Probe, RayCounts, RayMaxima, RayTracer, Scratch, Tally,
};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::structure::Tree;
use cpu_time::ThreadTime;
use std::time::Duration;

/// Ends the traversal of a ray after a known number of leaves, without tests.
struct Replay {
    leaves: u32,
}

impl LeafVisitor for Replay {
    #[inline(always)]
    fn visit<P: Probe>(&mut self, _: &[u32], _: &mut P) -> f64 {
        self.leaves -= 1;
        if self.leaves == 0 {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        }
    }
}

/// The kernel that counts. Its own time is meaningless. After every batch it repeats the traversal of the
/// same rays without counting and without tests, and measures that time.
pub struct CountingKernel<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: &'a Progress,
    scratch: Scratch,
    counts: Vec<RayCounts>,
    /// Counts by [`RayKind`](super::RayKind).
    pub tallies: [Tally; 4],
    /// Maxima over single rays by [`RayKind`](super::RayKind).
    pub maxima: [RayMaxima; 4],
    /// CPU time of the traversal of all rays to their known ends, without tests and shading.
    pub traversal: Duration,
    /// Counts of each pixel of the batches.
    pub pixels: Vec<PixelTallies>,
}

impl<'a> CountingKernel<'a> {
    /// Creates a kernel for batches of rays of `pixels` pixels.
    pub fn new(tree: &'a Tree, shapes: &'a Shapes, progress: &'a Progress, pixels: usize) -> Self {
        CountingKernel {
            tree,
            shapes,
            progress,
            scratch: Scratch::default(),
            counts: Vec::new(),
            tallies: Default::default(),
            maxima: Default::default(),
            traversal: Duration::ZERO,
            pixels: vec![PixelTallies::default(); pixels],
        }
    }

    fn run_all<Q: Query>(&mut self, batch: Batch<'_>, answers: &mut Vec<Q::Answer>) {
        answers.clear();
        self.counts.clear();
        with_shapes!(self.shapes, space, objects => {
            for rays in batch.rays.chunks(RAYS_PER_CANCEL_CHECK) {
                if self.progress.is_cancelled() {
                    break;
                }
                for ray in rays {
                    let mut counts = RayCounts::default();
                    let scratch = &mut self.scratch;
                    let objects = (space, objects);
                    answers.push(run::<Q, _, _, _>(self.tree, objects, ray, scratch, &mut counts));
                    self.counts.push(counts);
                }
            }
        });
        let answered = batch.pixels.iter().zip(&self.counts).zip(&*answers);
        for ((&pixel, counts), &answer) in answered {
            let hit = Q::is_hit(answer);
            self.tallies[batch.kind as usize].add(counts, hit);
            self.maxima[batch.kind as usize].add(counts);
            self.pixels[pixel as usize][batch.kind as usize].add(counts, hit);
        }
        self.replay(batch.rays);
        answers.resize(batch.rays.len(), Q::MISS);
    }

    /// Repeats the traversal of rays to the ends that were just counted, and measures the time.
    fn replay(&mut self, rays: &[Ray]) {
        match self.shapes {
            Shapes::F64(_) => self.replay_in(&World, rays),
            Shapes::F32 { frame, .. } => self.replay_in(frame, rays),
        }
    }

    fn replay_in<S: Space>(&mut self, space: &S, rays: &[Ray]) {
        let start = ThreadTime::now();
        for (ray, counts) in rays.iter().zip(&self.counts) {
            // A ray that misses the root cell visits no leaf; neither does its repetition.
            let leaves = counts.leaves.max(1);
            let mut replay = Replay { leaves };
            if let Some(ray) = space.transform(ray) {
                ray.traverse(self.tree, &mut self.scratch, &mut replay, &mut ());
            }
            std::hint::black_box(&replay.leaves);
        }
        self.traversal += start.elapsed();
    }
}

impl RayTracer for CountingKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        self.run_all::<ClosestHit>(batch, hits);
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        self.run_all::<AnyHit>(batch, blocked);
    }
}
