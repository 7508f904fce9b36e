//! Trees with axis-aligned planes (kd-trees, octrees, grids) and bounding volume hierarchies: nodes,
//! builders, validation.
//!
//! For trees with planes, one driver handles termination, the distribution of objects, and the arrays. A
//! build method ([`split`]) only decides whether and where a cell is split. For hierarchies, a build method
//! ([`bvh`]) makes a binary one, which is then laid out with the chosen width. Trees of other programs are read
//! from files ([`tree_file`]).

mod box_node;
mod build;
pub mod bvh;
mod construct;
mod cost;
mod find;
mod frame;
mod index;
mod method;
mod moment;
mod node;
mod nodes;
mod registry;
mod settings;
pub(crate) mod simd_tree;
pub mod split;
mod tree;
pub mod tree_file;
mod validate;
mod voxels;

pub use box_node::{BoxNode, MAX_WIDTH};
pub use build::{BuildError, Inseparable};
pub use construct::build;
pub use cost::{CostCurve, Division, NodeCost, SplitCost};
pub use find::{Field, Order, Query};
pub use frame::{Frame, ObjectPlanes, is_inside};
pub use index::{NodeFacts, TreeIndex};
pub use moment::Moment;
pub use node::{Node, NodeKind, StopReason};
pub use nodes::Nodes;
pub use settings::{
    BuildSettings, Builder, Constants, MaxDepth, Method, OverlapRule, RootMargin, SettingsError,
};
pub use simd_tree::SimdTree;
pub use tree::{CellOfNode, Tree};
pub use validate::{Invalid, validate};
pub use voxels::Voxels;
