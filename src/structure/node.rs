//! The 8-byte node.

use crate::geometry::Axis;

/// A node in 8 bytes that divides its cell by a plane. Read it through [`Node::kind`].
///
/// | | inner node | leaf |
/// |---|---|---|
/// | word 0, bits 0–1 | axis | 3 |
/// | word 0, upper bits | index of the upper child (the lower child follows the node) | 4 bits [`StopReason`], then the number of references |
/// | word 1 | plane in local coordinates ([`super::Frame`]), `f32` | index of the first reference |
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Node {
    word: u32,
    payload: u32,
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeKind {
    /// It has children ([`super::Tree::child_nodes`]).
    Inner,
    Leaf {
        /// Index of the first reference.
        first: u32,
        /// Number of references; 0 for an empty leaf.
        count: u32,
        stop: StopReason,
    },
}

/// Why a cell became a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// It contains no object.
    Empty,
    /// It is an empty slab that was cut out between objects.
    CutOut,
    /// It contains at most `N_OILF` objects.
    FewObjects,
    /// It is at depth `D_MAX`.
    MaxDepth,
    /// Every split has a higher expected cost than the leaf.
    LeafIsCheaper,
    /// The method found no candidate plane.
    NoCandidate,
    /// The plane would not divide the cell: the cell is as thin as the resolution of planes.
    TooThin,
    /// The method never splits.
    NotSplit,
    /// It is a voxel of a grid and contains an object.
    Voxel,
    /// The centers of its objects coincide.
    CentersCoincide,
    /// Its nodes were replaced by a leaf, which is cheaper.
    Collapsed,
    /// It is a leaf in the file that the tree was read from.
    InFile,
}

impl StopReason {
    pub const ALL: [StopReason; 12] = [
        StopReason::Empty,
        StopReason::CutOut,
        StopReason::FewObjects,
        StopReason::MaxDepth,
        StopReason::LeafIsCheaper,
        StopReason::NoCandidate,
        StopReason::TooThin,
        StopReason::NotSplit,
        StopReason::Voxel,
        StopReason::CentersCoincide,
        StopReason::Collapsed,
        StopReason::InFile,
    ];

    /// Returns a short phrase for users.
    pub const fn text(self) -> &'static str {
        match self {
            StopReason::Empty => "empty",
            StopReason::CutOut => "empty slab, cut out",
            StopReason::FewObjects => "few enough objects (N_OILF)",
            StopReason::MaxDepth => "depth D_MAX reached",
            StopReason::LeafIsCheaper => "no split would pay off (SAH)",
            StopReason::NoCandidate => "no plane to split at",
            StopReason::TooThin => "too thin to split",
            StopReason::NotSplit => "the method does not split",
            StopReason::Voxel => "a voxel of the grid",
            StopReason::CentersCoincide => "the centers of its objects coincide",
            StopReason::Collapsed => "a leaf is cheaper than its nodes (SAH)",
            StopReason::InFile => "a leaf in the file",
        }
    }
}

const LEAF: u32 = 3;

impl Node {
    /// Maximum number of nodes, and of references per leaf.
    pub(super) const MAX_NODES: usize = 1 << 30;
    pub(super) const MAX_LEAF: usize = 1 << 26;

    pub(super) fn inner(axis: Axis, plane: f32, above: u32) -> Self {
        debug_assert!((above as usize) < Self::MAX_NODES);
        Node {
            word: above << 2 | axis as u32,
            payload: plane.to_bits(),
        }
    }

    pub(super) fn leaf(first: u32, count: u32, stop: StopReason) -> Self {
        debug_assert!((count as usize) < Self::MAX_LEAF);
        Node {
            word: count << 6 | (stop as u32) << 2 | LEAF,
            payload: first,
        }
    }

    /// Returns the node with its indices moved by the given numbers of nodes and references, to
    /// append its subtree to another.
    pub(super) fn moved(self, nodes: u32, references: u32) -> Self {
        if self.is_leaf() {
            Node {
                payload: self.payload + references,
                ..self
            }
        } else {
            debug_assert!(((self.word >> 2) + nodes) < Self::MAX_NODES as u32);
            Node {
                word: self.word + (nodes << 2),
                ..self
            }
        }
    }

    #[inline]
    pub(crate) fn is_leaf(self) -> bool {
        self.word & 3 == LEAF
    }

    /// Returns axis (0 to 2), plane and upper child of an inner node; meaningless for a leaf.
    #[inline]
    pub(crate) fn as_inner(self) -> (usize, f32, u32) {
        (
            (self.word & 3) as usize,
            f32::from_bits(self.payload),
            self.word >> 2,
        )
    }

    /// Returns the first reference and the number of references of a leaf; meaningless for an inner
    /// node.
    #[inline]
    pub(crate) fn as_leaf(self) -> (usize, usize) {
        (self.payload as usize, (self.word >> 6) as usize)
    }

    /// Unpacks the node.
    pub fn kind(self) -> NodeKind {
        if self.is_leaf() {
            NodeKind::Leaf {
                first: self.payload,
                count: self.word >> 6,
                stop: StopReason::ALL[(self.word >> 2 & 15) as usize],
            }
        } else {
            NodeKind::Inner
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_takes_eight_bytes_and_unpacks_to_what_was_packed() {
        assert_eq!(size_of::<Node>(), 8);
        for axis in Axis::ALL {
            let node = Node::inner(axis, -0.3, (1 << 30) - 1);
            assert_eq!(node.kind(), NodeKind::Inner);
            assert_eq!(node.as_inner(), (axis.index(), -0.3, (1 << 30) - 1));
        }
        for stop in StopReason::ALL {
            let node = Node::leaf(u32::MAX, (1 << 26) - 1, stop);
            let expected = NodeKind::Leaf {
                first: u32::MAX,
                count: (1 << 26) - 1,
                stop,
            };
            assert_eq!(node.kind(), expected);
        }
    }
}
