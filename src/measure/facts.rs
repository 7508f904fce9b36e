//! Properties of a scene and of a tree that are known without tracing rays.

use crate::primitive::Shape;
use crate::scene::Scene;
use crate::structure::{NodeKind, Tree};

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
    pub leaves: u64,
    pub empty_leaves: u64,
    pub references: u64,
    /// Volume of the root cell, which is the scene's bounding box plus the root margin.
    pub root_volume: f64,
    /// Sum of the volumes of the empty leaves.
    pub empty_volume: f64,
    pub bytes: u64,
}

impl TreeFacts {
    pub fn of(tree: &Tree) -> Self {
        let mut facts = TreeFacts {
            depth_reached: u64::from(tree.depth_reached()),
            references: tree.references().len() as u64,
            root_volume: tree.root_cell().volume(),
            bytes: tree.bytes() as u64,
            ..TreeFacts::default()
        };
        for cell in tree.cells() {
            match tree.kind(cell.node) {
                NodeKind::Inner => facts.inner_nodes += 1,
                NodeKind::Leaf { count, .. } => {
                    facts.leaves += 1;
                    if count == 0 {
                        facts.empty_leaves += 1;
                        facts.empty_volume += cell.bounds.volume();
                    }
                }
            }
        }
        facts
    }
}
