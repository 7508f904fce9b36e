//! The finished tree as it stood at a moment of its build. Nothing is built again: nodes were decided
//! in the order of the array, depth first.

use super::node::NodeKind;
use super::tree::{CellOfNode, Tree};
use serde::{Deserialize, Serialize};

/// A moment of the build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Moment {
    /// Every cell above this depth is decided, as if the tree had been built level by level; so are
    /// the leaves at this depth.
    Depth(u32),
    /// Every node before this one is decided: this one is next.
    Node(u32),
}

impl Tree {
    /// Whether a node of this depth was a leaf or split by then; one that was not is an undecided
    /// cell, if all nodes above it were split.
    pub fn is_decided(&self, node: u32, depth: u32, moment: Moment) -> bool {
        match moment {
            Moment::Depth(limit) => {
                depth < limit || depth == limit && matches!(self.kind(node), NodeKind::Leaf { .. })
            }
            Moment::Node(next) => node < next,
        }
    }

    /// The cells that the root cell was divided into by then, each with whether it was decided to be
    /// a leaf; in the order of the array.
    pub fn cells_at(&self, moment: Moment) -> impl Iterator<Item = (CellOfNode, bool)> + '_ {
        let mut stack = vec![self.root()];
        std::iter::from_fn(move || {
            loop {
                let cell = stack.pop()?;
                let decided = self.is_decided(cell.node, cell.depth, moment);
                match self.children(&cell) {
                    Some([below, above]) if decided => stack.extend([above, below]),
                    _ => return Some((cell, decided)),
                }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::index::tests::small;

    #[test]
    fn cells_of_every_moment_fill_the_root_cell() {
        for method in ["midpoint", "sah-cut"] {
            let (_, tree) = small("balls:1", method);
            let nodes = tree.nodes().len() as u32;
            let volume = tree.root_cell().volume();
            let depths = (0..=tree.depth_reached()).map(Moment::Depth);
            for moment in depths.chain((0..=nodes).map(Moment::Node)) {
                let cells = tree.cells_at(moment);
                let sum: f64 = cells.map(|(cell, _)| cell.bounds.volume()).sum();
                assert!((sum - volume).abs() < 1e-9 * volume, "{moment:?}");
            }
        }
    }

    #[test]
    fn every_step_decides_one_node() {
        let (_, tree) = small("balls:1", "sah-cut");
        let nodes = tree.nodes().len() as u32;
        let open = |next| {
            let cells = tree.cells_at(Moment::Node(next));
            let open = cells.filter(|(_, decided)| !decided);
            open.map(|(cell, _)| cell.node).collect::<Vec<_>>()
        };
        assert_eq!(open(0), [0]);
        for next in 0..nodes {
            // The build goes on with the first cell that is open.
            assert_eq!(open(next)[0], next);
            let mut expected = open(next);
            expected.remove(0);
            if let NodeKind::Inner { below, above, .. } = tree.kind(next) {
                expected.splice(0..0, [below, above]);
            }
            assert_eq!(open(next + 1), expected);
        }
        assert!(open(nodes).is_empty());
    }

    #[test]
    fn the_last_depth_shows_the_finished_tree() {
        for method in ["midpoint", "sah-cut", "none"] {
            let (_, tree) = small("balls:1", method);
            let cells = tree.cells_at(Moment::Depth(tree.depth_reached()));
            let shown: Vec<_> = cells.map(|(cell, decided)| (cell.node, decided)).collect();
            let leaves = (0..tree.nodes().len() as u32)
                .filter(|&node| matches!(tree.kind(node), NodeKind::Leaf { .. }));
            assert_eq!(shown, leaves.map(|leaf| (leaf, true)).collect::<Vec<_>>());
            let cells = tree.cells_at(Moment::Depth(0));
            assert_eq!(cells.map(|(cell, _)| cell.node).collect::<Vec<_>>(), [0]);
        }
    }
}
