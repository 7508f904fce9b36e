//! An octree: every node is split in the middle along all three axes.
//!
//! Its leaves, and all parameters of leaves, are those of an octree with eight children per node.
//! Its inner nodes are the planes that separate the children, seven per octree node: x, then y,
//! then z.

use super::midpoint::Midpoint;
use crate::structure::method::Structure;
use crate::structure::settings::{Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "octree",
    summary: "eight equal parts per node",
    about: "Splits every node into eight, in the middle along all three axes. It is stored and traversed \
            as planes, seven per octree node: D_MAX, D_REACH and the inner nodes count planes, where \
            three levels of planes are one level of the octree.",
    source: "A. S. Glassner, Space subdivision for fast ray tracing, 1984; as planes: M. R. Kaplan, \
             Space-tracing: a constant time ray-tracer, 1985",
    paper: None,
    paper_spheres_exactly: true,
    structure: Structure::Octree,
    has_limits: true,
    constants: &[],
    builder: Builder::Cells(|settings| Box::new(Midpoint(settings.first_axis))),
};
