//! The scalar kernel.

use super::query::{AnyHit, ClosestHit, Query, run};
use super::space::with_shapes;
use super::{Batch, Hit, RayTracer, Scratch};
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::structure::Tree;

/// Rays that are traced between two checks for cancellation. Even against 50,000 objects each, they take
/// a few milliseconds.
pub(super) const RAYS_PER_CANCEL_CHECK: usize = 16;

/// The scalar kernel: traces one ray after the other and counts nothing.
pub struct ScalarKernel<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: &'a Progress,
    scratch: Scratch,
}

impl<'a> ScalarKernel<'a> {
    pub fn new(tree: &'a Tree, shapes: &'a Shapes, progress: &'a Progress) -> Self {
        ScalarKernel {
            tree,
            shapes,
            progress,
            scratch: Scratch::default(),
        }
    }

    fn run_all<Q: Query>(&mut self, batch: Batch<'_>, answers: &mut Vec<Q::Answer>) {
        answers.clear();
        with_shapes!(self.shapes, space, objects => {
            for rays in batch.rays.chunks(RAYS_PER_CANCEL_CHECK) {
                if self.progress.is_cancelled() {
                    break;
                }
                answers.extend(rays.iter().map(|ray| {
                    let scratch = &mut self.scratch;
                    run::<Q, _, _, _>(self.tree, (space, objects), ray, scratch, &mut ())
                }));
            }
        });
        answers.resize(batch.rays.len(), Q::MISS);
    }
}

impl RayTracer for ScalarKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        self.run_all::<ClosestHit>(batch, hits);
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        self.run_all::<AnyHit>(batch, blocked);
    }
}
