//! One traversal for everything: closest hit, any hit, timing without tests, recording.
//!
//! The order of visits is that of K. Sung and P. Shirley (Graphics Gems III, 1992): front to back
//! with a stack. Decisions are conservative: the distance to a plane carries a few roundings, so an
//! interval is widened by more than that whenever a plane bounds it, and a comparison that NaN
//! could reach is written so that NaN visits both children. Objects within rounding of a plane are
//! in the leaves of both sides ([`crate::tree::Frame::slack`]).

use super::{Probe, Way};
use crate::geometry::Ray;
use crate::tree::Tree;

/// What is done in the leaves a ray visits.
pub trait LeafVisitor {
    /// Visits a leaf and says beyond which `t` nothing matters any more; −∞ ends the walk.
    fn visit<P: Probe>(&mut self, ray: &Ray, objects: &[u32], probe: &mut P) -> f64;
}

/// Memory that traversals reuse from ray to ray.
#[derive(Debug, Default)]
pub struct Scratch {
    stack: Vec<Waiting>,
}

/// A far child that waits for its turn.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    node: u32,
    t_enter: f64,
    t_exit: f64,
}

/// Relative bound on the rounding of a distance to a plane, with room to spare: the subtraction,
/// the division and both conversions into the coordinates of the root cell round once each.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Relative rounding that a hit may carry: grazing roots are known far less well than planes. A hit
/// this near to the next leaf does not end the walk, for what that leaf holds may be nearer still.
const HIT_ROUNDING: f64 = 1e-10;

/// The decisions that rounding, infinities and NaN could get wrong. As they stand they are
/// conservative; tests break one at a time to see that it is noticed.
pub trait Decisions {
    /// A parameter moved on by more than it was rounded.
    #[inline(always)]
    fn later(t: f64) -> f64 {
        t + t.abs() * ROUNDING
    }

    /// A parameter moved back by more than it was rounded.
    #[inline(always)]
    fn earlier(t: f64) -> f64 {
        t - t.abs() * ROUNDING
    }

    /// Whether the ray certainly leaves the cell before it meets the plane at `t`.
    #[inline(always)]
    fn is_near_only(t: f64, t_exit: f64) -> bool {
        t > t_exit
    }

    /// Whether the ray certainly enters the cell behind the plane that it meets at `t`.
    #[inline(always)]
    fn is_far_only(t: f64, t_enter: f64) -> bool {
        t < t_enter
    }

    /// Whether a child entered at `t_enter` may hold something before `limit`. A limit of −∞ gives
    /// NaN, which ends the walk.
    #[inline(always)]
    fn goes_on(t_enter: f64, limit: f64) -> bool {
        t_enter <= limit + limit.abs() * HIT_ROUNDING
    }

    /// Whether the child above a plane is the nearer one.
    #[inline(always)]
    fn comes_from_above(direction: f64) -> bool {
        direction.is_sign_negative()
    }
}

/// The decisions as they are.
pub struct Conservative;

impl Decisions for Conservative {}

pub(super) fn earlier(t: f64) -> f64 {
    Conservative::earlier(t)
}

/// Walks a ray through the leaves of a tree, front to back, between `ray.t_min` and `ray.t_max`.
///
/// A ray that misses the root cell visits nothing.
#[inline]
pub fn traverse<V: LeafVisitor, P: Probe>(
    tree: &Tree,
    ray: &Ray,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    traverse_by::<Conservative, V, P>(tree, ray, scratch, visitor, probe);
}

/// As [`traverse`], by these decisions.
#[inline(always)]
pub fn traverse_by<D: Decisions, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    ray: &Ray,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    let origin = tree.frame().point_to_local(ray.origin).to_array();
    let direction = tree.frame().direction_to_local(ray.direction).to_array();
    let inverse = direction.map(|d| 1.0 / d);
    let (mut t_enter, mut t_exit) = (ray.t_min, ray.t_max);
    for k in 0..3 {
        const SIDE: f64 = 1.0 + ROUNDING;
        if inverse[k].is_finite() {
            let (a, b) = (
                (-SIDE - origin[k]) * inverse[k],
                (SIDE - origin[k]) * inverse[k],
            );
            t_enter = t_enter.max(D::earlier(a.min(b)));
            t_exit = t_exit.min(D::later(a.max(b)));
        } else if origin[k].abs() > SIDE {
            return;
        }
    }
    if t_enter > t_exit {
        return;
    }
    let nodes = tree.nodes();
    let references = tree.references();
    let stack = &mut scratch.stack;
    stack.clear();
    let mut at = 0u32;
    loop {
        let mut node = nodes[at as usize];
        while !node.is_leaf() {
            let (axis, plane, above) = node.as_inner();
            let t = (f64::from(plane) - origin[axis]) * inverse[axis];
            let (near, far) = if D::comes_from_above(direction[axis]) {
                (above, at + 1)
            } else {
                (at + 1, above)
            };
            if D::is_near_only(t, t_exit) {
                probe.inner(at, t_enter, t_exit, t, Way::Near);
                at = near;
            } else if D::is_far_only(t, t_enter) {
                probe.inner(at, t_enter, t_exit, t, Way::Far);
                at = far;
            } else {
                probe.inner(at, t_enter, t_exit, t, Way::Both);
                stack.push(Waiting {
                    node: far,
                    t_enter: t_enter.max(D::earlier(t)),
                    t_exit,
                });
                t_exit = t_exit.min(D::later(t));
                at = near;
            }
            node = nodes[at as usize];
        }
        let (first, count) = node.as_leaf();
        let objects = &references[first..first + count];
        probe.leaf(at, objects, t_enter, t_exit);
        let limit = visitor.visit(ray, objects, probe);
        match stack.pop() {
            // What waits below lies farther still.
            Some(next) if D::goes_on(next.t_enter, limit) => {
                (at, t_enter, t_exit) = (next.node, next.t_enter, next.t_exit);
            }
            _ => return,
        }
    }
}
