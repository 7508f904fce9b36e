//! The interface of the compared kernels.

use bspscope::geometry::Ray;

/// Distance and index of the closest object, if any.
pub type Found = Option<(f64, u32)>;

/// A ray in the layout of most peers: 32 bytes.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct NarrowRay {
    pub origin: [f32; 3],
    pub t_min: f32,
    pub direction: [f32; 3],
    pub t_max: f32,
}

impl From<&Ray> for NarrowRay {
    fn from(ray: &Ray) -> Self {
        NarrowRay {
            origin: ray.origin.as_vec3().to_array(),
            t_min: ray.t_min as f32,
            direction: ray.direction.as_vec3().to_array(),
            t_max: ray.t_max as f32,
        }
    }
}

/// The same rays in both layouts.
#[derive(Clone, Copy)]
pub struct Rays<'a> {
    pub wide: &'a [Ray],
    pub narrow: &'a [NarrowRay],
}

/// A tree with its traversal. Methods append their answers.
pub trait Kernel: Sync {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>);
    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>);
}
