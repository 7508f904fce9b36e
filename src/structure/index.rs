//! Facts on every node, computed once per tree: sums over subtrees, expected work of rays, and the
//! leaves of each object.

use super::node::NodeKind;
use super::tree::Tree;
use std::ops::Range;

/// Facts on a node in addition to those in [`Tree`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeFacts {
    /// Levels below the root.
    pub depth: u32,
    /// The parent; the root is its own parent.
    pub parent: u32,
    /// One past the last node of the subtree.
    pub end: u32,
    /// Number of leaves in the subtree.
    pub leaves: u32,
    /// Number of references in all leaves of the subtree.
    pub references: u32,
    /// Number of distinct objects in the subtree.
    pub objects: u32,
    /// Surface area of the cell, in squared units of length.
    pub area: f64,
    /// Volume of the cell, in cubed units of length.
    pub volume: f64,
    /// Expected number of nodes of the subtree, including this one, that a ray through the cell
    /// visits if nothing stops it; at least 1.
    pub expected_visits: f64,
    /// Expected number of intersection tests of such a ray.
    pub tests: f64,
}

/// The facts on all nodes, and the leaves of every object.
///
/// A ray that hits a convex cell hits a convex part of it with a probability equal to the ratio of
/// their surface areas (J. D. MacDonald and K. S. Booth, Heuristics for ray tracing using space
/// subdivision, 1990). The expected values are computed from the leaves upward.
#[derive(Clone, Debug, Default)]
pub struct TreeIndex {
    nodes: Vec<NodeFacts>,
    /// For every object, the index of its first leaf in `leaves`; one more entry marks the end.
    starts: Vec<u32>,
    leaves: Vec<u32>,
}

impl TreeIndex {
    /// Computes all facts; `objects` is the number of objects in the scene.
    pub fn new(tree: &Tree, objects: usize) -> Self {
        let mut nodes = vec![NodeFacts::default(); tree.nodes().len()];
        for cell in tree.cells() {
            let facts = &mut nodes[cell.node as usize];
            facts.depth = cell.depth;
            facts.area = cell.bounds.surface_area();
            facts.volume = cell.bounds.volume();
            for child in tree.child_nodes(cell.node) {
                nodes[child as usize].parent = cell.node;
            }
        }
        let (starts, leaves) = leaves_by_object(tree, objects);
        sum_up(tree, &mut nodes);
        count_objects(&mut nodes, tree, &starts, &leaves);
        TreeIndex {
            nodes,
            starts,
            leaves,
        }
    }

    /// Returns the facts on a node.
    ///
    /// # Panics
    /// If the node does not exist.
    pub fn of(&self, node: u32) -> &NodeFacts {
        &self.nodes[node as usize]
    }

    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns whether there are no nodes, which is never the case for a tree.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Returns the leaves that refer to an object, in ascending order.
    pub fn leaves_of(&self, object: u32) -> &[u32] {
        match self.starts.get(object as usize..object as usize + 2) {
            Some(&[from, to]) => &self.leaves[from as usize..to as usize],
            _ => &[],
        }
    }

    /// Returns the nodes from the root to this one, both included.
    pub fn path_to(&self, node: u32) -> Vec<u32> {
        let mut path = vec![node];
        let mut at = node;
        while at != 0 {
            at = self.of(at).parent;
            path.push(at);
        }
        path.reverse();
        path
    }
}

impl Tree {
    /// Returns the range of references of the subtree of `node`, which ends before node `end`. The
    /// references of consecutive leaves are consecutive.
    pub fn references_below(&self, node: u32, end: u32) -> Range<usize> {
        let first = (node..end).find_map(|n| match self.kind(n) {
            NodeKind::Leaf { first, .. } => Some(first as usize),
            NodeKind::Inner => None,
        });
        // The last node of a subtree is a leaf.
        match (first, self.kind(end - 1)) {
            (Some(from), NodeKind::Leaf { first, count, .. }) => from..(first + count) as usize,
            _ => 0..0,
        }
    }
}

fn leaves_by_object(tree: &Tree, objects: usize) -> (Vec<u32>, Vec<u32>) {
    let mut starts = vec![0_u32; objects + 1];
    for &object in tree.references() {
        starts[object as usize + 1] += 1;
    }
    for i in 0..objects {
        starts[i + 1] += starts[i];
    }
    let mut next = starts.clone();
    let mut leaves = vec![0; tree.references().len()];
    for node in 0..tree.nodes().len() as u32 {
        for &object in tree.leaf_objects(node) {
            leaves[next[object as usize] as usize] = node;
            next[object as usize] += 1;
        }
    }
    (starts, leaves)
}

