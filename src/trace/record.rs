//! The whole path of one ray: the leaves it visits, in order, and what it hits.

use super::{Hit, Probe, Scratch, Shapes, closest_hit};
use crate::geometry::{Aabb, Ray};
use crate::scene::Scene;
use crate::tree::{CellOfNode, NodeKind, StopReason, Tree};

/// A leaf that a ray visited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisitedLeaf {
    /// Index of the node.
    pub node: u32,
    pub depth: u32,
    pub bounds: Aabb,
    /// Number of objects that the leaf refers to; 0 is an empty leaf.
    pub objects: u32,
    /// Why the cell became a leaf.
    pub stop: StopReason,
    /// Where on the ray the cell lies between, widened by rounding.
    pub t_enter: f64,
    pub t_exit: f64,
    /// Objects tested in it.
    pub tests: u32,
}

/// What a ray did on its way to its nearest hit.
#[derive(Clone, Debug, PartialEq)]
pub struct RayPath {
    pub ray: Ray,
    /// In the order of the visits; empty where the ray misses the root cell.
    pub leaves: Vec<VisitedLeaf>,
    /// Inner nodes traversed.
    pub inner_nodes: u32,
    pub hit: Hit,
}

#[derive(Default)]
struct Recorder {
    leaves: Vec<(u32, f64, f64, u32)>,
    inner_nodes: u32,
}

impl Probe for Recorder {
    fn inner(&mut self, _: u32) {
        self.inner_nodes += 1;
    }

    fn leaf(&mut self, node: u32, _: &[u32], t_enter: f64, t_exit: f64) {
        self.leaves.push((node, t_enter, t_exit, 0));
    }

    fn test(&mut self, _: u32, _: Option<f64>) {
        if let Some((.., tests)) = self.leaves.last_mut() {
            *tests += 1;
        }
    }
}

/// Traces one ray to its nearest hit and keeps everything it did.
pub fn record(scene: &Scene, tree: &Tree, ray: &Ray) -> RayPath {
    let mut recorder = Recorder::default();
    // No array of one kind is made for a single ray: that would cost more than the ray.
    let shapes = Shapes::Mixed(scene.objects());
    let hit = closest_hit(tree, &shapes, ray, &mut Scratch::default(), &mut recorder);
    let leaves = recorder.leaves.into_iter();
    RayPath {
        ray: *ray,
        leaves: leaves
            .filter_map(|(node, t_enter, t_exit, tests)| {
                let cell = cell_of(tree, node);
                let NodeKind::Leaf { count, stop, .. } = tree.kind(node) else {
                    return None;
                };
                Some(VisitedLeaf {
                    node,
                    depth: cell.depth,
                    bounds: cell.bounds,
                    objects: count,
                    stop,
                    t_enter,
                    t_exit,
                    tests,
                })
            })
            .collect(),
        inner_nodes: recorder.inner_nodes,
        hit,
    }
}

/// The cell of a node, found from the root down: subtrees are contiguous in the array.
fn cell_of(tree: &Tree, node: u32) -> CellOfNode {
    let mut cell = CellOfNode {
        node: 0,
        depth: 0,
        bounds: tree.root_cell(),
    };
    while cell.node != node {
        let Some([below, above]) = tree.children(&cell) else {
            break;
        };
        cell = if node < above.node { below } else { above };
    }
    cell
}
