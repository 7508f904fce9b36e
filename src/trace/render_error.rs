//! Errors of rendering.

use crate::progress::Cancelled;
use crate::scene::CameraError;

/// Why an image cannot be rendered.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error(
        "the image is {width} × {height} pixels, but width and height must be from 1 to {limit}"
    )]
    Resolution { width: u32, height: u32, limit: u32 },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error("the threads could not be started: {0}")]
    Threads(String),
}
