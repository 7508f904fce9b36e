//! Build methods. A method is one file here and one line in [`SPLIT_RULES`].

mod grid;
mod midpoint;
mod midpoint_longest;
mod none;
mod object_median;
mod octree;
mod sah;
mod sah_auto;
mod sah_cut;
mod sah_sampled;
mod sweep;

use super::{BuildSettings, Frame, ObjectPlanes, OverlapRule, StopReason};
use crate::geometry::{Aabb, Axis};
use crate::primitive::Primitive;
use crate::progress::Progress;

/// All build methods.
pub static SPLIT_RULES: &[MethodInfo] = &[
    midpoint::METHOD,
    sah_cut::METHOD,
    sah_auto::METHOD,
    sah_sampled::METHOD,
    sah::METHOD,
    midpoint_longest::METHOD,
    object_median::METHOD,
    octree::METHOD,
    grid::METHOD,
    none::METHOD,
];

/// The description of a build method.
pub struct MethodInfo {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Name in lists for users.
    pub title: &'static str,
    /// A short description of how it splits.
    pub about: &'static str,
    /// Publications that describe it.
    pub source: &'static str,
    /// Its number in the paper, if it is one of the paper's methods.
    pub paper: Option<u32>,
    /// What [`OverlapRule::Paper`] means for it: whether spheres are tested against cells exactly.
    pub paper_spheres_exactly: bool,
    /// The structure that its cells form.
    pub structure: Structure,
    /// The settings of this method.
    pub constants: &'static [Constant],
    /// Creates the rule for valid settings.
    pub rule: fn(&BuildSettings) -> Box<dyn SplitRule>,
}

impl MethodInfo {
    /// Describes the overlap rule, for reports.
    pub fn overlap_text(&self, rule: OverlapRule) -> &'static str {
        match rule {
            OverlapRule::Paper if self.paper_spheres_exactly => {
                "spheres exactly, all others by bounds"
            }
            OverlapRule::Paper | OverlapRule::Bounds => "bounds",
            OverlapRule::Exact => "exactly",
        }
    }
}

/// The structure that the cells of a method form. It determines where cells may become leaves and
/// how rays traverse them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// A cell with at most `N_OILF` objects or at depth `D_MAX` is a leaf.
    Bintree,
    /// Like [`Structure::Bintree`], but cells become leaves only at every third level: three levels
    /// of planes are one octree node with eight children.
    Octree,
    /// The leaves are the voxels of a uniform grid. `D_MAX` and `N_OILF` do not apply. Rays step
    /// from voxel to voxel; the planes only define where the voxels are.
    Grid,
}

impl Structure {
    /// Returns whether a cell at this depth may become a leaf because of `N_OILF` or `D_MAX`.
    pub(super) fn ends_at(self, depth: u32) -> bool {
        match self {
            Structure::Bintree => true,
            Structure::Octree => depth.is_multiple_of(3),
            Structure::Grid => false,
        }
    }

    /// Returns the number of levels by which a cell is split at once.
    pub(super) fn levels(self) -> u32 {
        match self {
            Structure::Octree => 3,
            Structure::Bintree | Structure::Grid => 1,
        }
    }

    /// Returns advice on how to get a smaller tree.
    pub(super) fn how_to_shrink(self) -> &'static str {
        match self {
            Structure::Bintree | Structure::Octree => "lower D_MAX, raise N_OILF",
            Structure::Grid => "lower the density of voxels",
        }
    }
}

/// A setting of a build method.
pub struct Constant {
    /// Name on the command line and in files.
    pub name: &'static str,
    pub default: f64,
    pub lowest: f64,
    pub highest: f64,
    /// 0 for any number, 1 for integers (0 and 1 for switches).
    pub step: f64,
    /// Unit; empty for a number without a unit.
    pub unit: &'static str,
    /// What it does.
    pub about: &'static str,
    /// Where its default comes from.
    pub source: &'static str,
}

/// Decides whether and where a cell is split.
pub trait SplitRule: Send + Sync {
    /// Decides on a cell that contains more than `N_OILF` objects and is above depth `D_MAX`.
    fn decide(&self, cell: &Cell<'_>) -> Decision;
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

    /// Returns the extent of an object along an axis, clipped to the cell, in world coordinates.
    pub fn clipped(&self, object: u32, axis: Axis) -> [f64; 2] {
        let (bounds, k) = (&self.object_bounds[object as usize], axis.index());
        [
            bounds.lo[k].max(self.bounds.lo[k]),
            bounds.hi[k].min(self.bounds.hi[k]),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_defaults_lie_in_their_ranges() {
        assert!(!SPLIT_RULES.is_empty());
        for (i, method) in SPLIT_RULES.iter().enumerate() {
            assert!(SPLIT_RULES[..i].iter().all(|m| m.name != method.name));
            assert!(!method.source.is_empty() && !method.about.is_empty());
            for (k, c) in method.constants.iter().enumerate() {
                assert!(
                    method.constants[..k]
                        .iter()
                        .all(|other| other.name != c.name)
                );
                assert!((c.lowest..=c.highest).contains(&c.default), "{}", c.name);
                assert!(!c.source.is_empty() && !c.about.is_empty());
            }
        }
    }

    #[test]
    fn the_paper_has_two_methods() {
        let numbers: Vec<_> = SPLIT_RULES.iter().filter_map(|m| m.paper).collect();
        assert_eq!(numbers, [1, 2]);
    }
}
