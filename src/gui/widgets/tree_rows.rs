//! Which nodes the outline shows: those whose parents are all unfolded.

use crate::structure::{Moment, Tree, TreeIndex};
use std::collections::HashSet;

/// The unfolded nodes and the rows that follow from them.
pub struct Rows {
    unfolded: HashSet<u32>,
    rows: Vec<u32>,
    /// The moment of the build that is shown.
    moment: Option<Moment>,
}

impl Rows {
    /// The root unfolded, all else folded.
    pub fn new(tree: &Tree, index: &TreeIndex) -> Self {
        let mut rows = Rows {
            unfolded: HashSet::from([0]),
            rows: Vec::new(),
            moment: None,
        };
        rows.lay_out(tree, index);
        rows
    }

    /// Shows the nodes that there were at a moment of the build, or all.
    pub fn show(&mut self, tree: &Tree, index: &TreeIndex, moment: Option<Moment>) {
        if self.moment != moment {
            self.moment = moment;
            self.lay_out(tree, index);
        }
    }

    /// Whether a node was a leaf or split by the moment that is shown.
    pub fn is_decided(&self, tree: &Tree, index: &TreeIndex, node: u32) -> bool {
        let depth = index.of(node).depth;
        self.moment
            .is_none_or(|moment| tree.is_decided(node, depth, moment))
    }

    /// The nodes shown, from top to bottom: in the order of the array.
    pub fn nodes(&self) -> &[u32] {
        &self.rows
    }

    /// The row of a node that is shown.
    pub fn row_of(&self, node: u32) -> Option<usize> {
        self.rows.binary_search(&node).ok()
    }

    pub fn is_unfolded(&self, node: u32) -> bool {
        self.unfolded.contains(&node)
    }

    /// Folds or unfolds a node.
    pub fn set(&mut self, tree: &Tree, index: &TreeIndex, node: u32, unfolded: bool) {
        let changed = if unfolded {
            self.unfolded.insert(node)
        } else {
            self.unfolded.remove(&node)
        };
        if changed {
            self.lay_out(tree, index);
        }
    }

    /// Unfolds all above a node; gives its row.
    pub fn reveal(&mut self, tree: &Tree, index: &TreeIndex, node: u32) -> Option<usize> {
        let before = self.unfolded.len();
        let path = index.path_to(node);
        self.unfolded.extend(&path[..path.len() - 1]);
        if self.unfolded.len() != before {
            self.lay_out(tree, index);
        }
        self.row_of(node)
    }

    fn lay_out(&mut self, tree: &Tree, index: &TreeIndex) {
        self.rows.clear();
        let mut stack = vec![0];
        while let Some(node) = stack.pop() {
            self.rows.push(node);
            if self.unfolded.contains(&node) && self.is_decided(tree, index, node) {
                let from = stack.len();
                stack.extend(tree.child_nodes(node));
                stack[from..].reverse();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::progress::Progress;
    use crate::scene::{SceneRequest, load};
    use crate::structure::{BuildSettings, build};

    #[test]
    fn revealing_a_node_unfolds_the_way_to_it_alone() {
        let progress = Progress::new();
        let scene = load(&SceneRequest::parse("balls:1"), &progress).unwrap();
        let tree = build(&scene, &BuildSettings::default(), &progress).unwrap();
        let index = TreeIndex::new(&tree, scene.objects().len());
        let mut rows = Rows::new(&tree, &index);
        assert_eq!(rows.nodes().len(), 3);
        let node = tree.nodes().len() as u32 / 2;
        let row = rows.reveal(&tree, &index, node).unwrap();
        assert_eq!(rows.nodes()[row], node);
        let levels = index.path_to(node).len();
        assert_eq!(rows.nodes().len(), 2 * levels - 1);
        rows.show(&tree, &index, Some(Moment::Node(1)));
        assert_eq!(rows.nodes().len(), 3);
        assert!(rows.is_decided(&tree, &index, 0) && !rows.is_decided(&tree, &index, 1));
        rows.show(&tree, &index, None);
        assert_eq!(rows.nodes().len(), 2 * levels - 1);
        rows.set(&tree, &index, 0, false);
        assert_eq!(rows.nodes(), [0]);
        assert_eq!(rows.row_of(node), None);
    }
}
