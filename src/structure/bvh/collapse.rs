//! Leaves for builders that merge: subtrees that cost more than a leaf become one.

use super::binary::{Binary, Content};
use super::costs::Costs;
use crate::progress::{Cancelled, Progress};
use crate::structure::node::StopReason;

/// Nodes between two checks for cancellation.
const CHUNK: usize = 1 << 14;

/// Costs that differ by less are equal, so that rounding does not decide between them.
const SLACK: f64 = 1.0 + 1e-9;

/// Replaces every subtree by a leaf where that does not cost more by the surface-area heuristic, from the leaves
/// upward. Children of a node of more than `max_leaf` objects stay apart, those of one of at most `min_leaf` do
/// not.
///
/// # Errors
/// Cancellation.
pub fn collapse(full: &Binary, costs: Costs, progress: &Progress) -> Result<Binary, Cancelled> {
    let inner = inner_nodes(full, |_| true);
    let mut subtrees = vec![Subtree::default(); full.nodes.len()];
    for (node, subtree) in full.nodes.iter().zip(&mut subtrees) {
        if let Content::Leaf { count, .. } = node.content {
            let count = count as usize;
            let cost = costs.test * costs.blocks(count) * node.bounds.surface_area();
            *subtree = Subtree {
                count,
                cost,
                becomes: None,
            };
        }
    }
    for (i, &(node, children)) in inner.iter().rev().enumerate() {
        if i.is_multiple_of(CHUNK) {
            progress.check()?;
        }
        let [a, b] = children.map(|child| subtrees[child as usize]);
        let area = full.nodes[node as usize].bounds.surface_area();
        let count = a.count + b.count;
        let split = costs.traversal * area + a.cost + b.cost;
        let leaf = costs.test * costs.blocks(count) * area;
        let becomes = if count <= costs.min_leaf {
            Some(StopReason::FewObjects)
        } else {
            (count <= costs.max_leaf && leaf <= split * SLACK).then_some(StopReason::Collapsed)
        };
        subtrees[node as usize] = Subtree {
            count,
            cost: if becomes.is_some() { leaf } else { split },
            becomes,
        };
    }
    emit(full, &subtrees, progress)
}

#[derive(Clone, Copy, Default)]
struct Subtree {
    /// Number of references.
    count: usize,
    cost: f64,
    /// Why it becomes a leaf, if it does.
    becomes: Option<StopReason>,
}

/// Copies the nodes that are left.
fn emit(full: &Binary, subtrees: &[Subtree], progress: &Progress) -> Result<Binary, Cancelled> {
    let mut kept = Binary::default();
    // The new index of every inner node that is left.
    let mut moved = vec![u32::MAX; full.nodes.len()];
    let copied = |kept: &mut Binary, node: u32| {
        let from = &full.nodes[node as usize];
        let stop = match from.content {
            Content::Leaf { stop, .. } => stop,
            Content::Children(_) => subtrees[node as usize].becomes?,
        };
        Some(kept.leaf(from.bounds, objects_below(full, node), stop))
    };
    if copied(&mut kept, full.root).is_some() {
        return Ok(kept);
    }
    let inner = inner_nodes(full, |node| subtrees[node as usize].becomes.is_none());
    for (i, &(node, children)) in inner.iter().rev().enumerate() {
        if i.is_multiple_of(CHUNK) {
            progress.check()?;
        }
        let children = children.map(|child| match copied(&mut kept, child) {
            Some(leaf) => leaf,
            None => moved[child as usize],
        });
        moved[node as usize] = kept.inner(children);
    }
    Ok(kept)
}

/// Returns the inner nodes that can be reached through nodes that stay, with their children: parents before
/// their children. Needs no recursion, because a hierarchy can be deep.
fn inner_nodes(full: &Binary, stays: impl Fn(u32) -> bool) -> Vec<(u32, [u32; 2])> {
    let mut found = Vec::new();
    let mut stack = vec![full.root];
    while let Some(node) = stack.pop() {
        if let Content::Children(children) = full.nodes[node as usize].content
            && stays(node)
        {
            found.push((node, children));
            stack.extend(children);
        }
    }
    found
}

/// Returns the objects of all leaves of a subtree.
fn objects_below(full: &Binary, node: u32) -> Vec<u32> {
    let mut objects = Vec::new();
    let mut stack = vec![node];
    while let Some(node) = stack.pop() {
        match full.nodes[node as usize].content {
            Content::Children(children) => stack.extend(children),
            Content::Leaf { first, count, .. } => {
                let held = first as usize..(first + count) as usize;
                objects.extend_from_slice(&full.references[held]);
            }
        }
    }
    objects
}
