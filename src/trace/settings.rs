//! Settings of rendering.

use super::{KernelChoice, PrecisionChoice};
use crate::scene::{Camera, CameraOverride, Sampling};

/// Everything that determines the image of a scene (class S of the paper's parameters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// What differs from the scene's own camera.
    pub camera: CameraOverride,
    /// Width in pixels, `N_X`; at least 1.
    pub width: u32,
    /// Height in pixels, `N_Y`; at least 1.
    pub height: u32,
    /// Maximum depth of secondary rays, `D_AREC`; 0 traces none.
    pub d_arec: u32,
    /// Minimum contribution, 0 to 1: a secondary ray is not traced if its weight is below this in every
    /// color channel of the pixel. 0 traces all rays that contribute.
    pub min_contribution: f64,
    /// Precision of ray tracing.
    pub precision: PrecisionChoice,
    /// Kernel of timed rendering. All kernels render the same image.
    pub kernel: KernelChoice,
    /// Position of the first sample in a pixel.
    pub sampling: Sampling,
    /// Samples per pixel of the finished image, at least 1. Measurements always take one.
    pub samples: u32,
    /// Number of threads; 0 means one per core.
    pub threads: usize,
}

impl RenderSettings {
    /// The paper's settings for a camera in place of the scene's own.
    pub fn for_camera(camera: Camera) -> Self {
        RenderSettings {
            camera: camera.into(),
            ..RenderSettings::default()
        }
    }
}

impl Default for RenderSettings {
    /// The paper's settings: the scene's own camera, 512 × 512 pixels, `D_AREC` 4, one sample at the
    /// pixel's center.
    fn default() -> Self {
        RenderSettings {
            camera: CameraOverride::default(),
            width: 512,
            height: 512,
            d_arec: 4,
            min_contribution: 0.0,
            precision: PrecisionChoice::F64,
            kernel: KernelChoice::Scalar,
            sampling: Sampling::Center,
            samples: 1,
            threads: 0,
        }
    }
}
