//! The walk of a ray through a uniform grid, from voxel to voxel.
//!
//! As J. Amanatides and A. Woo have it (A fast voxel traversal algorithm for ray tracing, 1987): along
//! every axis it is known where the ray enters the next slab of voxels, and the nearest of the three
//! comes next. Where rounding leaves open which plane the ray crosses first, it is in both slabs beside
//! a plane for a while, and visits every voxel that they have in common with the slabs of the other
//! axes. So no voxel that holds a hit is passed by, and none is visited twice.

use super::line::{Real, TraversalRay};
use super::{LeafVisitor, Probe};
use crate::structure::{Tree, Voxels};

/// The slabs along an axis that a ray may be in, counted in the order in which it meets them.
struct Slabs<'a, L: TraversalRay> {
    line: &'a L,
    axis: usize,
    planes: &'a [f32],
    first: usize,
    last: usize,
    /// Where the ray may enter the slab behind the last; infinite if nowhere before its end.
    next: L::T,
}

impl<'a, L: TraversalRay> Slabs<'a, L> {
    /// The slabs where the ray begins.
    #[inline(always)]
    fn new(line: &'a L, axis: usize, planes: &'a [f32], t_enter: L::T, t_exit: L::T) -> Self {
        let mut slabs = Slabs {
            line,
            axis,
            planes,
            first: 0,
            last: 0,
            next: t_enter,
        };
        let mut first = slabs.guess(t_enter);
        while first < planes.len() && slabs.is_behind(first, t_enter) {
            first += 1;
        }
        while first > 0 && !slabs.is_behind(first - 1, t_enter) {
            first -= 1;
        }
        (slabs.first, slabs.last) = (first, first);
        slabs.look_ahead(t_enter, t_exit);
        // A ray may begin where `f32` knows only infinity.
        while slabs.last < planes.len() && slabs.next <= t_enter {
            slabs.enter(t_enter, t_exit);
        }
        slabs
    }

    /// About how many planes the ray meets before `t`, for it meets them at equal steps.
    #[inline(always)]
    fn guess(&self, t: L::T) -> usize {
        let Some(last) = self.planes.len().checked_sub(1) else {
            return 0;
        };
        let [from, to] =
            [0, last].map(|slab| self.line.crossing(self.axis, self.plane(slab)).t.wide());
        let steps = (t.wide() - from) / (to - from) * last as f64;
        // NaN, of a ray along the planes, becomes 0.
        (steps.ceil().max(0.0) as usize).min(last + 1)
    }

    /// The plane behind a slab.
    #[inline(always)]
    fn plane(&self, slab: usize) -> f32 {
        if self.line.is_backward(self.axis) {
            self.planes[self.planes.len() - 1 - slab]
        } else {
            self.planes[slab]
        }
    }

    /// Whether the ray at `t` is certainly behind the plane behind a slab.
    #[inline(always)]
    fn is_behind(&self, slab: usize, t: L::T) -> bool {
        self.line
            .crossing(self.axis, self.plane(slab))
            .surely_behind
            < t
    }

    /// Finds where the slab behind the last is entered, not before `now`.
    #[inline(always)]
    fn look_ahead(&mut self, now: L::T, t_exit: L::T) {
        self.next = L::T::of(f64::INFINITY);
        if self.last < self.planes.len() {
            let crossing = self.line.crossing(self.axis, self.plane(self.last));
            // Written so that NaN, of a ray within the plane, enters.
            let ends_before = crossing.surely_before > t_exit;
            if !ends_before {
                self.next = now.greatest(crossing.first);
            }
        }
    }

    /// Enters the slab behind the last.
    #[inline(always)]
    fn enter(&mut self, now: L::T, t_exit: L::T) {
        self.last += 1;
        self.look_ahead(now, t_exit);
    }

    /// Leaves the slabs that the ray is certainly behind of.
    #[inline(always)]
    fn leave(&mut self, now: L::T) {
        while self.first < self.last && self.is_behind(self.first, now) {
            self.first += 1;
        }
    }

    /// The place of a slab in the grid.
    #[inline(always)]
    fn place(&self, slab: usize) -> usize {
        if self.line.is_backward(self.axis) {
            self.planes.len() - slab
        } else {
            slab
        }
    }
}

/// Walks a ray, as `line` has it, through the voxels of a grid, front to back, between the two
/// distances of `interval`; every voxel is a leaf, and no inner node is traversed.
///
/// A ray that misses the root cell visits nothing.
#[inline(never)]
pub(super) fn through_voxels<L: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    voxels: &Voxels,
    interval: [f64; 2],
    line: &L,
    visitor: &mut V,
    probe: &mut P,
) {
    let Some((t_enter, t_exit)) = line.clip_to_root(interval) else {
        return;
    };
    let references = tree.references();
    let mut slabs =
        [0, 1, 2].map(|axis| Slabs::new(line, axis, voxels.planes(axis), t_enter, t_exit));
    let mut now = t_enter;
    let mut limit = L::T::of(f64::INFINITY);
    // Of every axis the slabs whose voxels are to be visited.
    let mut from = slabs.each_ref().map(|s| s.first);
    loop {
        let [x, y, z] = &slabs;
        let mut axis = if y.next < x.next { 1 } else { 0 };
        if z.next < slabs[axis].next {
            axis = 2;
        }
        let next = slabs[axis].next;
        let within = [now.wide(), next.least(t_exit).wide()];
        for i in from[0]..=x.last {
            for j in from[1]..=y.last {
                for k in from[2]..=z.last {
                    if !L::reaches(now, limit) {
                        return;
                    }
                    let voxel = voxels.at([x.place(i), y.place(j), z.place(k)]);
                    let (first, count) = voxel.leaf.as_leaf();
                    let objects = &references[first..first + count];
                    probe.leaf(voxel.node, objects, within);
                    limit = L::T::of(visitor.visit(objects, probe));
                }
            }
        }
        if next.wide() == f64::INFINITY {
            return;
        }
        now = next;
        for along in &mut slabs {
            along.leave(now);
        }
        slabs[axis].enter(now, t_exit);
        from = slabs.each_ref().map(|s| s.first);
        from[axis] = slabs[axis].last;
    }
}
