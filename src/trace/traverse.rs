//! The traversal of trees with planes, for all purposes: closest hit, any hit, timing without tests, recording.
//!
//! The order of visits is that of K. Sung and P. Shirley (Graphics Gems III, 1992): front to back
//! with a stack.
//!
//! ```text
//! node = root, interval = ray within the root cell
//! loop:
//!     while node is an inner node:
//!         ends before the plane:   node = near child
//!         begins behind the plane: node = far child
//!         else: push far child with the interval behind the plane
//!               node = near child, interval ends at the plane
//!     visit the leaf; the visitor returns the limit beyond which nothing matters
//!     pop the next node that begins before the limit, or end
//! ```
//!
//! Decisions are conservative. The distance to a plane is rounded a few times, so intervals are widened by
//! more than that wherever a plane bounds them. Comparisons are written so that NaN visits both children.
//! Objects within rounding of a plane are in the leaves on both sides
//! ([`crate::structure::Frame::slack`]). The two [`TraversalRay`]s, one per precision, know by how much to
//! widen.

use super::stack::{Real, Scratch, StackEntry};
use super::traversal_ray::TraversalRay;
use super::{Children, Probe};
use crate::structure::{Node, Tree};

/// Visits the leaves of a traversal.
pub trait LeafVisitor {
    /// Visits a leaf and returns the distance beyond which nothing matters; −∞ ends the traversal.
    fn visit<P: Probe>(&mut self, objects: &[u32], probe: &mut P) -> f64;
}

/// Visits the leaves of a tree with these nodes along `ray` within `interval`, front to back. A ray that misses the root
/// cell visits none.
#[inline]
pub(crate) fn traverse<R: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    nodes: &[Node],
    interval: [f64; 2],
    ray: &R,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    let Some((mut t_enter, mut t_exit)) = ray.clip_to_root(interval) else {
        return;
    };
    let references = tree.references();
    let stack = R::T::stack(scratch);
    stack.clear();
    let mut at = 0u32;
    loop {
        let mut node = nodes[at as usize];
        while !node.is_leaf() {
            let (axis, plane, above) = node.as_inner();
            let crossing = ray.crossing(axis, plane);
            let (near, far) = if ray.is_backward(axis) {
                (above, at + 1)
            } else {
                (at + 1, above)
            };
            let t_far = t_enter.max(crossing.first);
            let children = if crossing.surely_before > t_exit {
                Children::Near
            } else if crossing.surely_behind < t_enter {
                Children::Far
            } else {
                Children::Both
            };
            let within = [t_enter.to_f64(), t_exit.to_f64()];
            probe.inner(at, within, crossing.t.to_f64(), t_far.to_f64(), children);
            at = match children {
                Children::Near => near,
                Children::Far => far,
                Children::Both => {
                    stack.push(StackEntry {
                        node: far,
                        t_enter: t_far,
                        t_exit,
                    });
                    t_exit = t_exit.min(crossing.last);
                    near
                }
            };
            node = nodes[at as usize];
        }
        let (first, count) = node.as_leaf();
        let objects = &references[first..first + count];
        probe.leaf(at, objects, [t_enter.to_f64(), t_exit.to_f64()]);
        let limit = visitor.visit(objects, probe);
        probe.limit(limit);
        let limit = R::T::from_f64(limit);
        loop {
            match stack.pop() {
                Some(next) if R::reaches(next.t_enter, limit) => {
                    (at, t_enter, t_exit) = (next.node, next.t_enter, next.t_exit);
                    break;
                }
                Some(_) if !R::PENDING_IN_ORDER => {}
                _ => return,
            }
        }
    }
}
