//! Blocks of objects that SIMD kernels test at once, as data.

use crate::primitive::{Primitive, UnitFrame};

/// Objects per block.
pub(crate) const BLOCK: usize = 16;

/// One number per object.
pub(crate) type Column = [f32; BLOCK];

/// Marks a place without an object.
pub(crate) const NONE: u32 = u32::MAX;

/// A block of objects of one kind, in the coordinates of the unit frame.
pub(crate) trait BlockData: Copy + Default + Send + Sync {
    /// Puts an object in a place.
    fn set(&mut self, place: usize, object: u32, primitive: &Primitive, frame: &UnitFrame);

    fn objects(&self) -> &[u32; BLOCK];
}
