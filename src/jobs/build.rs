//! Building a tree.

use super::cache::Built;
use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::{Measurement, Times};
use crate::scene::Scene;
use crate::setup::Setup;
use crate::structure::build;
use rayon::ThreadPool;
use std::sync::Arc;

/// Builds the tree of a scene and measures its time, `T_B`.
pub struct Build {
    pub scene: Arc<Scene>,
    pub setup: Setup,
    pub pool: Arc<ThreadPool>,
}

impl Job for Build {
    type Partial = ();
    type Output = Built;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("build"), Priority::Now)
    }

    fn run(self, context: &Context<()>) -> Result<Built, JobError> {
        let Build { scene, setup, pool } = self;
        context.stage("building the tree");
        let (tree, building) = context.timed(|progress| {
            let (tree, time) = Times::of(&pool, || build(&scene, &setup.build, progress));
            tree.map(|tree| (Arc::new(tree), time))
        })?;
        Ok(Built {
            known: Measurement::of_tree(&scene, &tree, building, &setup.render),
            scene,
            tree,
        })
    }
}
