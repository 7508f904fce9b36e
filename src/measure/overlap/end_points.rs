//! End-point overlap, `EPO`: the nodes around a point of a surface that do not hold its object.
//!
//! After T. Aila, T. Karras and S. Laine, On quality metrics of bounding volume hierarchies, 2013.
//!
//! ```text
//! for every object:
//!     nodes = root
//!     for every node that holds the object, and each of its children that the object's bounds touch:
//!         the child holds the object:  nodes += child
//!         else:                        clip the surface to the child's box; add its area, times the child's
//!                                      cost; repeat with the part for the child's children
//! ```

use super::piece::{Piece, Pieces};
use crate::geometry::Aabb;
use crate::primitive::Shape;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::{NodeKind, Tree, TreeIndex};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// Cost of an inner node in `C_SAH` and `EPO`.
pub const COST_OF_INNER_NODE: f64 = 1.2;

/// Cost of an intersection test in `C_SAH` and `EPO`.
pub const COST_OF_TEST: f64 = 1.0;

/// Objects between two checks for cancellation.
const CHUNK: usize = 256;

/// Most points of surfaces that are compared with boxes: about ten seconds of CPU time. Ten times as many as
/// the 8401 curved objects of rings need.
const MOST_WORK: u64 = 1 << 32;

/// What is known of the tree.
struct Nodes<'a> {
    tree: &'a Tree,
    boxes: &'a [Aabb],
    index: TreeIndex,
}

/// Memory that is reused for the next object.
#[derive(Default)]
struct Memory {
    pieces: Pieces,
    own: Vec<u32>,
    foreign: Vec<(u32, Piece)>,
}

/// Returns the end-point overlap of a hierarchy whose nodes have these boxes. `None` if the surface has no area,
/// or if it would take too long.
///
/// # Errors
/// Cancellation.
pub fn end_point_overlap(
    scene: &Scene,
    tree: &Tree,
    boxes: &[Aabb],
    progress: &Progress,
) -> Result<Option<f64>, Cancelled> {
    let objects = scene.objects();
    let nodes = Nodes {
        tree,
        boxes,
        index: TreeIndex::new(tree, objects.len()),
    };
    // Whether their sum is too large does not depend on the number of threads.
    let work = AtomicU64::new(0);
    let chunks = objects.par_chunks(CHUNK).enumerate();
    let parts: Vec<[f64; 2]> = chunks
        .map(|(chunk, objects)| {
            progress.check()?;
            let mut memory = Memory::default();
            let mut sums = [0.0; 2];
            if work.load(Ordering::Relaxed) > MOST_WORK {
                return Ok(sums);
            }
            for (i, object) in objects.iter().enumerate() {
                let whole = memory.pieces.whole(object);
                sums[0] += memory.pieces.area(&whole);
                let number = (chunk * CHUNK + i) as u32;
                sums[1] += nodes.cost(number, &object.bounds(), &whole, &mut memory);
            }
            work.fetch_add(memory.pieces.work, Ordering::Relaxed);
            Ok(sums)
        })
        .collect::<Result<_, Cancelled>>()?;
    if work.into_inner() > MOST_WORK {
        return Ok(None);
    }
    // One sum after the other, so that the result is the same for any number of threads.
    let [area, cost] = parts
        .iter()
        .fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    Ok((area > 0.0).then(|| cost / area))
}

impl Nodes<'_> {
    /// Returns the areas of an object in nodes that do not hold it, each multiplied by the node's cost.
    fn cost(&self, object: u32, bounds: &Aabb, whole: &Piece, memory: &mut Memory) -> f64 {
        let Memory {
            pieces,
            own,
            foreign,
        } = memory;
        let leaves = self.index.leaves_of(object);
        let holds = |node: u32| {
            let leaf = leaves.partition_point(|&leaf| leaf < node);
            leaves
                .get(leaf)
                .is_some_and(|&leaf| leaf < self.index.of(node).end)
        };
        let mut cost = 0.0;
        own.clear();
        own.push(0);
        while let Some(node) = own.pop() {
            for child in self.tree.child_nodes(node) {
                if !self.boxes[child as usize].touches(bounds) {
                    continue;
                }
                if holds(child) {
                    own.push(child);
                    continue;
                }
                foreign.push((child, *whole));
                // Pieces are made in the order of a stack, so that none is lost while it is needed.
                while let Some((node, piece)) = foreign.pop() {
                    let Some(part) = pieces.within(&piece, &self.boxes[node as usize]) else {
                        continue;
                    };
                    let cost_of_node = match self.tree.kind(node) {
                        NodeKind::Inner => COST_OF_INNER_NODE,
                        NodeKind::Leaf { count, .. } => COST_OF_TEST * f64::from(count),
                    };
                    cost += cost_of_node * pieces.area(&part);
                    let children = self.tree.child_nodes(node);
                    foreign.extend(children.map(|child| (child, part)));
                }
            }
        }
        cost
    }
}
