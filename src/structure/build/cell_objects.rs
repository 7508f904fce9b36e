//! The objects of a cell.

use crate::structure::frame::{ObjectPlanes, is_inside};

/// Numbers of the objects of a cell: those inside it, and those that only touch it from outside, which
/// are inside none of its parts either.
#[derive(Default)]
pub(super) struct CellObjects {
    pub(super) inside: Vec<u32>,
    pub(super) touching: Vec<u32>,
}

impl CellObjects {
    /// All objects of a scene, by their planes.
    pub(super) fn of_root(planes: &[ObjectPlanes], root: &[[f32; 2]; 3]) -> Self {
        let all = 0..planes.len() as u32;
        let (inside, touching) = all.partition(|&object| is_inside(&planes[object as usize], root));
        CellObjects { inside, touching }
    }

    /// Whether those inside a cell are told from those that only touch it.
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
