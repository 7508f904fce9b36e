//! Changes to the camera of a scene.

use super::Camera;
use crate::geometry::Vec3;

/// Replaces parts of the scene's own camera; `None` keeps the scene's value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraOverride {
    /// Position of the eye.
    pub from: Option<Vec3>,
    /// A point on the line of sight.
    pub at: Option<Vec3>,
    /// Up direction; need not be perpendicular to the line of sight.
    pub up: Option<Vec3>,
    /// Full vertical field of view in degrees, above 0 and below 180.
    pub angle: Option<f64>,
}

impl CameraOverride {
    /// Returns whether nothing is overridden.
    pub fn is_none(&self) -> bool {
        *self == CameraOverride::default()
    }

    /// Applies the overrides to the camera of a scene.
    pub fn resolve(&self, own: &Camera) -> Camera {
        Camera {
            from: self.from.unwrap_or(own.from),
            at: self.at.unwrap_or(own.at),
            up: self.up.unwrap_or(own.up),
            angle: self.angle.unwrap_or(own.angle),
            ..*own
        }
    }
}

impl From<Camera> for CameraOverride {
    /// Overrides everything that determines the view.
    fn from(camera: Camera) -> Self {
        CameraOverride {
            from: Some(camera.from),
            at: Some(camera.at),
            up: Some(camera.up),
            angle: Some(camera.angle),
        }
    }
}
