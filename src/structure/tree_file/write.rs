//! Writes a tree to a file.

use super::data::Data;
use super::header::{Cells, Header, Kind, Number, Order, Root};
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::scene::Scene;
use crate::structure::box_node::BoxNode;
use crate::structure::bvh::sides;
use crate::structure::method::Structure;
use crate::structure::node::{Node, NodeKind, StopReason};
use crate::structure::nodes::Nodes;
use crate::structure::tree::Tree;
use std::io::{self, Write};

/// Where the scene of a tree comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Origin {
    /// SHA-256 of the file of the scene in hexadecimal digits; `None` for a generator.
    pub sha256: Option<String>,
}

/// Writes a tree of a scene. Read again, it is the same tree, bit for bit.
///
/// # Errors
/// I/O errors.
pub fn write(tree: &Tree, scene: &Scene, origin: &Origin, out: &mut dyn Write) -> io::Result<()> {
    let mut data = Data::default();
    let (kind, split) = match tree.nodes() {
        Nodes::Boxes(nodes) => (Kind::Bvh, add_boxes(tree, nodes, scene, &mut data)),
        Nodes::Planes(nodes) => {
            add_planes(nodes, &mut data);
            (Kind::Kd, false)
        }
    };
    add_leaves(tree, &mut data);
    let (center, half) = tree.frame().center_and_half();
    let structure = tree.settings().method.structure;
    let header = Header {
        structure: match structure {
            Structure::Octree => Cells::Octree,
            Structure::Grid => Cells::Grid,
            Structure::Bintree | Structure::Bvh => Cells::Bintree,
        },
        width: match structure {
            Structure::Bvh => tree.settings().constant("width") as u32,
            _ => 2,
        },
        sha256: origin.sha256.clone(),
        split,
        root: Some(Root {
            center: center.to_array(),
            half: half.to_array(),
            margin: tree.root_margin(),
        }),
        stops: StopReason::ALL.to_vec(),
        ..Header::new(kind, scene.objects().len() as u32, Order::Object)
    };
    data.write(header, out)
}

/// Adds what both kinds of trees have.
fn add_leaves(tree: &Tree, data: &mut Data) {
    let nodes = || 0..tree.nodes().len() as u32;
    let kinds = || nodes().map(|node| tree.kind(node));
    data.u8s(
        "leaf",
        kinds().map(|kind| u8::from(kind != NodeKind::Inner)),
    );
    let mut children = 0;
    let ranges: Vec<[u32; 2]> = nodes()
        .map(|node| match tree.kind(node) {
            NodeKind::Leaf { first, count, .. } => [first, count],
            NodeKind::Inner => {
                let count = tree.child_nodes(node).count() as u32;
                children += count;
                [children - count, count]
            }
        })
        .collect();
    data.u32s("first", ranges.iter().map(|range| range[0]));
    data.u32s("count", ranges.iter().map(|range| range[1]));
    data.u32s("ref", tree.references().iter().copied());
    let stop = kinds().map(|kind| match kind {
        NodeKind::Leaf { stop, .. } => stop as u8,
        NodeKind::Inner => 0,
    });
    data.u8s("stop", stop);
}

/// Adds boxes, and returns whether one is not that around the objects of its leaf.
fn add_boxes(tree: &Tree, nodes: &[BoxNode], scene: &Scene, data: &mut Data) -> bool {
    let corners = nodes.iter().flat_map(|node| {
        let bounds = tree.box_of(node);
        [bounds.lo, bounds.hi]
            .into_iter()
            .flat_map(|corner| corner.to_array())
    });
    data.add(("box", Number::F64, 6), corners.map(f64::to_le_bytes));
    let children = (0..nodes.len() as u32).flat_map(|node| tree.child_nodes(node));
    data.u32s("child", children);
    let is_other = |node: u32| {
        let held = tree.leaf_objects(node).iter();
        let bounds = held.map(|&object| scene.objects()[object as usize].bounds());
        let all = bounds.fold(Aabb::EMPTY, |all, bounds| all.union(&bounds));
        let BoxNode { lo, hi, .. } = nodes[node as usize];
        !all.is_empty() && sides(tree.frame(), &all) != [lo, hi]
    };
    (0..nodes.len() as u32).any(is_other)
}

fn add_planes(nodes: &[Node], data: &mut Data) {
    // A leaf has axis 3.
    let inner = |node: &Node| match node.is_leaf() {
        true => (3, 0.0, 0),
        false => node.as_inner(),
    };
    data.u8s("axis", nodes.iter().map(|node| inner(node).0 as u8));
    let planes = nodes.iter().map(|node| inner(node).1.to_le_bytes());
    data.add(("plane", Number::F32, 1), planes);
    let below = (1..)
        .zip(nodes)
        .map(|(next, node)| if node.is_leaf() { 0 } else { next });
    data.u32s("below", below);
    data.u32s("above", nodes.iter().map(|node| inner(node).2));
}
