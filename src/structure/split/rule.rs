//! What a build method decides, and what it sees of a cell.

use crate::geometry::{Aabb, Axis};
use crate::primitive::Primitive;
use crate::progress::Progress;
use crate::structure::frame::{Frame, ObjectPlanes};
use crate::structure::node::StopReason;

/// Says where, if anywhere, a cell is split.
pub trait SplitRule: Send + Sync {
    /// The cell holds more than `N_OILF` objects and lies above `D_MAX`.
    fn decide(&self, cell: &Cell<'_>) -> Decision;
}

/// What becomes of a cell. Planes are in the coordinates of the root cell ([`Frame`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Decision {
    Leaf(StopReason),
    Split {
        axis: Axis,
        plane: f32,
    },
    /// A split that gains too little to be worth itself, made in the hope of better ones below it:
    /// see [`Cell::failed_splits`].
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

/// A cell as a rule sees it.
pub struct Cell<'a> {
    pub frame: &'a Frame,
    /// The cell in the world.
    pub bounds: Aabb,
    /// The cell in the coordinates of the root cell: lower and upper end by axis.
    pub local: [[f32; 2]; 3],
    pub depth: u32,
    pub depth_limit: u32,
    /// How many of the splits between the root and the cell were [`Decision::FailedSplit`]s.
    pub failed_splits: u32,
    /// Numbers of its objects that do more than touch it from outside, in any order.
    pub inside: &'a [u32],
    /// Those that only touch it.
    pub touching: &'a [u32],
    /// All objects of the scene, by number.
    pub primitives: &'a [Primitive],
    /// Their bounds.
    pub object_bounds: &'a [Aabb],
    /// Their bounds as planes.
    pub object_planes: &'a [ObjectPlanes],
    /// Rules that take long look at it and decide anything once the build is cancelled.
    pub progress: &'a Progress,
}

impl Cell<'_> {
    /// Numbers of its objects, in any order.
    pub fn objects(&self) -> impl Iterator<Item = u32> + '_ {
        self.inside.iter().chain(self.touching).copied()
    }

    /// How many objects it has.
    pub fn object_count(&self) -> usize {
        self.inside.len() + self.touching.len()
    }

    /// The plane through the middle of the cell.
    pub fn midpoint(&self, axis: Axis) -> f32 {
        let [lo, hi] = self.local[axis.index()];
        lo * 0.5 + hi * 0.5
    }

    /// Whether a plane lies strictly inside the cell.
    pub fn divides(&self, axis: Axis, plane: f32) -> bool {
        let [lo, hi] = self.local[axis.index()];
        lo < plane && plane < hi
    }

    /// The extent of an object along an axis, clipped to the cell, in the world.
    pub fn clipped(&self, object: u32, axis: Axis) -> [f64; 2] {
        let (bounds, k) = (&self.object_bounds[object as usize], axis.index());
        [
            bounds.lo[k].max(self.bounds.lo[k]),
            bounds.hi[k].min(self.bounds.hi[k]),
        ]
    }
}
