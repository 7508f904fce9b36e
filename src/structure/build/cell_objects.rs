//! The objects of a cell.

use crate::structure::frame::{ObjectPlanes, is_inside};

/// The objects of a cell by number: those that overlap it, and those that only touch it from
/// outside. The latter do not overlap any part of the cell either.
#[derive(Default)]
pub(super) struct CellObjects {
    pub(super) inside: Vec<u32>,
    pub(super) touching: Vec<u32>,
}

impl CellObjects {
    /// Returns all objects of a scene, given by their planes.
    pub(super) fn of_root(planes: &[ObjectPlanes], root: &[[f32; 2]; 3]) -> Self {
        let all = 0..planes.len() as u32;
        let (inside, touching) = all.partition(|&object| is_inside(&planes[object as usize], root));
        CellObjects { inside, touching }
    }

    /// Returns whether objects inside the cell and objects that only touch it are in the right
    /// lists.
    pub(super) fn are_partitioned(&self, planes: &[ObjectPlanes], cell: &[[f32; 2]; 3]) -> bool {
        let is_inside = |object: &u32| is_inside(&planes[*object as usize], cell);
        self.inside.iter().all(is_inside) && !self.touching.iter().any(is_inside)
    }

    pub(super) fn len(&self) -> usize {
        self.inside.len() + self.touching.len()
    }

    pub(super) fn clear(&mut self) {
        self.inside.clear();
        self.touching.clear();
    }
}
