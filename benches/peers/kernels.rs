//! What is compared: every kernel answers the same rays.

use bspscope::geometry::Ray;

/// Distance and number of the nearest object, if there is one.
pub type Found = Option<(f64, u32)>;

/// A ray as most peers take it: 32 bytes.
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

/// The same rays in both forms; a kernel takes the one it works with.
#[derive(Clone, Copy)]
pub struct Rays<'a> {
    pub wide: &'a [Ray],
    pub narrow: &'a [NarrowRay],
}

/// A tree with its traversal. Answers are appended.
pub trait Kernel: Sync {
    fn closest(&self, rays: Rays<'_>, found: &mut Vec<Found>);
    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>);
}
