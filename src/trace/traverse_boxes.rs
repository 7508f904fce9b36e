//! The traversal of bounding volume hierarchies.
//!
//! ```text
//! node = root, if the ray meets its box
//! loop:
//!     while node is an inner node:
//!         test the box of every child; drop those that are missed or begin beyond the limit
//!         push the others, farthest first; node = the nearest, or pop if there is none
//!     visit the leaf; the visitor returns the limit beyond which nothing matters
//!     pop the next node that begins before the limit, or end
//! ```
//!
//! Boxes overlap, so the first hit need not be the closest: traversal resumes as long as a pending node begins
//! before it. Of children that begin at the same distance, the one of the lower index is visited first, so the
//! order is the same everywhere.
//!
//! Boxes are conservative. In the tree they are wider than rounding ([`crate::structure::Frame::slack`]), and
//! [`TraversalRay::clip`] widens each interval by more than the rounding of its ends. After Ize, "Robust BVH ray
//! traversal" (JCGT 2(2), 2013).

use super::probe::{BoxTest, Fate};
use super::stack::{Real, Scratch, StackEntry};
use super::traversal_ray::TraversalRay;
use super::{LeafVisitor, Probe};
use crate::structure::{BoxNode, MAX_WIDTH, Tree};

/// Visits the leaves of a hierarchy along `ray` within `interval`, nearest box first. A ray that misses the
/// root visits none.
#[inline(never)]
pub(super) fn traverse_boxes<R: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    nodes: &[BoxNode],
    interval: [f64; 2],
    ray: &R,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    let interval = R::widened(interval);
    let Some((mut t_enter, mut t_exit)) = ray.clip(interval, &nodes[0].lo, &nodes[0].hi) else {
        return;
    };
    let references = tree.references();
    let stack = R::T::stack(scratch);
    stack.clear();
    let mut limit = R::T::from_f64(f64::INFINITY);
    let mut at = 0_u32;
    loop {
        let node = &nodes[at as usize];
        if node.is_leaf() {
            let (first, count) = node.as_leaf();
            let objects = &references[first..first + count];
            probe.leaf(at, objects, [t_enter.to_f64(), t_exit.to_f64()]);
            let at_most = visitor.visit(objects, probe);
            probe.limit(at_most);
            if at_most == f64::NEG_INFINITY {
                return;
            }
            limit = R::T::from_f64(at_most);
        } else {
            let mut tests = [BoxTest::NONE; MAX_WIDTH];
            let pushed = stack.len();
            let mut child = at + 1;
            for test in &mut tests[..node.child_count()] {
                let bounds = &nodes[child as usize];
                let mut fate = Fate::Missed;
                if let Some((t_enter, t_exit)) = ray.clip(interval, &bounds.lo, &bounds.hi) {
                    fate = Fate::BeyondHit;
                    if R::reaches(t_enter, limit) {
                        fate = Fate::Entered;
                        let node = child;
                        insert(
                            stack,
                            pushed,
                            StackEntry {
                                node,
                                t_enter,
                                t_exit,
                            },
                        );
                    }
                    test.within = [t_enter.to_f64(), t_exit.to_f64()];
                }
                test.node = child;
                test.fate = fate;
                child = bounds.end(child);
            }
            let tests = &tests[..node.child_count()];
            probe.boxes(at, [t_enter.to_f64(), t_exit.to_f64()], tests);
        }
        loop {
            let Some(next) = stack.pop() else {
                return;
            };
            if R::reaches(next.t_enter, limit) {
                (at, t_enter, t_exit) = (next.node, next.t_enter, next.t_exit);
                break;
            }
            probe.culled(next.node, next.t_enter.to_f64(), limit.to_f64());
        }
    }
}

/// Inserts a node into the entries from index `from` on, of which the nearest is last; behind those that begin
/// at the same distance.
#[inline(always)]
fn insert<T: Real>(stack: &mut Vec<StackEntry<T>>, from: usize, entry: StackEntry<T>) {
    stack.push(entry);
    let mut i = stack.len() - 1;
    while i > from && stack[i - 1].t_enter <= entry.t_enter {
        stack[i] = stack[i - 1];
        i -= 1;
    }
    stack[i] = entry;
}
