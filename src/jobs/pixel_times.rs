//! The time that every pixel of a picture takes.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::heat::PixelCounts;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderSettings, pixel_times, thread_pool};
use std::sync::Arc;

/// Measures the time of every pixel.
pub struct TimePixels {
    /// One of several pictures that are timed.
    pub picture: u64,
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub render: RenderSettings,
}

impl Job for TimePixels {
    type Partial = ();
    type Output = PixelCounts;

    fn place(&self) -> (Slot, Priority) {
        (
            Slot::numbered("pixel times", self.picture),
            Priority::Detail,
        )
    }

    fn run(self, context: &Context<()>) -> Result<PixelCounts, JobError> {
        let (scene, tree, render) = (self.scene, self.tree, self.render);
        context.stage("timing every pixel");
        let pool = thread_pool(render.threads)?;
        let seconds =
            context.timed(|progress| pixel_times(&scene, &tree, &render, &pool, progress))?;
        let mut counts = PixelCounts::new(render.width, render.height);
        counts.seconds = Some(seconds);
        Ok(counts)
    }
}
