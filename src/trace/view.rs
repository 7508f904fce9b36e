//! The view of render settings.

use super::{RenderError, RenderSettings};
use crate::scene::{Scene, View};

/// Maximum width and height of an image.
const RESOLUTION_LIMIT: u32 = 16_384;

impl RenderSettings {
    /// Returns the view of a scene.
    ///
    /// # Errors
    /// A camera without a view or a resolution out of range.
    pub fn view(&self, scene: &Scene) -> Result<View, RenderError> {
        let range = 1..=RESOLUTION_LIMIT;
        if !range.contains(&self.width) || !range.contains(&self.height) {
            return Err(RenderError::Resolution {
                width: self.width,
                height: self.height,
                limit: RESOLUTION_LIMIT,
            });
        }
        let camera = self.camera.resolve(scene.camera());
        Ok(camera.view(self.width, self.height, self.sampling)?)
    }
}
