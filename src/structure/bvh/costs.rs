//! The costs that all builders count.

use crate::geometry::Aabb;
use crate::structure::settings::BuildSettings;

/// Costs of the surface-area heuristic (SAH), as all builders count them.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// Cost of an inner node.
    pub traversal: f64,
    /// Cost of the test of a block of objects.
    pub test: f64,
    /// Objects per block.
    pub block: usize,
    /// A leaf with more objects is always split.
    pub max_leaf: usize,
    /// A node with at most this many objects is a leaf, `N_OILF`.
    pub min_leaf: usize,
}

impl Costs {
    /// Reads the constants `cost-traversal`, `cost-test`, `block` and `max-leaf` of a method.
    pub fn of(settings: &BuildSettings) -> Costs {
        Costs {
            traversal: settings.constant("cost-traversal"),
            test: settings.constant("cost-test"),
            block: settings.constant("block") as usize,
            max_leaf: settings.constant("max-leaf") as usize,
            min_leaf: if settings.method.has_limits {
                settings.n_oilf as usize
            } else {
                1
            },
        }
    }

    /// Returns the area of a part's bounds, multiplied by the number of blocks that its references take.
    pub fn of_part(&self, (bounds, count): (Aabb, usize)) -> f64 {
        bounds.surface_area() * self.blocks(count)
    }

    /// Returns the number of blocks that objects take.
    pub fn blocks(&self, objects: usize) -> f64 {
        objects.div_ceil(self.block) as f64
    }
}
