//! BSP trees (axis-aligned bintrees): nodes, the build driver, validation.
//!
//! One driver ([`build`]) owns termination, the distribution of objects and the arrays; a build
//! method ([`split`]) only says where, if anywhere, a cell is split.

mod build;
mod cost;
mod derived;
mod find;
mod frame;
mod index;
mod method;
mod moment;
mod node;
mod registry;
mod settings;
pub mod split;
mod tree;
mod validate;
mod voxels;

pub use build::{BuildError, build};
pub use cost::{CostCurve, NodeCost, SplitCost};
pub use find::{Field, Order, Query};
pub use frame::{Frame, ObjectPlanes, is_inside};
pub use index::{NodeFacts, TreeIndex};
pub use moment::Moment;
pub use node::{Node, NodeKind, StopReason};
pub use settings::{BuildSettings, Constants, MaxDepth, Method, OverlapRule, SettingsError};
pub use tree::{CellOfNode, Tree};
pub use validate::{Invalid, validate};
pub use voxels::Voxels;
