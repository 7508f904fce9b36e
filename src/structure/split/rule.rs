//! What a build method decides, and what it sees of a cell.

use crate::geometry::{Aabb, Axis};
use crate::primitive::Primitive;
use crate::progress::Progress;
use crate::structure::frame::{Frame, ObjectPlanes};
use crate::structure::node::StopReason;

/// Decides whether and where a cell is split.
pub trait SplitRule: Send + Sync {
    /// Decides on a cell that contains more than `N_OILF` objects and is above depth `D_MAX`.
    fn decide(&self, cell: &Cell<'_>) -> Decision;

    /// Returns into how many equal slices along each axis the rule divides a cell at the least if it
    /// splits every part of it for `levels` levels; `None` if that depends on the objects. The driver
    /// stops a build that cannot fit in memory before it does the work.
    fn slices(&self, _cell: &Cell<'_>, _levels: u32) -> Option<[f64; 3]> {
        None
    }
}

/// A decision on a cell. Planes are in local coordinates ([`Frame`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    Leaf(StopReason),
    Split {
        axis: Axis,
        plane: f32,
    },
    /// A split that does not lower the cost enough, made in the hope of better ones below it; see
    /// [`Cell::failed_splits`].
    FailedSplit {
        axis: Axis,
        plane: f32,
    },
    /// Cuts an empty slab out: below | empty | above. Counts as one level of depth.
    Cut {
        axis: Axis,
        slab: [f32; 2],
    },
}

/// The cell that a rule decides on.
pub struct Cell<'a> {
    pub frame: &'a Frame,
    /// The cell in world coordinates.
    pub bounds: Aabb,
    /// The cell in local coordinates: lower and upper end along each axis.
    pub local: [[f32; 2]; 3],
    pub depth: u32,
    pub depth_limit: u32,
    /// Number of [`Decision::FailedSplit`]s between the root and the cell.
    pub failed_splits: u32,
    /// Objects that overlap the cell, by number, in any order.
    pub inside: &'a [u32],
    /// Objects that only touch the cell from outside.
    pub touching: &'a [u32],
    /// All objects of the scene, by number.
    pub primitives: &'a [Primitive],
    /// The bounds of all objects.
    pub object_bounds: &'a [Aabb],
    /// The bounds of all objects, as planes.
    pub object_planes: &'a [ObjectPlanes],
    /// Slow rules check this and may return any decision once the build is cancelled.
    pub progress: &'a Progress,
}

impl Cell<'_> {
    /// Returns the objects of the cell, in any order.
    pub fn objects(&self) -> impl Iterator<Item = u32> + '_ {
        self.inside.iter().chain(self.touching).copied()
    }

    /// Returns the number of objects of the cell.
    pub fn object_count(&self) -> usize {
        self.inside.len() + self.touching.len()
    }

    /// Returns the plane through the middle of the cell.
    pub fn midpoint(&self, axis: Axis) -> f32 {
        let [lo, hi] = self.local[axis.index()];
        lo * 0.5 + hi * 0.5
    }

    /// Returns whether a plane is strictly inside the cell.
    pub fn divides(&self, axis: Axis, plane: f32) -> bool {
        let [lo, hi] = self.local[axis.index()];
        lo < plane && plane < hi
    }

    /// Returns whether a plane is strictly inside the cell in world coordinates, too. Far away from the
    /// origin, these are sparser than local coordinates.
    pub fn divides_in_world(&self, axis: Axis, plane: f32) -> bool {
        let (plane, k) = (self.frame.to_world(axis, f64::from(plane)), axis.index());
        self.bounds.lo[k] < plane && plane < self.bounds.hi[k]
    }

    /// Returns the extent of an object along an axis, clipped to the cell, in world coordinates.
    pub fn clipped(&self, object: u32, axis: Axis) -> [f64; 2] {
        let (bounds, k) = (&self.object_bounds[object as usize], axis.index());
        [
            bounds.lo[k].max(self.bounds.lo[k]),
            bounds.hi[k].min(self.bounds.hi[k]),
        ]
    }
}
