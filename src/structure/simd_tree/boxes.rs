//! Blocks of objects of any kind, by their bounds.

use super::block::{BlockData, NONE};
use crate::primitive::{Primitive, Shape, UnitFrame};

/// A block of objects of any kind, by their bounds.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Boxes<const N: usize> {
    /// Lower and upper corners, by axis.
    pub(crate) corners: [[[f32; N]; 3]; 2],
    pub(crate) objects: [u32; N],
}

impl<const N: usize> Default for Boxes<N> {
    fn default() -> Self {
        Boxes {
            corners: [[[f32::NAN; N]; 3]; 2],
            objects: [NONE; N],
        }
    }
}

impl<const N: usize> BlockData for Boxes<N> {
    const PLACES: usize = N;

    fn set(&mut self, place: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let bounds = primitive.bounds();
        for (corner, columns) in [bounds.lo, bounds.hi].into_iter().zip(&mut self.corners) {
            let corner = frame.point(corner).as_vec3();
            for k in 0..3 {
                columns[k][place] = corner[k];
            }
        }
        self.objects[place] = object;
    }

    fn objects(&self) -> &[u32] {
        &self.objects
    }
}
