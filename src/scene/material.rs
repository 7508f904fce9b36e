//! Materials and lights, with the parameters of NFF.

use crate::geometry::Vec3;
use serde::{Deserialize, Serialize};

/// NFF's shading parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Linear color, 0 to 1 per channel.
    pub color: Vec3,
    /// Diffuse fraction, `Kd`.
    pub diffuse: f64,
    /// Specular fraction, `Ks`: the weight of the highlight and of the reflected ray.
    pub specular: f64,
    /// Exponent of the cosine in the highlight, `Shine`.
    pub shine: f64,
    /// Weight of the refracted ray, `T`; 0 is opaque.
    pub transmittance: f64,
    /// Index of refraction inside the object, relative to the outside.
    pub index_of_refraction: f64,
}

impl Default for Material {
    fn default() -> Self {
        Material {
            color: Vec3::ONE,
            diffuse: 1.0,
            specular: 0.0,
            shine: 0.0,
            transmittance: 0.0,
            index_of_refraction: 1.0,
        }
    }
}

/// A point light whose intensity does not fall off with distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Light {
    pub position: Vec3,
    /// Linear color times intensity. `None` if the file gives no color: white with intensity
    /// 1/√`N_L`.
    pub color: Option<Vec3>,
}
