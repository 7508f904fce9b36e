//! What describes a build method: the structure that its cells form, and its constants.

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
    /// A bounding volume hierarchy: every node has a box around its objects, and boxes may overlap.
    Bvh,
}

impl Structure {
    /// Returns whether a cell at this depth may become a leaf because of `N_OILF` or `D_MAX`.
    pub(super) fn ends_at(self, depth: u32) -> bool {
        match self {
            Structure::Bintree | Structure::Bvh => true,
            Structure::Octree => depth.is_multiple_of(3),
            Structure::Grid => false,
        }
    }

    /// Returns the number of levels by which a cell is split at once.
    pub(super) fn levels(self) -> u32 {
        match self {
            Structure::Octree => 3,
            Structure::Bintree | Structure::Grid | Structure::Bvh => 1,
        }
    }

    /// Returns how many levels a cell at this depth may be split if `D_MAX` is `limit`. It does not limit a
    /// grid.
    pub(super) fn levels_left(self, depth: u32, limit: u32) -> u32 {
        (limit - limit % self.levels()).saturating_sub(depth)
    }

    /// Returns the heading under which lists of methods have it.
    pub const fn family(self) -> &'static str {
        match self {
            Structure::Bintree => "kd-trees",
            Structure::Octree | Structure::Grid => "Octree and grid",
            Structure::Bvh => "Bounding volume hierarchies",
        }
    }

    /// Returns advice on how to get a smaller tree.
    pub(super) fn how_to_shrink(self) -> &'static str {
        match self {
            Structure::Bintree | Structure::Octree => "lower D_MAX, raise N_OILF",
            Structure::Grid => "lower the density of voxels",
            Structure::Bvh => "choose a method with fewer references",
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
