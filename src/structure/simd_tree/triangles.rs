//! Blocks of triangles, by their vertices.

use super::block::{BlockData, NONE};
use crate::primitive::{Primitive, UnitFrame};

/// A block of triangles.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Triangles<const N: usize> {
    /// By vertex and axis.
    pub(crate) vertices: [[[f32; N]; 3]; 3],
    pub(crate) objects: [u32; N],
}

impl<const N: usize> Default for Triangles<N> {
    fn default() -> Self {
        Triangles {
            vertices: [[[f32::NAN; N]; 3]; 3],
            objects: [NONE; N],
        }
    }
}

impl<const N: usize> BlockData for Triangles<N> {
    const PLACES: usize = N;

    fn set(&mut self, place: usize, object: u32, primitive: &Primitive, frame: &UnitFrame) {
        let Primitive::Triangle(triangle) = primitive else {
            unreachable!("all objects are triangles");
        };
        for (vertex, columns) in triangle.vertices.iter().zip(&mut self.vertices) {
            let vertex = frame.point(*vertex).as_vec3();
            for k in 0..3 {
                columns[k][place] = vertex[k];
            }
        }
        self.objects[place] = object;
    }

    fn objects(&self) -> &[u32] {
        &self.objects
    }
}
