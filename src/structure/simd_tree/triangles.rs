//! Blocks of triangles, by their vertices.

use super::block::{BLOCK, BlockData, Column, NONE};
use crate::primitive::{Primitive, UnitFrame};

/// A block of triangles.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct Triangles {
    /// By vertex and axis.
    pub(crate) vertices: [[Column; 3]; 3],
    pub(crate) objects: [u32; BLOCK],
}

impl Default for Triangles {
    fn default() -> Self {
        Triangles {
            vertices: [[[f32::NAN; BLOCK]; 3]; 3],
            objects: [NONE; BLOCK],
        }
    }
}

impl BlockData for Triangles {
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

    fn objects(&self) -> &[u32; BLOCK] {
        &self.objects
    }
}
