//! How a picture is traced.

use super::{KernelChoice, PrecisionChoice};
use crate::scene::{Camera, CameraOverride, Sampling};

/// Everything that, with a scene, decides the picture (class S of the paper's parameters).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// What differs from the scene's own camera.
    pub camera: CameraOverride,
    /// Width in pixels, `N_X`; at least 1.
    pub width: u32,
    /// Height in pixels, `N_Y`; at least 1.
    pub height: u32,
    /// How deep secondary rays go, `D_AREC`; 0 traces none.
    pub d_arec: u32,
    /// A secondary ray is not traced if its radiance counts for less than this in every colour of the
    /// pixel, 0 to 1; 0 traces all that count for anything.
    pub min_contribution: f64,
    /// The numbers that rays are traced in.
    pub precision: PrecisionChoice,
    /// The kernel that the timed pass is traced with; every one gives the same picture.
    pub kernel: KernelChoice,
    /// Where in a pixel the first sample lies.
    pub sampling: Sampling,
    /// Samples a pixel in the finished picture, at least 1. Measurements always take one.
    pub samples: u32,
    /// Threads; 0 takes as many as the machine has cores.
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
