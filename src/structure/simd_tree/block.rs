//! Blocks of objects that SIMD kernels test at once, as data.

use super::pages::Pages;
use crate::primitive::{Primitive, UnitFrame};
use crate::structure::box_node::MAX_WIDTH;

/// Objects per block of a tree with planes, whose leaves share objects: a vector of the widest kind.
pub(crate) const IN_PLANES: usize = 16;

/// Objects per block of a hierarchy: as many as a node has children.
pub(crate) const IN_BOXES: usize = MAX_WIDTH;

/// Marks a place without an object.
pub(crate) const NONE: u32 = u32::MAX;

/// A block of objects of one kind, in the coordinates of the unit frame.
pub(crate) trait BlockData: Copy + Default + Send + Sync {
    /// Objects per block.
    const PLACES: usize;

    /// Puts an object in a place.
    fn set(&mut self, place: usize, object: u32, primitive: &Primitive, frame: &UnitFrame);

    /// Returns the objects by place.
    fn objects(&self) -> &[u32];

    /// Appends blocks of these objects, the last one perhaps with empty places.
    fn append(to: &mut Pages<Self>, held: &[u32], objects: &[Primitive], frame: &UnitFrame) {
        for held in held.chunks(Self::PLACES) {
            let mut block = Self::default();
            for (place, &object) in held.iter().enumerate() {
                block.set(place, object, &objects[object as usize], frame);
            }
            to.push(block);
        }
    }
}
