//! What describes a build method: the structure that its cells form, and its constants.

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
