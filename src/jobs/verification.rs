//! Verifying a tree on sampled rays of a picture.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::{Verification, verify_sample};
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderSettings, thread_pool};
use std::sync::Arc;

/// Rays of every kind that are checked, in a scene of few objects.
const RAYS: usize = 2000;

/// Intersection tests that a whole run may take, about; scenes of many objects get fewer rays.
const TESTS: usize = 400_000_000;

/// Compares a tree with testing every object, on sampled rays and on one thread. Its partial results
/// are what was found so far.
pub struct Verify {
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub render: RenderSettings,
}

impl Job for Verify {
    type Partial = Verification;
    type Output = Verification;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("verification"), Priority::Idle)
    }

    fn run(self, context: &Context<Verification>) -> Result<Verification, JobError> {
        context.stage("checking sampled rays");
        let pool = thread_pool(1)?;
        let affordable = TESTS / 4 / self.scene.objects().len().max(1);
        let per_kind = affordable.clamp(50, RAYS);
        context.unit(|progress| {
            let so_far = |result: &Verification| context.send(result.clone());
            let Verify {
                scene,
                tree,
                render,
            } = &self;
            verify_sample(scene, tree, render, per_kind, &pool, progress, so_far)
        })
    }
}
