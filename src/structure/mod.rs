//! Trees with axis-aligned planes (kd-trees, octrees, grids): nodes, the build driver, validation.
//!
//! One driver ([`build`]) handles termination, the distribution of objects, and the arrays. A build
//! method ([`split`]) only decides whether and where a cell is split.

mod build;
mod cost;
mod find;
mod frame;
mod index;
mod method;
mod moment;
mod node;
mod registry;
mod settings;
pub(crate) mod simd_tree;
pub mod split;
mod tree;
mod validate;
mod voxels;

pub use build::{BuildError, Inseparable, build};
pub use cost::{CostCurve, NodeCost, SplitCost};
pub use find::{Field, Order, Query};
pub use frame::{Frame, ObjectPlanes, is_inside};
pub use index::{NodeFacts, TreeIndex};
pub use moment::Moment;
pub use node::{Node, NodeKind, StopReason};
pub use settings::{
    BuildSettings, Constants, MaxDepth, Method, OverlapRule, RootMargin, SettingsError,
};
pub use simd_tree::SimdTree;
pub use tree::{CellOfNode, Tree};
pub use validate::{Invalid, validate};
pub use voxels::Voxels;
