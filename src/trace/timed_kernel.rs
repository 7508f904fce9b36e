//! The kernel of timed rendering.

use super::{Batch, Hit, KernelChoice, RayTracer, ScalarKernel, SimdKernel};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::structure::simd_tree::SimdTree;

/// Batches with fewer rays go to the scalar kernel. It is as fast for them, as most lanes would idle
/// (`cargo bench --bench peers`).
const MIN_SIMD_RAYS: usize = 64;

/// Rays that are traced between two checks for cancellation: about a millisecond.
const RAYS_PER_CANCEL_CHECK: usize = 4096;

/// The kernel that is timed.
pub struct TimedKernel<'a> {
    scalar: ScalarKernel<'a>,
    simd: Option<SimdKernel<'a>>,
    progress: &'a Progress,
}

impl<'a> TimedKernel<'a> {
    /// Creates the kernel of this choice. `shapes` must be those of the scene, and `tree` a tree of it. The
    /// first SIMD kernel of a tree prepares the tree.
    pub fn new(
        choice: KernelChoice,
        scene: &Scene,
        tree: &'a Tree,
        shapes: &'a Shapes,
        progress: &'a Progress,
    ) -> Self {
        let simd = choice.simd().map(|(mode, instructions)| {
            let simd_tree = SimdTree::of(scene, tree);
            SimdKernel::new(tree, simd_tree, shapes, instructions, mode)
        });
        TimedKernel {
            scalar: ScalarKernel::new(tree, shapes, progress),
            simd,
            progress,
        }
    }

    /// Traces a batch with the SIMD kernel. Returns `false` where the scalar kernel must do it.
    fn trace_simd<A: Copy>(
        &mut self,
        rays: &[Ray],
        miss: A,
        answers: &mut Vec<A>,
        trace: impl Fn(&mut SimdKernel<'a>, &[Ray], &mut [A]),
    ) -> bool {
        let Some(kernel) = self.simd.as_mut().filter(|_| rays.len() >= MIN_SIMD_RAYS) else {
            return false;
        };
        answers.clear();
        answers.resize(rays.len(), miss);
        let chunks = rays
            .chunks(RAYS_PER_CANCEL_CHECK)
            .zip(answers.chunks_mut(RAYS_PER_CANCEL_CHECK));
        for (rays, answers) in chunks {
            if self.progress.is_cancelled() {
                break;
            }
            trace(kernel, rays, answers);
        }
        true
    }
}

impl RayTracer for TimedKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        if !self.trace_simd(batch.rays, Hit::MISS, hits, SimdKernel::closest_hits) {
            self.scalar.closest_hits(batch, hits);
        }
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        if !self.trace_simd(batch.rays, false, blocked, SimdKernel::any_hits) {
            self.scalar.any_hits(batch, blocked);
        }
    }
}
