//! What a split costs, and the cheapest split found so far.

use crate::geometry::Axis;
use crate::structure::settings::BuildSettings;
use crate::structure::split::rule::Cell;

/// The ends of an extent along an axis, as planes.
pub(super) type Extent = [f32; 2];

/// Costs in tests of a block.
pub(super) struct Costs {
    block: u32,
    traversal_cost: f32,
    empty_factor: f32,
}

impl Costs {
    pub(super) fn new(settings: &BuildSettings) -> Self {
        Costs {
            block: settings.constant("block") as u32,
            traversal_cost: settings.constant("traversal-cost") as f32,
            empty_factor: settings.constant("empty-factor") as f32,
        }
    }

    pub(super) fn blocks(&self, objects: usize) -> f32 {
        (objects as u32).div_ceil(self.block) as f32
    }

    /// Returns the expected cost of a ray through the split cell, in block tests, without the
    /// factor for empty sides.
    pub(super) fn cost_of_parts(&self, plane: &Plane, areas: &Areas) -> f32 {
        let work = areas.below(plane.at) * self.blocks(plane.below)
            + areas.above(plane.at) * self.blocks(plane.above);
        self.traversal_cost + work
    }

    /// Returns the same with the factor for empty sides.
    pub(super) fn cost(&self, plane: &Plane, areas: &Areas) -> f32 {
        let empty = plane.below == 0 || plane.above == 0;
        let factor = if empty { self.empty_factor } else { 1.0 };
        factor * self.cost_of_parts(plane, areas)
    }
}

/// A plane and the number of objects with a part on each side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plane {
    pub(super) at: f32,
    pub(super) below: usize,
    pub(super) above: usize,
}

/// The cheapest choice found for a cell.
pub(super) struct Best {
    pub(super) cost: f32,
    /// `None` for a leaf.
    pub(super) plane: Option<(Axis, f32)>,
}

impl Best {
    /// Takes a plane if it is cheaper. Among planes of equal cost, the lowest on the first axis
    /// wins.
    pub(super) fn offer(&mut self, axis: Axis, at: f32, cost: f32) {
        let earlier = |(other, plane): (Axis, f32)| (axis.index(), at) < (other.index(), plane);
        let earlier = self.plane.is_some_and(earlier);
        if cost < self.cost || cost == self.cost && earlier {
            *self = Best {
                cost,
                plane: Some((axis, at)),
            };
        }
    }
}

/// Surface areas of the two parts of a cell, as fractions of the cell's area; linear in the plane.
pub(super) struct Areas {
    pub(super) ends: Extent,
    /// Share of the two faces parallel to the plane.
    pub(super) faces: f32,
    /// Share of the other four faces, a unit of the plane's coordinate.
    pub(super) rim: f32,
}

impl Areas {
    pub(super) fn new(cell: &Cell<'_>, axis: Axis) -> Self {
        let (k, size) = (axis.index(), cell.bounds.size());
        let (u, v) = (size[(k + 1) % 3], size[(k + 2) % 3]);
        let ends = cell.local[k];
        let area = cell.bounds.surface_area();
        Areas {
            ends,
            faces: (2.0 * u * v / area) as f32,
            rim: (2.0 * (u + v) * size[k] / area) as f32 / (ends[1] - ends[0]),
        }
    }

    fn below(&self, plane: f32) -> f32 {
        self.faces + self.rim * (plane - self.ends[0])
    }

    fn above(&self, plane: f32) -> f32 {
        self.faces + self.rim * (self.ends[1] - plane)
    }
}
