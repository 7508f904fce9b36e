//! The 32-byte node of a bounding volume hierarchy.

use super::node::{NodeKind, StopReason};

/// A node with its box, in local coordinates ([`super::Frame`]). Nodes lie in depth-first order: the first
/// child of an inner node directly follows it, and each other child follows the subtree of the one before.
///
/// | | inner node | leaf |
/// |---|---|---|
/// | `end_or_first` | one past the last node of the subtree | index of the first reference |
/// | `word`, bit 0 | 0 | 1 |
/// | `word`, upper bits | number of children | 5 bits [`StopReason`], then the number of references |
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct BoxNode {
    pub(crate) lo: [f32; 3],
    pub(crate) hi: [f32; 3],
    end_or_first: u32,
    word: u32,
}

/// Maximum number of children.
pub const MAX_WIDTH: usize = 8;

const LEAF: u32 = 1;

impl BoxNode {
    /// Creates an inner node with `children` children, whose subtree ends before node `end`.
    pub(super) fn inner([lo, hi]: [[f32; 3]; 2], children: usize, end: u32) -> Self {
        BoxNode {
            lo,
            hi,
            end_or_first: end,
            word: (children as u32) << 1,
        }
    }

    pub(super) fn leaf([lo, hi]: [[f32; 3]; 2], first: u32, count: u32, stop: StopReason) -> Self {
        debug_assert!((count as usize) < super::node::Node::MAX_LEAF);
        BoxNode {
            lo,
            hi,
            end_or_first: first,
            word: count << 6 | (stop as u32) << 1 | LEAF,
        }
    }

    #[inline]
    pub(crate) fn is_leaf(&self) -> bool {
        self.word & LEAF != 0
    }

    /// Returns the first reference and the number of references of a leaf; meaningless for an inner node.
    #[inline]
    pub(crate) fn as_leaf(&self) -> (usize, usize) {
        (self.end_or_first as usize, (self.word >> 6) as usize)
    }

    /// Returns the number of children; meaningless for a leaf.
    #[inline]
    pub(crate) fn child_count(&self) -> usize {
        (self.word >> 1) as usize
    }

    /// Returns one past the last node of the subtree; `index` is the node's own index.
    #[inline]
    pub(crate) fn end(&self, index: u32) -> u32 {
        if self.is_leaf() {
            index + 1
        } else {
            self.end_or_first
        }
    }

    /// Unpacks the node.
    pub(super) fn kind(&self) -> NodeKind {
        if self.is_leaf() {
            NodeKind::Leaf {
                first: self.end_or_first,
                count: self.word >> 6,
                stop: StopReason::ALL[(self.word >> 1 & 31) as usize],
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
    fn a_node_takes_32_bytes_and_unpacks_to_what_was_packed() {
        assert_eq!(size_of::<BoxNode>(), 32);
        let sides = [[-1.0; 3], [0.5, 1.0, 0.25]];
        let inner = BoxNode::inner(sides, 8, u32::MAX);
        assert_eq!((inner.kind(), inner.child_count()), (NodeKind::Inner, 8));
        assert_eq!((inner.end(7), [inner.lo, inner.hi]), (u32::MAX, sides));
        for stop in StopReason::ALL {
            let leaf = BoxNode::leaf(sides, u32::MAX, (1 << 26) - 1, stop);
            let expected = NodeKind::Leaf {
                first: u32::MAX,
                count: (1 << 26) - 1,
                stop,
            };
            assert_eq!((leaf.kind(), leaf.end(7)), (expected, 8));
        }
    }
}
