//! Cache of the objects prepared for intersection, kept as long as the scene.

use crate::geometry::Aabb;
use crate::primitive::{Precision, Primitive, Shapes};
use std::sync::OnceLock;

/// One slot per precision, filled on first use. The content follows from the scene, so two scenes
/// are equal regardless of what is cached.
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
