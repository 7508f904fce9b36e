//! Builds the tree for SIMD kernels of a bounding volume hierarchy.

use super::block::BlockData;
use super::layout::BlockTree;
use super::pages::Pages;
use super::wide::{Child, WideNode, WideNodes};
use crate::primitive::{Primitive, UnitFrame};
use crate::structure::box_node::{BoxNode, MAX_WIDTH};
use crate::structure::tree::Tree;

impl<B: BlockData> BlockTree<WideNodes, B> {
    /// Builds the tree of a hierarchy.
    pub(super) fn of_boxes(
        tree: &Tree,
        nodes: &[BoxNode],
        objects: &[Primitive],
        frame: &UnitFrame,
    ) -> Self {
        let leaf_blocks = |node: &BoxNode| match node.is_leaf() {
            true => node.as_leaf().1.div_ceil(B::PLACES),
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
            nodes: WideNodes {
                nodes: wide,
                large_leaves,
            },
            blocks,
            max_pending: (tree.depth_reached() as usize + 1) * (MAX_WIDTH - 1) + 1,
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
        let (first, blocks) = (self.blocks.len(), held.len().div_ceil(B::PLACES));
        let child = Child::leaf(first, blocks);
        self.wide[to].children[place] = child;
        if child.blocks() == 0 {
            self.large_leaves.push((first as u32, blocks as u32));
        }
        B::append(&mut self.blocks, held, self.objects, self.frame);
    }

    /// Sets the box of a child. It is as accurate as `f32`, which the thickness of faces covers.
    fn set_box(&mut self, to: usize, place: usize, child: u32) {
        let bounds = self.tree.box_of(&self.nodes[child as usize]);
        for (side, corner) in [bounds.lo, bounds.hi].into_iter().enumerate() {
            let corner = self.frame.point(corner).as_vec3();
            for (k, faces) in self.wide[to].faces.iter_mut().enumerate() {
                faces[side][place] = corner[k];
            }
        }
    }
}
