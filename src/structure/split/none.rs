//! No tree at all: one leaf that holds every object. The naive tracer, and the judge of all others.

use super::rule::{Cell, Decision, SplitRule};
use crate::structure::method::Structure;
use crate::structure::node::StopReason;
use crate::structure::settings::MethodInfo;

pub(super) const METHOD: MethodInfo = MethodInfo {
    name: "none",
    title: "None: every object tested",
    about: "Never splits: one leaf holds all objects and every ray is tested against all of them.",
    source: "T. Whitted, An improved illumination model for shaded display, 1980",
    paper: None,
    paper_spheres_exactly: false,
    structure: Structure::Bintree,
    constants: &[],
    rule: |_| Box::new(Never),
};

struct Never;

impl SplitRule for Never {
    fn decide(&self, _: &Cell<'_>) -> Decision {
        Decision::Leaf(StopReason::NotSplit)
    }
}
