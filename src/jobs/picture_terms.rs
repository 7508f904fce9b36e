//! The terms of equation (1), counted in every pixel of a picture.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::model::PictureTerms;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::RenderSettings;
use std::sync::Arc;

/// Counts the terms in every pixel.
pub struct CountTerms {
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub render: RenderSettings,
}

impl Job for CountTerms {
    type Partial = ();
    type Output = PictureTerms;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("terms"), Priority::Detail)
    }

    fn run(self, context: &Context<()>) -> Result<PictureTerms, JobError> {
        context.stage("counting tests");
        context
            .unit(|progress| PictureTerms::count(&self.scene, &self.tree, &self.render, progress))
    }
}
