//! One traversal for everything: closest hit, any hit, timing without tests, recording.
//!
//! The order of visits is that of K. Sung and P. Shirley (Graphics Gems III, 1992): front to back
//! with a stack. Decisions are conservative: the distance to a plane carries a few roundings, so an
//! interval is widened by more than that whenever a plane bounds it, and a comparison that NaN
//! could reach is written so that NaN visits both children. Objects within rounding of a plane are
//! in the leaves of both sides ([`crate::structure::Frame::slack`]). What is widened, and by how much, is
//! the business of the two [`TraversalRay`]s, one a precision.

use super::line::{Real, TraversalRay};
use super::{Children, Probe};
use crate::structure::Tree;

/// What is done in the leaves a ray visits.
pub trait LeafVisitor {
    /// Visits a leaf and says beyond which `t` nothing matters any more; −∞ ends the walk.
    fn visit<P: Probe>(&mut self, objects: &[u32], probe: &mut P) -> f64;
}

/// Memory that traversals reuse from ray to ray.
#[derive(Debug, Default)]
pub struct Scratch {
    pub(super) narrow: Vec<Waiting<f32>>,
    pub(super) wide: Vec<Waiting<f64>>,
}

/// A far child that waits for its turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Waiting<T> {
    node: u32,
    t_enter: T,
    t_exit: T,
}

/// Walks a ray, as `line` has it, through the leaves of a tree, front to back, between the two
/// distances of `interval`.
///
/// A ray that misses the root cell visits nothing.
#[inline]
pub(crate) fn traverse<L: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    interval: [f64; 2],
    line: &L,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    let Some((mut t_enter, mut t_exit)) = line.clip_to_root(interval) else {
        return;
    };
    let nodes = tree.nodes();
    let references = tree.references();
    let stack = L::T::stack(scratch);
    stack.clear();
    let mut at = 0u32;
    loop {
        let mut node = nodes[at as usize];
        while !node.is_leaf() {
            let (axis, plane, above) = node.as_inner();
            let crossing = line.crossing(axis, plane);
            let (near, far) = if line.is_backward(axis) {
                (above, at + 1)
            } else {
                (at + 1, above)
            };
            let t_far = t_enter.greatest(crossing.first);
            let children = if crossing.surely_before > t_exit {
                Children::Near
            } else if crossing.surely_behind < t_enter {
                Children::Far
            } else {
                Children::Both
            };
            let within = [t_enter.wide(), t_exit.wide()];
            probe.inner(at, within, crossing.t.wide(), t_far.wide(), children);
            at = match children {
                Children::Near => near,
                Children::Far => far,
                Children::Both => {
                    stack.push(Waiting {
                        node: far,
                        t_enter: t_far,
                        t_exit,
                    });
                    t_exit = t_exit.least(crossing.last);
                    near
                }
            };
            node = nodes[at as usize];
        }
        let (first, count) = node.as_leaf();
        let objects = &references[first..first + count];
        probe.leaf(at, objects, [t_enter.wide(), t_exit.wide()]);
        let limit = L::T::of(visitor.visit(objects, probe));
        loop {
            match stack.pop() {
                Some(next) if L::reaches(next.t_enter, limit) => {
                    (at, t_enter, t_exit) = (next.node, next.t_enter, next.t_exit);
                    break;
                }
                Some(_) if !L::PENDING_IN_ORDER => {}
                _ => return,
            }
        }
    }
}
