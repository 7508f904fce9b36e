//! Nodes of a bounding volume hierarchy for SIMD kernels: the boxes of eight children as columns.

use super::block::{BLOCK, BlockData};
use super::build::corners_of;
use super::layout::{BlockTree, SimdNodes};
use super::pages::Pages;
use crate::primitive::{Primitive, UnitFrame};
use crate::structure::box_node::{BoxNode, MAX_WIDTH};
use crate::structure::tree::Tree;

/// An inner node in four cache lines. A place without a child has a box that no ray meets.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct WideNode {
    /// Lower and upper corners of the children, by axis, in the coordinates of the unit frame.
    pub(crate) corners: [[[f32; MAX_WIDTH]; 3]; 2],
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

    fn node(index: usize) -> Child {
        assert!(index < 1 << (32 - Self::BITS), "a tree of 32 GiB of nodes");
        Child((index as u32) << Self::BITS)
    }

    fn leaf(first: usize, blocks: usize) -> Child {
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
    large_leaves: Vec<(u32, u32)>,
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
    const EMPTY: WideNode = WideNode {
        corners: [
            [[f32::INFINITY; MAX_WIDTH]; 3],
            [[f32::NEG_INFINITY; MAX_WIDTH]; 3],
        ],
        children: [Child::END; MAX_WIDTH],
    };
}

impl<B: BlockData> BlockTree<B> {
    /// Builds the tree of a hierarchy.
    pub(super) fn of_boxes(
        tree: &Tree,
        nodes: &[BoxNode],
        objects: &[Primitive],
        frame: &UnitFrame,
    ) -> Self {
        let (half_thickness, corners) = corners_of(tree, objects, frame);
        let leaf_blocks = |node: &BoxNode| match node.is_leaf() {
            true => node.as_leaf().1.div_ceil(BLOCK),
            false => 0,
        };
        let inner_count = nodes.iter().filter(|node| !node.is_leaf()).count();
        let mut builder = Builder {
            tree,
            nodes,
            objects,
            frame,
            wide: Pages::with_capacity(inner_count.max(1)),
            blocks: Pages::with_capacity(nodes.iter().map(leaf_blocks).sum()),
            large_leaves: Vec::new(),
        };
        // A root that is a leaf becomes the only child of an inner node.
        builder.wide.push(WideNode::EMPTY);
        if nodes[0].is_leaf() {
            builder.set_leaf(0, 0, 0);
        } else {
            builder.build();
        }
        let Builder {
            wide,
            blocks,
            large_leaves,
            ..
        } = builder;
        BlockTree {
            nodes: SimdNodes::Boxes(WideNodes {
                nodes: wide,
                large_leaves,
            }),
            blocks,
            max_pending: (tree.depth_reached() as usize + 1) * (MAX_WIDTH - 1) + 1,
            half_thickness,
            corners,
        }
    }
}

struct Builder<'a, B> {
    tree: &'a Tree,
    nodes: &'a [BoxNode],
    objects: &'a [Primitive],
    frame: &'a UnitFrame,
    wide: Pages<WideNode>,
    blocks: Pages<B>,
    large_leaves: Vec<(u32, u32)>,
}

impl<B: BlockData> Builder<'_, B> {
    /// Builds the nodes below the root, depth first.
    fn build(&mut self) {
        // Inner nodes of the tree with their indices here.
        let mut stack = vec![(0, 0)];
        while let Some((from, to)) = stack.pop() {
            let first = stack.len();
            for (place, child) in self.tree.child_nodes(from).enumerate() {
                if self.nodes[child as usize].is_leaf() {
                    self.set_leaf(to, place, child);
                } else {
                    self.set_box(to, place, child);
                    self.wide[to].children[place] = Child::node(self.wide.len());
                    stack.push((child, self.wide.len()));
                    self.wide.push(WideNode::EMPTY);
                }
            }
            stack[first..].reverse();
        }
    }

    /// Makes a node of the tree, a leaf, the child of a node in a place.
    fn set_leaf(&mut self, to: usize, place: usize, leaf: u32) {
        let held = self.tree.leaf_objects(leaf);
        if held.is_empty() {
            return;
        }
        self.set_box(to, place, leaf);
        let (first, blocks) = (self.blocks.len(), held.len().div_ceil(BLOCK));
        self.wide[to].children[place] = Child::leaf(first, blocks);
        if Child::leaf(first, blocks).blocks() == 0 {
            self.large_leaves.push((first as u32, blocks as u32));
        }
        for objects in held.chunks(BLOCK) {
            let mut block = B::default();
            for (place, &object) in objects.iter().enumerate() {
                block.set(place, object, &self.objects[object as usize], self.frame);
            }
            self.blocks.push(block);
        }
    }

    /// Sets the box of a child. It is as accurate as `f32`, which the thickness of faces covers.
    fn set_box(&mut self, to: usize, place: usize, child: u32) {
        let bounds = self.tree.box_of(&self.nodes[child as usize]);
        for (corner, columns) in [bounds.lo, bounds.hi]
            .into_iter()
            .zip(&mut self.wide[to].corners)
        {
            let corner = self.frame.point(corner).as_vec3();
            for k in 0..3 {
                columns[k][place] = corner[k];
            }
        }
    }
}
