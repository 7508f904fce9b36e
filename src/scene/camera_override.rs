//! What of a camera differs from the scene's own.

use super::Camera;
use crate::geometry::Vec3;

/// Replaces parts of the scene's own camera; `None` keeps the scene's value.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CameraOverride {
    /// The eye.
    pub from: Option<Vec3>,
    /// A point on the axis of view.
    pub at: Option<Vec3>,
    /// Up; need not be perpendicular to the axis of view.
    pub up: Option<Vec3>,
    /// Full vertical angle of view in degrees, above 0 and below 180.
    pub angle: Option<f64>,
}

impl CameraOverride {
    /// Whether nothing is overridden: the scene's own camera.
    pub fn is_none(&self) -> bool {
        *self == CameraOverride::default()
    }

    /// The camera that results for a scene with this camera of its own.
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
    /// Overrides everything that decides the view.
    fn from(camera: Camera) -> Self {
        CameraOverride {
            from: Some(camera.from),
            at: Some(camera.at),
            up: Some(camera.up),
            angle: Some(camera.angle),
        }
    }
}
