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

/// What is known of a build method before it is used.
pub struct MethodInfo {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Name in lists for people.
    pub title: &'static str,
    /// One sentence: how it splits.
    pub about: &'static str,
    /// Who described it.
    pub source: &'static str,
    /// Its number in the paper, if it is one of the paper's methods.
    pub paper: Option<u32>,
    /// What [`OverlapRule::Paper`] means for it: whether spheres are held against cells exactly.
    pub paper_spheres_exactly: bool,
    /// What its cells form.
    pub structure: Structure,
    /// Its own constants.
    pub constants: &'static [Constant],
    /// Makes the rule for checked settings.
    pub rule: fn(&BuildSettings) -> Box<dyn SplitRule>,
}

impl MethodInfo {
    /// The overlap rule in words, for reports.
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

/// What the cells of a method form, and so where they may end and how rays walk through them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// A cell with at most `N_OILF` objects or at depth `D_MAX` is a leaf.
    Bintree,
    /// The same, but only at every third level: the three levels of planes between are one node of an
    /// octree with its eight children.
    Octree,
    /// The leaves are the voxels of a uniform grid. `D_MAX` and `N_OILF` do not apply, and rays go from
    /// voxel to voxel: the planes are passed by none, and only say where the voxels are.
    Grid,
}

impl Structure {
    /// Whether a cell at this depth may become a leaf for holding few objects or for its depth.
    pub(super) fn ends_at(self, depth: u32) -> bool {
        match self {
            Structure::Bintree => true,
            Structure::Octree => depth.is_multiple_of(3),
            Structure::Grid => false,
        }
    }

    /// Levels that a cell is split by at once.
    pub(super) fn levels(self) -> u32 {
        match self {
            Structure::Octree => 3,
            Structure::Bintree | Structure::Grid => 1,
        }
    }

    /// What to do for a smaller tree.
    pub(super) fn how_to_shrink(self) -> &'static str {
        match self {
            Structure::Bintree | Structure::Octree => "lower D_MAX, raise N_OILF",
            Structure::Grid => "lower the density of voxels",
        }
    }
}

/// A constant of a build method that can be set.
pub struct Constant {
    /// Name on the command line and in files.
    pub name: &'static str,
    pub default: f64,
    pub lowest: f64,
    pub highest: f64,
    /// 0 for any number, 1 for whole numbers (switches go from 0 to 1).
    pub step: f64,
    /// Unit, or an empty string for a plain number.
    pub unit: &'static str,
    /// What it does.
    pub about: &'static str,
    /// Where its default comes from.
    pub source: &'static str,
}

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
