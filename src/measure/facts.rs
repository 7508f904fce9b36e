//! Properties of a scene and of a tree that are known without tracing rays.

use super::overlap::{end_point_overlap, leaf_union};
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::{NodeKind, Nodes, Tree};

/// Properties of a scene (class S).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SceneFacts {
    pub objects: u64,
    pub lights: u64,
    /// Volume of the bounding box of all objects.
    pub volume: f64,
    /// Sum of the volumes of the objects' bounding boxes.
    pub object_boxes_volume: f64,
}

impl SceneFacts {
    pub fn of(scene: &Scene) -> Self {
        SceneFacts {
            objects: scene.objects().len() as u64,
            lights: scene.lights().len() as u64,
            volume: scene.bounds().volume(),
            object_boxes_volume: scene.objects().iter().map(|o| o.bounds().volume()).sum(),
        }
    }
}

/// Properties of a tree (class C).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeFacts {
    pub depth_reached: u64,
    pub inner_nodes: u64,
    /// Children of all inner nodes.
    pub children: u64,
    pub leaves: u64,
    pub empty_leaves: u64,
    pub references: u64,
    /// References of the leaf with the most.
    pub largest_leaf: u64,
    /// Sum of the depths of all leaves.
    pub leaf_depths: u64,
    /// Volume of the root cell, which is the scene's bounding box plus the root margin.
    pub root_volume: f64,
    /// Sum of the volumes of all leaves.
    pub leaf_volume: f64,
    /// Volume of the root cell outside all leaves with objects. `None` for a hierarchy before
    /// [`TreeFacts::find_overlaps`].
    pub empty_volume: Option<f64>,
    /// Standard error of `empty_volume`; 0 if it is exact.
    pub empty_volume_error: f64,
    /// Surface area of the root.
    pub root_area: f64,
    /// Sum of the surface areas of the inner nodes.
    pub inner_area: f64,
    /// Sum of the surface areas of the leaves, each multiplied by its number of references.
    pub test_area: f64,
    /// Sum of the volumes that two children of the same node have in common.
    pub sibling_overlap: f64,
    /// `EPO`. `None` without a surface, for a hierarchy before [`TreeFacts::find_overlaps`], and for a
    /// hierarchy in which it would take too long.
    pub end_point_overlap: Option<f64>,
    pub bytes: u64,
    /// Bytes of a node; of a grid, of a voxel.
    pub node_bytes: u64,
}

impl TreeFacts {
    /// Returns what takes little time compared with building the tree.
    pub fn of(tree: &Tree) -> Self {
        let cells_overlap = matches!(tree.nodes(), Nodes::Boxes(_));
        let root = tree.root().bounds;
        let mut facts = TreeFacts {
            depth_reached: u64::from(tree.depth_reached()),
            references: tree.references().len() as u64,
            root_volume: tree.root_cell().volume(),
            root_area: root.surface_area(),
            bytes: tree.bytes() as u64,
            node_bytes: tree.node_bytes() as u64,
            ..TreeFacts::default()
        };
        let mut empty_volume = 0.0;
        let mut children: Vec<Aabb> = Vec::new();
        for cell in tree.cells() {
            match tree.kind(cell.node) {
                NodeKind::Inner => {
                    facts.inner_nodes += 1;
                    facts.inner_area += cell.bounds.surface_area();
                    if cells_overlap {
                        children.clear();
                        children.extend(tree.children(&cell).map(|child| child.bounds));
                        for (i, a) in children.iter().enumerate() {
                            let rest = children[i + 1..].iter();
                            let common = rest.map(|b| a.intersection(b).volume());
                            facts.sibling_overlap += common.sum::<f64>();
                        }
                    }
                }
                NodeKind::Leaf { count, .. } => {
                    facts.leaves += 1;
                    facts.leaf_depths += u64::from(cell.depth);
                    facts.largest_leaf = facts.largest_leaf.max(u64::from(count));
                    facts.test_area += f64::from(count) * cell.bounds.surface_area();
                    let volume = cell.bounds.volume();
                    facts.leaf_volume += volume;
                    if count == 0 {
                        facts.empty_leaves += 1;
                        empty_volume += volume;
                    }
                }
            }
        }
        // Every node but the root is a child.
        facts.children = facts.inner_nodes + facts.leaves - 1;
        if !cells_overlap {
            facts.empty_volume = Some(empty_volume);
            facts.end_point_overlap = (facts.references > 0).then_some(0.0);
        }
        facts
    }

    /// Finds how far the nodes of a hierarchy overlap, on the threads of the current `rayon` pool: V_EMPTY and
    /// EPO. That may take as long as building it.
    ///
    /// # Errors
    /// Cancellation.
    pub fn find_overlaps(
        &mut self,
        scene: &Scene,
        tree: &Tree,
        progress: &Progress,
    ) -> Result<(), Cancelled> {
        if matches!(tree.nodes(), Nodes::Planes(_)) || self.empty_volume.is_some() {
            return Ok(());
        }
        let boxes: Vec<Aabb> = tree.cells().map(|cell| cell.bounds).collect();
        let union = leaf_union(tree, &boxes, progress)?;
        self.end_point_overlap = end_point_overlap(scene, tree, &boxes, progress)?;
        self.empty_volume = Some((self.root_volume - union.volume).max(0.0));
        self.empty_volume_error = union.error;
        Ok(())
    }
}
