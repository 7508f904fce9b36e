//! Writes the hierarchy that Embree's builder makes for a scene to a tree file (`.bstree`); needs libembree 3 or 4.
//!
//! `cargo run --release --example export_embree -- model.obj embree.bstree`, then `bspscope measure model.obj
//! --tree embree.bstree`.

#[path = "export_embree/builder.rs"]
mod builder;

use bspscope::primitive::Shape;
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::structure::tree_file::{Hierarchy, Holds};
use builder::{Node, build};
use std::fs::File;

/// Most children of a node.
const WIDTH: u32 = 4;

/// Appends a node with all nodes below it, and returns its index.
fn add(node: &Node, corners: [[f32; 3]; 2], nodes: &mut Vec<([[f32; 3]; 2], Holds)>) -> u32 {
    let index = nodes.len();
    nodes.push((corners, Holds::Objects(node.objects.clone())));
    if !node.children.is_empty() {
        let children = node.children.iter().zip(&node.boxes);
        let children = children.map(|(child, corners)| add(child, *corners, nodes));
        nodes[index].1 = Holds::Children(children.collect());
    }
    index as u32
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [scene, file]: [String; 2] = std::env::args()
        .skip(1)
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|_| "expected a scene and a tree file")?;
    let scene = load(&SceneRequest::parse(&scene), &Progress::new())?;
    let bounds = scene.objects().iter().map(|object| object.bounds());
    let boxes: Vec<_> = bounds
        .map(|b| [b.lo, b.hi].map(|corner| corner.as_vec3().to_array()))
        .collect();
    let root = build(&boxes, WIDTH)?;
    let all = [scene.bounds().lo, scene.bounds().hi].map(|c| c.as_vec3().to_array());
    let mut nodes = Vec::new();
    add(&root, all, &mut nodes);
    let hierarchy = Hierarchy {
        width: WIDTH,
        objects: boxes.len() as u32,
        nodes,
    };
    hierarchy.write(&mut File::create(file)?)?;
    Ok(())
}
