//! Loading a scene.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::scene::{Scene, SceneRequest, load};
use std::sync::Arc;

/// Loads a scene from its file or generator.
pub struct Load(pub SceneRequest);

impl Job for Load {
    type Partial = ();
    type Output = Arc<Scene>;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("load"), Priority::Now)
    }

    fn run(self, context: &Context<()>) -> Result<Arc<Scene>, JobError> {
        context.stage("loading the scene");
        let scene = context.unit(|progress| load(&self.0, progress))?;
        Ok(Arc::new(scene))
    }
}
