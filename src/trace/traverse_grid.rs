//! The traversal of uniform grids, from voxel to voxel.
//!
//! After J. Amanatides and A. Woo, A fast voxel traversal algorithm for ray tracing, 1987: for each axis
//! it is known where the ray enters the next slab of voxels, and the nearest of the three is entered next.
//! Where rounding leaves open which plane the ray crosses first, the ray is in the slabs on both sides of
//! a plane for a while. It then visits every voxel that these have in common with the slabs of the other
//! axes. So no voxel that holds a hit is missed, and none is visited twice.
//!
//! ```text
//! slabs = for each axis, the slabs that the ray may be in at the beginning
//! loop:
//!     visit the voxels common to the slabs, except those visited before; end at the limit
//!     now = the nearest distance where an axis enters its next slab; end if there is none
//!     leave the slabs that certainly lie behind, enter the next slab of that axis
//! ```

use super::stack::Real;
use super::traversal_ray::TraversalRay;
use super::{LeafVisitor, Probe};
use crate::structure::{Tree, Voxels};

/// The slabs along an axis that a ray may be in, counted in the order in which it crosses them.
struct Slabs<'a, R: TraversalRay> {
    ray: &'a R,
    axis: usize,
    planes: &'a [f32],
    first: usize,
    last: usize,
    /// Where the ray may enter the slab behind the last; infinite if not before its end.
    next: R::T,
}

impl<'a, R: TraversalRay> Slabs<'a, R> {
    /// Returns the slabs where the ray begins.
    #[inline(always)]
    fn new(ray: &'a R, axis: usize, planes: &'a [f32], t_enter: R::T, t_exit: R::T) -> Self {
        let mut slabs = Slabs {
            ray,
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
        // A ray may begin at a distance that is infinite in `f32`.
        while slabs.last < planes.len() && slabs.next <= t_enter {
            slabs.enter(t_enter, t_exit);
        }
        slabs
    }

    /// Estimates the number of planes that the ray crosses before `t`, as the planes are equidistant.
    #[inline(always)]
    fn guess(&self, t: R::T) -> usize {
        let Some(last) = self.planes.len().checked_sub(1) else {
            return 0;
        };
        let [from, to] =
            [0, last].map(|slab| self.ray.crossing(self.axis, self.plane(slab)).t.to_f64());
        let steps = (t.to_f64() - from) / (to - from) * last as f64;
        // NaN, for a ray parallel to the planes, becomes 0.
        (steps.ceil().max(0.0) as usize).min(last + 1)
    }

    /// Returns the plane behind a slab.
    #[inline(always)]
    fn plane(&self, slab: usize) -> f32 {
        if self.ray.is_backward(self.axis) {
            self.planes[self.planes.len() - 1 - slab]
        } else {
            self.planes[slab]
        }
    }

    /// Returns whether the ray at `t` is certainly behind the plane behind a slab.
    #[inline(always)]
    fn is_behind(&self, slab: usize, t: R::T) -> bool {
        self.ray.crossing(self.axis, self.plane(slab)).surely_behind < t
    }

    /// Computes where the ray enters the slab behind the last, not before `now`.
    #[inline(always)]
    fn look_ahead(&mut self, now: R::T, t_exit: R::T) {
        self.next = R::T::from_f64(f64::INFINITY);
        if self.last < self.planes.len() {
            let crossing = self.ray.crossing(self.axis, self.plane(self.last));
            // NaN, for a ray within the plane, enters the slab.
            let ends_before = crossing.surely_before > t_exit;
            if !ends_before {
                self.next = now.max(crossing.first);
            }
        }
    }

    /// Enters the slab behind the last.
    #[inline(always)]
    fn enter(&mut self, now: R::T, t_exit: R::T) {
        self.last += 1;
        self.look_ahead(now, t_exit);
    }

    /// Leaves the slabs that certainly lie behind the ray.
    #[inline(always)]
    fn leave(&mut self, now: R::T) {
        while self.first < self.last && self.is_behind(self.first, now) {
            self.first += 1;
        }
    }

    /// Returns the index of a slab in the grid.
    #[inline(always)]
    fn index(&self, slab: usize) -> usize {
        if self.ray.is_backward(self.axis) {
            self.planes.len() - slab
        } else {
            slab
        }
    }
}

/// Visits the voxels of a grid along `ray` within `interval`, front to back. Every voxel is a leaf, and no
/// inner node is traversed. A ray that misses the root cell visits none.
#[inline(never)]
pub(super) fn traverse_grid<R: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    voxels: &Voxels,
    interval: [f64; 2],
    ray: &R,
    visitor: &mut V,
    probe: &mut P,
) {
    let Some((t_enter, t_exit)) = ray.clip_to_root(interval) else {
        return;
    };
    let references = tree.references();
    let mut slabs =
        [0, 1, 2].map(|axis| Slabs::new(ray, axis, voxels.planes(axis), t_enter, t_exit));
    let mut now = t_enter;
    let mut limit = R::T::from_f64(f64::INFINITY);
    // For each axis, the first slab whose voxels were not visited yet.
    let mut from = slabs.each_ref().map(|s| s.first);
    loop {
        let [x, y, z] = &slabs;
        let mut axis = if y.next < x.next { 1 } else { 0 };
        if z.next < slabs[axis].next {
            axis = 2;
        }
        let next = slabs[axis].next;
        let within = [now.to_f64(), next.min(t_exit).to_f64()];
        for i in from[0]..=x.last {
            for j in from[1]..=y.last {
                for k in from[2]..=z.last {
                    if !R::reaches(now, limit) {
                        return;
                    }
                    let voxel = voxels.at([x.index(i), y.index(j), z.index(k)]);
                    let (first, count) = voxel.leaf.as_leaf();
                    let objects = &references[first..first + count];
                    probe.leaf(voxel.node, objects, within);
                    let at_most = visitor.visit(objects, probe);
                    probe.limit(at_most);
                    limit = R::T::from_f64(at_most);
                }
            }
        }
        if next.to_f64() == f64::INFINITY {
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
