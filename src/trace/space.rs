//! The numbers a ray is traced in: those of the world, or those of an `f32` near the scene.

use super::line::{TraversalRay, TraversalRayF32, TraversalRayF64};
use super::through_voxels::through_voxels;
use super::traverse::traverse;
use super::{Children, LeafVisitor, Probe, Scratch};
use crate::geometry::Ray;
use crate::primitive::{PackedRay, UnitFrame};
use crate::structure::Tree;

/// Where rays are traced.
pub(super) trait Space {
    type Inside: Inside;

    /// A ray of the world in here; `None` where it cannot hit anything.
    fn enter(&self, ray: &Ray) -> Option<Self::Inside>;
}

/// A ray of the world where it is traced; objects are tested with it.
pub(super) trait Inside {
    /// The interval of it that counts.
    fn interval(&self) -> [f64; 2];

    /// A distance in here as one on the ray of the world.
    fn to_world(&self, t: f64) -> f64;

    /// [`traverse`] or [`through_voxels`] with this ray; the visitor's distances are those in here, the probe's those of
    /// the world.
    fn walk<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    );
}

/// Walks as the tree's structure has it.
#[inline(always)]
fn walk_line<L: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    interval: [f64; 2],
    line: &L,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    match tree.voxels() {
        None => traverse(tree, interval, line, scratch, visitor, probe),
        Some(voxels) => through_voxels(tree, voxels, interval, line, visitor, probe),
    }
}

/// The world itself, in `f64`.
pub(super) struct World;

impl Space for World {
    type Inside = Ray;

    #[inline(always)]
    fn enter(&self, ray: &Ray) -> Option<Ray> {
        Some(*ray)
    }
}

impl Inside for Ray {
    #[inline(always)]
    fn interval(&self) -> [f64; 2] {
        [self.t_min, self.t_max]
    }

    #[inline(always)]
    fn to_world(&self, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn walk<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    ) {
        let line = TraversalRayF64::new(tree, self);
        walk_line(tree, self.interval(), &line, scratch, visitor, probe);
    }
}

impl Space for UnitFrame {
    type Inside = PackedRay;

    #[inline(always)]
    fn enter(&self, ray: &Ray) -> Option<PackedRay> {
        PackedRay::new(self, ray)
    }
}

impl Inside for PackedRay {
    #[inline(always)]
    fn interval(&self) -> [f64; 2] {
        [self.widened.t_min, self.widened.t_max]
    }

    #[inline(always)]
    fn to_world(&self, t: f64) -> f64 {
        PackedRay::to_world(self, t)
    }

    #[inline(always)]
    fn walk<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    ) {
        let line = TraversalRayF32::new(tree, &self.frame, &self.widened);
        let mut probe = InWorld { ray: self, probe };
        walk_line(tree, self.interval(), &line, scratch, visitor, &mut probe);
    }
}

/// Tells a probe of what is done in here, with the distances of the world.
struct InWorld<'a, P> {
    ray: &'a PackedRay,
    probe: &'a mut P,
}

impl<P: Probe> Probe for InWorld<'_, P> {
    #[inline(always)]
    fn inner(
        &mut self,
        node: u32,
        [t_enter, t_exit]: [f64; 2],
        t: f64,
        t_far: f64,
        children: Children,
    ) {
        let [t_enter, t_exit, t, t_far] = [t_enter, t_exit, t, t_far].map(|t| self.ray.to_world(t));
        self.probe
            .inner(node, [t_enter, t_exit], t, t_far, children);
    }

    #[inline(always)]
    fn leaf(&mut self, node: u32, objects: &[u32], within: [f64; 2]) {
        let within = within.map(|t| self.ray.to_world(t));
        self.probe.leaf(node, objects, within);
    }

    #[inline(always)]
    fn test(&mut self, object: u32, hit: Option<f64>) {
        self.probe.test(object, hit.map(|t| self.ray.to_world(t)));
    }
}
