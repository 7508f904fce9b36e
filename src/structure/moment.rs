//! The state of a tree at a moment of its build. It is derived from the finished tree, because
//! nodes were decided in array order, depth first.

use super::node::NodeKind;
use super::tree::{CellOfNode, Tree};
use serde::{Deserialize, Serialize};

/// A moment of the build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Moment {
    /// All cells above this depth are decided, as if the tree had been built level by level, and so
    /// are the leaves at this depth.
    Depth(u32),
    /// All nodes before this one are decided; this one is next.
    Node(u32),
}

impl Tree {
    /// Returns whether a node of this depth was already a leaf or split at this moment. If it was
    /// not, but all its ancestors were split, it was an undecided cell.
    pub fn is_decided(&self, node: u32, depth: u32, moment: Moment) -> bool {
        match moment {
            Moment::Depth(limit) => {
                depth < limit || depth == limit && matches!(self.kind(node), NodeKind::Leaf { .. })
            }
            Moment::Node(next) => node < next,
        }
    }

    /// Returns the cells into which the root cell was divided at this moment, in array order, and
    /// whether each was already decided to be a leaf.
    /// Boxes of a hierarchy may overlap, and need not fill the root; every object is in the subtree of one of them.
    pub fn cells_at(&self, moment: Moment) -> impl Iterator<Item = (CellOfNode, bool)> + '_ {
        self.cells_below(self.root(), moment)
    }

    /// As [`Tree::cells_at`], but only the cells into which this one was divided.
    pub fn cells_below(
        &self,
        cell: CellOfNode,
        moment: Moment,
    ) -> impl Iterator<Item = (CellOfNode, bool)> + '_ {
        let mut stack = vec![cell];
        std::iter::from_fn(move || {
            loop {
                let cell = stack.pop()?;
                let decided = self.is_decided(cell.node, cell.depth, moment);
                if !decided || matches!(self.kind(cell.node), NodeKind::Leaf { .. }) {
                    return Some((cell, decided));
                }
                let from = stack.len();
                stack.extend(self.children(&cell));
                stack[from..].reverse();
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::Shape;
    use crate::structure::index::TreeIndex;
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

    /// Boxes overlap and leave space free, but every object is in the subtree of one.
    #[test]
    fn boxes_of_every_moment_hold_all_objects() {
        let (scene, tree) = small("balls:2", "bvh-sweep");
        let objects = scene.objects().len();
        let index = TreeIndex::new(&tree, objects);
        let nodes = tree.nodes().len() as u32;
        let depths = (0..=tree.depth_reached()).map(Moment::Depth);
        for moment in depths.chain((0..=nodes).map(Moment::Node)) {
            let cells: Vec<_> = tree.cells_at(moment).map(|(cell, _)| cell).collect();
            let held: u32 = cells.iter().map(|cell| index.of(cell.node).objects).sum();
            assert_eq!(held as usize, objects, "{moment:?}");
            for cell in cells {
                let below = tree.references_below(cell.node, index.of(cell.node).end);
                for &object in &tree.references()[below] {
                    let bounds = scene.objects()[object as usize].bounds();
                    let within = cell.bounds.union(&bounds);
                    assert_eq!((within.lo, within.hi), (cell.bounds.lo, cell.bounds.hi));
                }
            }
        }
    }

    #[test]
    fn the_cells_below_a_node_are_those_of_its_subtree() {
        for method in ["sah-cut", "bvh-sweep"] {
            let (_, tree) = small("balls:1", method);
            for cell in tree.cells() {
                let end = tree.end_of(cell.node);
                let all = Moment::Depth(u32::MAX);
                let below = tree.cells_below(cell, all).map(|(cell, _)| cell.node);
                let leaves = tree.cells_at(all).map(|(cell, _)| cell.node);
                let expected = leaves.filter(|leaf| (cell.node..end).contains(leaf));
                assert_eq!(below.collect::<Vec<_>>(), expected.collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn every_step_decides_one_node() {
        for method in ["sah-cut", "bvh-sweep"] {
            every_step_decides_one(method);
        }
    }

    fn every_step_decides_one(method: &str) {
        let (_, tree) = small("balls:1", method);
        let nodes = tree.nodes().len() as u32;
        let open = |next| {
            let cells = tree.cells_at(Moment::Node(next));
            let open = cells.filter(|(_, decided)| !decided);
            open.map(|(cell, _)| cell.node).collect::<Vec<_>>()
        };
        assert_eq!(open(0), [0]);
        for next in 0..nodes {
            // The build continues with the first undecided cell.
            assert_eq!(open(next)[0], next);
            let mut expected = open(next);
            expected.remove(0);
            expected.splice(0..0, tree.child_nodes(next));
            assert_eq!(open(next + 1), expected);
        }
        assert!(open(nodes).is_empty());
    }

    #[test]
    fn the_last_depth_shows_the_finished_tree() {
        for method in ["midpoint", "sah-cut", "none", "bvh-sweep"] {
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
