//! The binary hierarchy that builders make, before it is laid out.

use crate::geometry::Aabb;
use crate::structure::node::StopReason;

/// What a node holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Content {
    /// Indices of the two children.
    Children([u32; 2]),
    /// References `first..first + count`.
    Leaf {
        first: u32,
        count: u32,
        stop: StopReason,
    },
}

/// A node with its box in world coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BinaryNode {
    pub bounds: Aabb,
    pub content: Content,
}

/// Nodes in any order, and the references of leaves.
#[derive(Clone, Debug, Default)]
pub struct Binary {
    pub nodes: Vec<BinaryNode>,
    pub references: Vec<u32>,
    pub root: u32,
}

impl Binary {
    /// Adds a leaf and returns its index.
    pub fn leaf(
        &mut self,
        bounds: Aabb,
        objects: impl IntoIterator<Item = u32>,
        stop: StopReason,
    ) -> u32 {
        let first = self.references.len() as u32;
        self.references.extend(objects);
        // Two parts of one object may end in the same leaf.
        self.references[first as usize..].sort_unstable();
        let count = dedup_from(&mut self.references, first as usize);
        let content = Content::Leaf { first, count, stop };
        self.push(BinaryNode { bounds, content })
    }

    /// Adds an inner node around two others and returns its index.
    pub fn inner(&mut self, children: [u32; 2]) -> u32 {
        let [a, b] = children.map(|child| self.nodes[child as usize].bounds);
        let content = Content::Children(children);
        let bounds = a.union(&b);
        self.push(BinaryNode { bounds, content })
    }

    /// Appends a hierarchy that was built separately and returns the index of its root.
    pub fn append(&mut self, other: Binary) -> u32 {
        let (nodes, references) = (self.nodes.len() as u32, self.references.len() as u32);
        self.nodes.extend(other.nodes.into_iter().map(|mut node| {
            match &mut node.content {
                Content::Children(children) => children.iter_mut().for_each(|c| *c += nodes),
                Content::Leaf { first, .. } => *first += references,
            }
            node
        }));
        self.references.extend(other.references);
        nodes + other.root
    }

    fn push(&mut self, node: BinaryNode) -> u32 {
        self.nodes.push(node);
        self.root = self.nodes.len() as u32 - 1;
        self.root
    }
}

/// Removes equal neighbors from index `first` on, and returns how many numbers are left there.
fn dedup_from(numbers: &mut Vec<u32>, first: usize) -> u32 {
    let mut kept = first;
    for i in first..numbers.len() {
        if i == first || numbers[i] != numbers[kept - 1] {
            numbers[kept] = numbers[i];
            kept += 1;
        }
    }
    numbers.truncate(kept);
    (kept - first) as u32
}