/// Sums over subtrees. Children come after their parents, so in reverse order every child is
/// complete.
fn sum_up(tree: &Tree, nodes: &mut [NodeFacts]) {
    for node in (0..nodes.len()).rev() {
        let (first, rest) = nodes[node..].split_at_mut(1);
        let facts = &mut first[0];
        match tree.kind(node as u32) {
            NodeKind::Leaf { count, .. } => {
                facts.end = node as u32 + 1;
                facts.leaves = 1;
                facts.references = count;
                facts.expected_visits = 1.0;
                facts.tests = f64::from(count);
            }
            NodeKind::Inner => {
                facts.expected_visits = 1.0;
                for child in tree.child_nodes(node as u32) {
                    let child = &rest[child as usize - node - 1];
                    facts.end = child.end;
                    facts.leaves += child.leaves;
                    facts.references += child.references;
                    let share = child.area / facts.area;
                    facts.expected_visits += share * child.expected_visits;
                    facts.tests += share * child.tests;
                }
            }
        }
    }
}

/// Counts the distinct objects of each subtree. An object with leaves on both sides of a node would
/// be counted twice there; two consecutive leaves of its list separate at their lowest common
/// ancestor.
fn count_objects(nodes: &mut [NodeFacts], tree: &Tree, starts: &[u32], leaves: &[u32]) {
    let mut duplicates = vec![0_u32; nodes.len()];
    for range in starts.windows(2) {
        for pair in leaves[range[0] as usize..range[1] as usize].windows(2) {
            let mut at = pair[0];
            while nodes[at as usize].end <= pair[1] {
                at = nodes[at as usize].parent;
            }
            duplicates[at as usize] += 1;
        }
    }
    for node in (0..nodes.len()).rev() {
        nodes[node].objects = match tree.kind(node as u32) {
            NodeKind::Leaf { count, .. } => count,
            NodeKind::Inner => {
                let children = tree.child_nodes(node as u32);
                let sum: u32 = children.map(|child| nodes[child as usize].objects).sum();
                sum - duplicates[node]
            }
        };
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{Scene, SceneRequest, load};
    use crate::structure::{BuildSettings, Method, build};
    use std::collections::BTreeSet;

    pub fn small(scene: &str, method: &str) -> (Scene, Tree) {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse(scene), &progress).unwrap();
        let settings = BuildSettings::for_method(Method::named(method).unwrap());
        let tree = build(&scene, &settings, &progress).unwrap();
        (scene, tree)
    }

    #[test]
    fn sums_agree_with_counting_every_subtree() {
        for method in ["midpoint", "sah-cut", "none"] {
            let (scene, tree) = small("balls:1", method);
            let index = TreeIndex::new(&tree, scene.objects().len());
            assert_eq!(index.len(), tree.nodes().len());
            assert_eq!(index.of(0).end as usize, tree.nodes().len());
            for cell in tree.cells() {
                let facts = index.of(cell.node);
                assert_eq!(facts.depth, cell.depth);
                let below = tree.references_below(cell.node, facts.end);
                assert_eq!(below.len(), facts.references as usize);
                let objects: BTreeSet<u32> = tree.references()[below].iter().copied().collect();
                assert_eq!(objects.len(), facts.objects as usize);
                let leaves = (cell.node..facts.end)
                    .filter(|&n| matches!(tree.kind(n), NodeKind::Leaf { .. }))
                    .count();
                assert_eq!(leaves, facts.leaves as usize);
                let expected: f64 = (cell.node..facts.end)
                    .map(|n| index.of(n).area / facts.area * tree.leaf_objects(n).len() as f64)
                    .sum();
                assert!((facts.tests - expected).abs() <= 1e-9 * expected);
            }
        }
    }

    #[test]
    fn every_reference_is_found_from_its_object() {
        let (scene, tree) = small("balls:1", "midpoint");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let mut found = 0;
        for object in 0..scene.objects().len() as u32 {
            let leaves = index.leaves_of(object);
            assert!(leaves.is_sorted());
            assert!(
                leaves
                    .iter()
                    .all(|&l| tree.leaf_objects(l).contains(&object))
            );
            found += leaves.len();
        }
        assert_eq!(found, tree.references().len());
        assert!(index.leaves_of(1_000_000).is_empty());
    }

    #[test]
    fn paths_lead_from_the_root_by_children() {
        let (scene, tree) = small("balls:1", "sah-cut");
        let index = TreeIndex::new(&tree, scene.objects().len());
        let last = tree.nodes().len() as u32 - 1;
        let path = index.path_to(last);
        assert_eq!((path[0], path[path.len() - 1]), (0, last));
        for pair in path.windows(2) {
            assert!(tree.child_nodes(pair[0]).any(|child| child == pair[1]));
        }
    }
}
