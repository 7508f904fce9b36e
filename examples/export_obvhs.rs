//! Writes the hierarchy of obvhs for a scene to a tree file (`.bstree`).
//!
//! `cargo run --release --example export_obvhs -- model.obj obvhs.bstree`, then `bspscope measure model.obj
//! --tree obvhs.bstree`.

use bspscope::primitive::Shape;
use bspscope::progress::Progress;
use bspscope::scene::{SceneRequest, load};
use bspscope::structure::tree_file::{Hierarchy, Holds};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use std::fs::File;
use std::time::Duration;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [scene, file]: [String; 2] = std::env::args()
        .skip(1)
        .collect::<Vec<_>>()
        .try_into()
        .map_err(|_| "expected a scene and a tree file")?;
    let scene = load(&SceneRequest::parse(&scene), &Progress::new())?;
    let bounds = scene.objects().iter().map(|object| object.bounds());
    let boxes: Vec<Aabb> = bounds
        .map(|b| Aabb::new(b.lo.as_vec3a(), b.hi.as_vec3a()))
        .collect();
    let params = BvhBuildParams::very_slow_build();
    let bvh = build_bvh2(&boxes, params, &mut Duration::default());
    let node = |node: &obvhs::bvh2::node::Bvh2Node| {
        let (first, count) = (node.first_index, node.prim_count);
        let holds = if node.is_leaf() {
            let range = first as usize..(first + count) as usize;
            Holds::Objects(bvh.primitive_indices[range].to_vec())
        } else {
            Holds::Children(vec![first, first + 1])
        };
        let corners = [node.aabb().min.to_array(), node.aabb().max.to_array()];
        (corners, holds)
    };
    let hierarchy = Hierarchy {
        width: 2,
        objects: boxes.len() as u32,
        nodes: bvh.nodes.iter().map(node).collect(),
    };
    hierarchy.write(&mut File::create(file)?)?;
    Ok(())
}
