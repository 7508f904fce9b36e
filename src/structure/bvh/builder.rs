//! What a builder of bounding volume hierarchies gets, and what it makes.

use super::binary::Binary;
use crate::geometry::{Aabb, Vec3};
use crate::primitive::Primitive;
use crate::progress::{Cancelled, Progress};

/// Builds a binary hierarchy. The result must not depend on the number of threads.
pub trait BvhBuilder: Send + Sync {
    /// Returns the hierarchy of at least one object.
    ///
    /// # Errors
    /// Cancellation.
    fn build(&self, input: &Input<'_>) -> Result<Binary, Cancelled>;

    /// Returns how many references per object the leaves hold at most.
    fn max_references_per_object(&self) -> f64 {
        1.0
    }
}

/// The objects of a scene.
pub struct Input<'a> {
    pub objects: &'a [Primitive],
    /// The bounds of all objects.
    pub bounds: &'a [Aabb],
    /// Maximum depth of a leaf of the binary hierarchy, for builders from the root downward.
    pub depth_limit: u32,
    pub progress: &'a Progress,
}

impl Input<'_> {
    /// Returns the number of objects as node and object indices count them.
    pub fn count(&self) -> u32 {
        self.bounds.len() as u32
    }

    /// Returns the center of an object's bounds.
    pub fn center(&self, object: u32) -> Vec3 {
        center(&self.bounds[object as usize])
    }
}

/// Returns the center of a box, which does not overflow.
pub fn center(bounds: &Aabb) -> Vec3 {
    bounds.lo * 0.5 + bounds.hi * 0.5
}
