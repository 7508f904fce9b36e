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

    fn slot(&self) -> Slot {
        Slot::named("load")
    }

    fn priority(&self) -> Priority {
        Priority::Now
    }

    fn run(self, context: &Context<()>) -> Result<Arc<Scene>, JobError> {
        context.stage("loading the scene");
        let scene = context.unit(|progress| load(&self.0, progress))?;
        Ok(Arc::new(scene))
    }
}
