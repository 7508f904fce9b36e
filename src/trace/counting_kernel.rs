//! The counting kernel.

use super::query::{AnyHit, ClosestHit, Query, run};
use super::scalar_kernel::RAYS_PER_CANCEL_CHECK;
use super::space::{Space, SpaceRay, World, with_shapes};
use super::{
    Batch, BoxTest, Children, Hit, LeafVisitor, PixelTallies, Probe, RayCounts, RayMaxima,
    RayTracer, Scratch, Tally,
};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::structure::Tree;
use cpu_time::ThreadTime;
use std::time::Duration;

/// Counts, and keeps the limits after all leaves.
struct Counter<'a> {
    counts: RayCounts,
    limits: &'a mut Vec<f64>,
}

impl Probe for Counter<'_> {
    #[inline(always)]
    fn inner(&mut self, node: u32, within: [f64; 2], t: f64, t_far: f64, children: Children) {
        self.counts.inner(node, within, t, t_far, children);
    }

    #[inline(always)]
    fn boxes(&mut self, node: u32, within: [f64; 2], tests: &[BoxTest]) {
        self.counts.boxes(node, within, tests);
    }

    #[inline(always)]
    fn culled(&mut self, node: u32, t_enter: f64, limit: f64) {
        self.counts.culled(node, t_enter, limit);
    }

    #[inline(always)]
    fn limit(&mut self, limit: f64) {
        self.limits.push(limit);
    }

    #[inline(always)]
    fn leaf(&mut self, node: u32, objects: &[u32], within: [f64; 2]) {
        self.counts.leaf(node, objects, within);
    }

    #[inline(always)]
    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>) {
        self.counts.test(object, hit);
    }
}

/// Repeats the traversal of a ray without tests. After each leaf, the limit is what it was; the last one ends
/// the traversal.
struct Replay<'a> {
    limits: std::slice::Iter<'a, f64>,
}

impl LeafVisitor for Replay<'_> {
    #[inline(always)]
    fn visit<P: Probe>(&mut self, _: &[u32], _: &mut P) -> f64 {
        match self.limits.next() {
            Some(&limit) if !self.limits.as_slice().is_empty() => limit,
            _ => f64::NEG_INFINITY,
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
    /// The limit after each leaf of each ray.
    limits: Vec<f64>,
    /// Counts by [`RayKind`](super::RayKind).
    pub tallies: [Tally; 4],
    /// Maxima over single rays by [`RayKind`](super::RayKind).
    pub maxima: [RayMaxima; 4],
    /// The sum over rays of the squared number of leaves that each visits, by [`RayKind`](super::RayKind).
    pub leaves_squared: [u64; 4],
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
            limits: Vec::new(),
            tallies: Default::default(),
            maxima: Default::default(),
            leaves_squared: [0; 4],
            traversal: Duration::ZERO,
            pixels: vec![PixelTallies::default(); pixels],
        }
    }

    fn run_all<Q: Query>(&mut self, batch: Batch<'_>, answers: &mut Vec<Q::Answer>) {
        answers.clear();
        self.counts.clear();
        self.limits.clear();
        with_shapes!(self.shapes, space, objects => {
            for rays in batch.rays.chunks(RAYS_PER_CANCEL_CHECK) {
                if self.progress.is_cancelled() {
                    break;
                }
                for ray in rays {
                    let mut counter = Counter {
                        counts: RayCounts::default(),
                        limits: &mut self.limits,
                    };
                    let scratch = &mut self.scratch;
                    let objects = (space, objects);
                    answers.push(run::<Q, _, _, _>(self.tree, objects, ray, scratch, &mut counter));
                    self.counts.push(counter.counts);
                }
            }
        });
        let answered = batch.pixels.iter().zip(&self.counts).zip(&*answers);
        for ((&pixel, counts), &answer) in answered {
            let hit = Q::is_hit(answer);
            self.tallies[batch.kind as usize].add(counts, hit);
            self.maxima[batch.kind as usize].add(counts);
            self.leaves_squared[batch.kind as usize] += u64::from(counts.leaves).pow(2);
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
        let mut limits = self.limits.as_slice();
        let start = ThreadTime::now();
        for (ray, counts) in rays.iter().zip(&self.counts) {
            // A ray that misses the root visits no leaf; neither does its repetition.
            let (own, rest) = limits.split_at(counts.leaves as usize);
            limits = rest;
            let mut replay = Replay { limits: own.iter() };
            if let Some(ray) = space.transform(ray) {
                ray.traverse(self.tree, &mut self.scratch, &mut replay, &mut ());
            }
            std::hint::black_box(&replay.limits);
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
