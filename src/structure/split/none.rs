//! No tree: one leaf that contains all objects. This is the naive ray tracer, and the reference for
//! all other methods.

use super::rule::{Cell, Decision, SplitRule};
use crate::structure::method::Structure;
use crate::structure::node::StopReason;
use crate::structure::settings::{Builder, MethodInfo};

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "none",
    summary: "tests every object",
    about: "Never splits. One leaf contains all objects, and every ray is tested against all of them.",
    source: "T. Whitted, An improved illumination model for shaded display, 1980",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    has_limits: false,
    constants: &[],
    builder: Builder::Cells(|_| Box::new(Never)),
};

struct Never;

impl SplitRule for Never {
    fn decide(&self, _: &Cell<'_>) -> Decision {
        Decision::Leaf(StopReason::NotSplit)
    }
}
