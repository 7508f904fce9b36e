//! The objects made ready for intersection, kept as long as the scene.

use crate::geometry::Aabb;
use crate::primitive::{Precision, Primitive, Shapes};
use std::sync::OnceLock;

/// One place for every precision, filled when it is first asked for. It follows from the scene, so
/// that it is no part of what makes two scenes equal.
#[derive(Default)]
pub(super) struct Prepared([OnceLock<Shapes>; 2]);

impl Prepared {
    pub(super) fn get(
        &self,
        precision: Precision,
        objects: &[Primitive],
        bounds: &Aabb,
    ) -> &Shapes {
        self.0[precision as usize].get_or_init(|| Shapes::of(objects, bounds, precision))
    }
}

impl Clone for Prepared {
    fn clone(&self) -> Self {
        Prepared::default()
    }
}

impl PartialEq for Prepared {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl std::fmt::Debug for Prepared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Prepared")
    }
}
