//! The settings of one tree and its picture.

use super::names;
use crate::scene::{CameraOverride, Cylinders, Sampling};
use crate::structure::BuildSettings;
use crate::trace::{KernelChoice, PrecisionChoice, RenderSettings};
use serde::{Deserialize, Serialize};

/// What a tree is built with, and its picture traced; the camera is the workspace's.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct TreeSettings {
    pub cylinders: Cylinders,
    pub build: BuildSettings,
    pub picture: PictureSettings,
}

/// How a picture is traced: [`RenderSettings`] without a camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct PictureSettings {
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Samples a pixel, at least 1.
    pub samples: u32,
    /// How deep secondary rays go, `D_AREC`.
    pub d_arec: u32,
    /// The weight below which secondary rays are not traced, 0 to 1.
    #[serde(deserialize_with = "names::share")]
    pub cut_off: f64,
    pub precision: PrecisionChoice,
    pub kernel: KernelChoice,
    pub sampling: Sampling,
    /// 0 takes as many as the machine has cores.
    pub threads: usize,
}

/// As it stands in the file.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(with = "names::text")]
    cylinders: Cylinders,
    tree: BuildSettings,
    picture: PictureSettings,
}

impl TryFrom<Written> for TreeSettings {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let Written {
            cylinders,
            tree,
            picture,
        } = written;
        tree.check().map_err(|error| error.to_string())?;
        if picture.samples == 0 {
            return Err("samples is 0; it must be at least 1".into());
        }
        if picture.resolution.contains(&0) {
            return Err("resolution: a picture is at least 1 pixel wide and high".into());
        }
        Ok(TreeSettings {
            cylinders,
            build: tree,
            picture,
        })
    }
}

impl From<TreeSettings> for Written {
    fn from(settings: TreeSettings) -> Self {
        Written {
            cylinders: settings.cylinders,
            tree: settings.build,
            picture: settings.picture,
        }
    }
}

impl PictureSettings {
    /// All but the camera.
    pub fn of(render: &RenderSettings) -> Self {
        let RenderSettings {
            camera: _,
            width,
            height,
            d_arec,
            min_contribution: cut_off,
            precision,
            kernel,
            sampling,
            samples,
            threads,
        } = *render;
        PictureSettings {
            resolution: [width, height],
            samples,
            d_arec,
            cut_off,
            precision,
            kernel,
            sampling,
            threads,
        }
    }

    /// The settings with a camera.
    pub fn with(&self, camera: CameraOverride) -> RenderSettings {
        let [width, height] = self.resolution;
        RenderSettings {
            camera,
            width,
            height,
            d_arec: self.d_arec,
            min_contribution: self.cut_off,
            precision: self.precision,
            kernel: self.kernel,
            sampling: self.sampling,
            samples: self.samples,
            threads: self.threads,
        }
    }
}
