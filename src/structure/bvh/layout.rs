//! Lays out a binary hierarchy: wide nodes, depth-first order, boxes that are certainly wide enough.

use super::binary::{Binary, BinaryNode, Content};
use crate::geometry::{Aabb, Axis};
use crate::progress::{Cancelled, Progress};
use crate::structure::box_node::BoxNode;
use crate::structure::frame::Frame;
use rayon::prelude::*;

/// A hierarchy as it is stored.
pub struct Laid {
    pub nodes: Vec<BoxNode>,
    pub references: Vec<u32>,
    pub depth_reached: u32,
}

/// Lays out a hierarchy with at most `width` children per node.
///
/// # Errors
/// Cancellation.
pub fn lay_out(
    binary: &Binary,
    width: usize,
    frame: &Frame,
    progress: &Progress,
) -> Result<Laid, Cancelled> {
    /// Nodes that one thread encloses.
    const CHUNK: usize = 1 << 12;
    let mut laid = Laid {
        nodes: Vec::with_capacity(binary.nodes.len()),
        references: Vec::with_capacity(binary.references.len()),
        depth_reached: 0,
    };
    let boxes = binary.nodes.par_iter().with_min_len(CHUNK);
    let boxes: Vec<_> = boxes.map(|node| sides(frame, &node.bounds)).collect();
    progress.check()?;
    // The parents of all laid nodes; the root is its own parent.
    let mut parents = Vec::with_capacity(binary.nodes.len());
    let mut children = Vec::with_capacity(width);
    let mut stack = vec![(binary.root, 0_u32, 0_u32)];
    while let Some((node, parent, depth)) = stack.pop() {
        let index = laid.nodes.len() as u32;
        if index.is_multiple_of(1 << 12) {
            progress.check()?;
        }
        let sides = boxes[node as usize];
        parents.push(parent);
        laid.depth_reached = laid.depth_reached.max(depth);
        match binary.nodes[node as usize].content {
            Content::Leaf { first, count, stop } => {
                let from = laid.references.len() as u32;
                let held = &binary.references[first as usize..(first + count) as usize];
                laid.references.extend_from_slice(held);
                laid.nodes.push(BoxNode::leaf(sides, from, count, stop));
            }
            Content::Children(two) => {
                open(binary, two, width, &mut children);
                // Their end is not known yet.
                laid.nodes.push(BoxNode::inner(sides, children.len(), 0));
                stack.extend(
                    children
                        .iter()
                        .rev()
                        .map(|&child| (child, index, depth + 1)),
                );
            }
        }
    }
    close(&mut laid.nodes, &parents);
    Ok(laid)
}

/// Sets the ends of all subtrees. A subtree ends where its last child ends, which comes after it; the root is its
/// own parent.
pub fn close(nodes: &mut [BoxNode], parents: &[u32]) {
    let mut ends: Vec<u32> = (1..=nodes.len() as u32).collect();
    for node in (1..nodes.len()).rev() {
        let parent = parents[node] as usize;
        ends[parent] = ends[parent].max(ends[node]);
    }
    for (node, &end) in nodes.iter_mut().zip(&ends) {
        if !node.is_leaf() {
            *node = BoxNode::inner([node.lo, node.hi], node.child_count(), end);
        }
    }
}

/// Replaces the child of the largest area by its own children, until there are `width` children or only
/// leaves. Of equal areas, the first is replaced. The order of children stays.
fn open(binary: &Binary, two: [u32; 2], width: usize, children: &mut Vec<u32>) {
    children.clear();
    children.extend(two);
    while children.len() < width {
        let mut largest: Option<(f64, usize, [u32; 2])> = None;
        for (i, &child) in children.iter().enumerate() {
            let BinaryNode { bounds, content } = &binary.nodes[child as usize];
            if let Content::Children(two) = *content {
                let area = bounds.surface_area();
                if largest.is_none_or(|(most, ..)| area > most) {
                    largest = Some((area, i, two));
                }
            }
        }
        let Some((_, i, two)) = largest else {
            return;
        };
        children.splice(i..=i, two);
    }
}

/// Returns a box in local coordinates, on every side farther out than rounding ([`Frame::slack`]).
pub fn sides(frame: &Frame, bounds: &Aabb) -> [[f32; 3]; 2] {
    [
        std::array::from_fn(|k| frame.plane_below(Axis::from_index(k), bounds.lo[k])),
        std::array::from_fn(|k| frame.plane_above(Axis::from_index(k), bounds.hi[k])),
    ]
}
