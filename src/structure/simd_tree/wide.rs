//! Nodes of a bounding volume hierarchy for SIMD kernels: the boxes of eight children as columns.

use super::pages::Pages;
use crate::structure::box_node::MAX_WIDTH;

/// An inner node in four cache lines. A place without a child has a box that no ray meets.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// By axis, the lower and the upper faces of the children's boxes, in the coordinates of the unit frame.
    pub(crate) faces: [[[f32; MAX_WIDTH]; 2]; 3],
    pub(crate) children: [Child; MAX_WIDTH],
}

const _: () = assert!(size_of::<WideNode>() == 256);

/// A child of a node, in a word.
///
/// | | inner node | leaf |
/// |---|---|---|
/// | bit 0 | 0 | 1 |
/// | bits 1 to 4 | 0 | number of blocks; 0 if there are more than 14 |
/// | other bits | index of the node | index of the first block |
#[derive(Clone, Copy, Default, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct Child(u32);

impl Child {
    /// Marks the bottom of a stack: a leaf that does not exist.
    pub(crate) const END: Child = Child(15 << 1 | 1);

    const BITS: u32 = 5;
    const MOST_BLOCKS: usize = 14;

    pub(super) fn node(index: usize) -> Child {
        assert!(index < 1 << (32 - Self::BITS), "a tree of 32 GiB of nodes");
        Child((index as u32) << Self::BITS)
    }

    pub(super) fn leaf(first: usize, blocks: usize) -> Child {
        assert!(
            first < (1 << (32 - Self::BITS)) - 1,
            "a tree of 2³¹ objects"
        );
        let few = if blocks > Self::MOST_BLOCKS {
            0
        } else {
            blocks
        };
        Child((first as u32) << Self::BITS | (few as u32) << 1 | 1)
    }

    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & 1 != 0
    }

    /// Returns the index of the node, or of the first block.
    #[inline(always)]
    pub(crate) fn index(self) -> usize {
        (self.0 >> Self::BITS) as usize
    }

    /// Returns the number of a leaf's blocks; 0 if there are many.
    #[inline(always)]
    pub(crate) fn blocks(self) -> usize {
        (self.0 >> 1 & 15) as usize
    }
}

/// The nodes of a hierarchy.
pub(crate) struct WideNodes {
    pub(crate) nodes: Pages<WideNode>,
    /// First block and number of blocks of each leaf whose [`Child`] does not say how many it has, ascending.
    pub(super) large_leaves: Vec<(u32, u32)>,
}

impl WideNodes {
    /// Returns the number of blocks of a leaf.
    #[inline(always)]
    pub(crate) fn blocks(&self, leaf: Child) -> usize {
        match leaf.blocks() {
            0 => self.many_blocks(leaf),
            blocks => blocks,
        }
    }

    #[cold]
    fn many_blocks(&self, leaf: Child) -> usize {
        let first = leaf.index() as u32;
        let found = self
            .large_leaves
            .binary_search_by_key(&first, |leaf| leaf.0);
        found.map_or(0, |k| self.large_leaves[k].1 as usize)
    }
}

impl WideNode {
    pub(super) const EMPTY: WideNode = WideNode {
        faces: [[[f32::INFINITY; MAX_WIDTH], [f32::NEG_INFINITY; MAX_WIDTH]]; 3],
        children: [Child::END; MAX_WIDTH],
    };
}
