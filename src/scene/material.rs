//! How surfaces look and what lights them, as NFF has it.

use crate::geometry::Vec3;
use serde::{Deserialize, Serialize};

/// NFF's shading parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Linear colour, 0 to 1 a channel.
    pub color: Vec3,
    /// Diffuse share `Kd`.
    pub diffuse: f64,
    /// Specular share `Ks`: weight of the highlight and of the reflected ray.
    pub specular: f64,
    /// Exponent of the highlight's cosine, `Shine`.
    pub shine: f64,
    /// Share of the refracted ray, `T`; 0 is opaque.
    pub transmittance: f64,
    /// Index of refraction of the body behind the surface, relative to the outside.
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

/// A light at a point, without fall-off over distance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Light {
    pub position: Vec3,
    /// Linear colour and intensity; `None` where the file gives none: white, 1/√`N_L`.
    pub color: Option<Vec3>,
}
