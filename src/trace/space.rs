//! The coordinates that rays are traced in: those of the world in `f64`, or those of the unit frame in
//! `f32`.

use super::probe::BoxTest;
use super::traversal_ray::{TraversalRay, TraversalRayF32, TraversalRayF64};
use super::traverse::traverse;
use super::traverse_boxes::traverse_boxes;
use super::traverse_grid::traverse_grid;
use super::{Children, LeafVisitor, Probe, Scratch};
use crate::geometry::Ray;
use crate::primitive::{PackedRay, UnitFrame};
use crate::structure::{MAX_WIDTH, Nodes, Tree};

/// Coordinates that rays are traced in.
pub(super) trait Space {
    type Ray: SpaceRay;

    /// Transforms a ray of the world; `None` where it cannot hit anything.
    fn transform(&self, ray: &Ray) -> Option<Self::Ray>;
}

/// A ray in the coordinates of a [`Space`]. Objects are tested with it.
pub(super) trait SpaceRay {
    /// Returns the ray's interval.
    fn interval(&self) -> [f64; 2];

    /// Converts a distance along this ray to one along the ray in the world.
    fn to_world(&self, t: f64) -> f64;

    /// Calls [`traverse`], [`traverse_boxes`] or [`traverse_grid`] with this ray. Distances of the visitor are along this ray,
    /// those of the probe are along the ray in the world.
    fn traverse<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    );
}

/// Calls the traversal for the kind of structure.
#[inline(always)]
fn traverse_structure<R: TraversalRay, V: LeafVisitor, P: Probe>(
    tree: &Tree,
    interval: [f64; 2],
    ray: &R,
    scratch: &mut Scratch,
    visitor: &mut V,
    probe: &mut P,
) {
    match (tree.nodes(), tree.voxels()) {
        (Nodes::Boxes(nodes), _) => {
            traverse_boxes(tree, nodes, interval, ray, scratch, visitor, probe);
        }
        (Nodes::Planes(nodes), None) => {
            traverse(tree, nodes, interval, ray, scratch, visitor, probe);
        }
        (_, Some(voxels)) => traverse_grid(tree, voxels, interval, ray, visitor, probe),
    }
}

/// Evaluates `$body` with `$objects` bound to the array of objects and `$space` to their coordinates,
/// monomorphized for each kind and precision.
macro_rules! with_shapes {
    ($shapes:expr, $space:ident, $objects:ident => $body:expr) => {
        match $shapes {
            $crate::primitive::Shapes::F64(arrays) => {
                let $space = &$crate::trace::space::World;
                $crate::primitive::with_array!(arrays, $objects => $body)
            }
            $crate::primitive::Shapes::F32 { frame, arrays, .. } => {
                let $space = frame;
                $crate::primitive::with_array!(arrays, $objects => $body)
            }
        }
    };
}
pub(super) use with_shapes;

/// The coordinates of the world, in `f64`.
pub(super) struct World;

impl Space for World {
    type Ray = Ray;

    #[inline(always)]
    fn transform(&self, ray: &Ray) -> Option<Ray> {
        Some(*ray)
    }
}

impl SpaceRay for Ray {
    #[inline(always)]
    fn interval(&self) -> [f64; 2] {
        [self.t_min, self.t_max]
    }

    #[inline(always)]
    fn to_world(&self, t: f64) -> f64 {
        t
    }

    #[inline(always)]
    fn traverse<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    ) {
        let ray = TraversalRayF64::new(tree, self);
        traverse_structure(tree, self.interval(), &ray, scratch, visitor, probe);
    }
}

impl Space for UnitFrame {
    type Ray = PackedRay;

    #[inline(always)]
    fn transform(&self, ray: &Ray) -> Option<PackedRay> {
        PackedRay::new(self, ray)
    }
}

impl SpaceRay for PackedRay {
    #[inline(always)]
    fn interval(&self) -> [f64; 2] {
        [self.as_f64.t_min, self.as_f64.t_max]
    }

    #[inline(always)]
    fn to_world(&self, t: f64) -> f64 {
        PackedRay::to_world(self, t)
    }

    #[inline(always)]
    fn traverse<V: LeafVisitor, P: Probe>(
        &self,
        tree: &Tree,
        scratch: &mut Scratch,
        visitor: &mut V,
        probe: &mut P,
    ) {
        let ray = TraversalRayF32::new(tree, &self.frame, &self.as_f64);
        let mut probe = WorldProbe { ray: self, probe };
        traverse_structure(tree, self.interval(), &ray, scratch, visitor, &mut probe);
    }
}

/// Forwards events to a probe with distances converted to those in the world.
struct WorldProbe<'a, P> {
    ray: &'a PackedRay,
    probe: &'a mut P,
}

impl<P: Probe> Probe for WorldProbe<'_, P> {
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
    fn boxes(&mut self, node: u32, within: [f64; 2], tests: &[BoxTest]) {
        let to_world = |within: [f64; 2]| within.map(|t| self.ray.to_world(t));
        let mut in_world = [BoxTest::NONE; MAX_WIDTH];
        for (to, from) in in_world.iter_mut().zip(tests) {
            *to = BoxTest {
                within: to_world(from.within),
                ..*from
            };
        }
        self.probe
            .boxes(node, to_world(within), &in_world[..tests.len()]);
    }

    #[inline(always)]
    fn culled(&mut self, node: u32, t_enter: f64, limit: f64) {
        let [t_enter, limit] = [t_enter, limit].map(|t| self.ray.to_world(t));
        self.probe.culled(node, t_enter, limit);
    }

    #[inline(always)]
    fn limit(&mut self, limit: f64) {
        self.probe.limit(limit);
    }

    #[inline(always)]
    fn leaf(&mut self, node: u32, objects: &[u32], within: [f64; 2]) {
        let within = within.map(|t| self.ray.to_world(t));
        self.probe.leaf(node, objects, within);
    }

    #[inline(always)]
    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>) {
        self.probe
            .test(object, || hit().map(|t| self.ray.to_world(t)));
    }
}
