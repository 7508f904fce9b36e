//! The picked pixel: its recorded rays, the selected ray, and the step that is shown.

use crate::trace::{PixelRecord, RayPath, Step};
use std::sync::Arc;

/// A pixel whose rays are to be recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wish {
    pub pixel: [u32; 2],
    /// The ray to be selected, by its place.
    pub ray: usize,
}

/// A pixel whose rays were recorded.
pub struct Picked {
    pub pixel: [u32; 2],
    pub record: Arc<PixelRecord>,
    /// The selected ray, by its place in the record.
    pub ray: usize,
    /// Its current step; 0 where it has none.
    pub step: usize,
}

impl Picked {
    /// The selected ray.
    pub fn path(&self) -> &RayPath {
        &self.record.rays[self.ray].path
    }

    /// The primary ray.
    pub fn primary(&self) -> &RayPath {
        &self.record.rays[0].path
    }

    /// The current step; `None` where the ray misses the tree.
    pub fn current(&self) -> Option<&Step> {
        self.path().steps.get(self.step)
    }
}
