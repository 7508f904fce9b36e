//! A tree made ready for lanes: children side by side, planes in the coordinates in which rays are
//! traced, leaves in blocks.

use super::block::{BLOCK, Block};
use super::pages::Pages;
use crate::geometry::{Axis, Vec3};
use crate::primitive::{Primitive, PrimitiveKind, Shape, UnitFrame};
use crate::structure::{self, OverlapRule, Tree, is_inside};

/// A node in 8 bytes.
///
/// Word, lowest two bits: the axis of an inner node, or 3 for a leaf. An inner node has two more bits
/// that say whether its lower and its upper child are empty leaves, and above them the place of its
/// lower child; the upper one follows it. A leaf has the number of its blocks. Payload: the plane, or
/// the place of the leaf's first block.
#[derive(Clone, Copy, Default)]
#[repr(C)]
pub(super) struct Node {
    pub(super) payload: u32,
    pub(super) word: u32,
}

pub(super) const LEAF: u32 = 3;
pub(super) const BELOW_EMPTY: u32 = 4;
pub(super) const ABOVE_EMPTY: u32 = 8;
/// Bits of an inner node's word below the place of its children.
pub(super) const PLACE: u32 = 4;

impl Node {
    fn leaf(first: usize, blocks: usize) -> Node {
        Node {
            payload: first as u32,
            word: (blocks as u32) << 2 | LEAF,
        }
    }

    fn is_empty_leaf(self) -> bool {
        self.word == LEAF
    }
}

/// The most nodes that their places have bits for.
const MOST_NODES: usize = 1 << (32 - PLACE);

/// A tree ready for lanes, with objects of one form.
pub(super) struct Prepared<B> {
    pub(super) nodes: Pages<Node>,
    pub(super) blocks: Pages<B>,
    /// The most nodes that can wait on a ray's stack.
    pub(super) most_waiting: usize,
    /// Half the thickness of every plane and face.
    pub(super) thick: f32,
    /// Lower and upper corner of the scene, thickness included; the root cell of rays.
    pub(super) corners: [[f32; 3]; 2],
}

/// What the distance between a ray and an object found on it may be off by, in the frame's lengths.
/// The frame holds the scene from −½ to ½, and rays begin at most 2 from its centre:
/// 4 ε · 3 between a hit and the true object ([`crate::primitive::Form`]), 2½ ε for a direction and
/// 1 ε for an origin in `f32`, 4 ε for the walk's own arithmetic, 1 ε for a plane.
const THICKNESS: f32 = 40.0 * f32::EPSILON;

impl<B: Block> Prepared<B> {
    /// # Panics
    /// If the tree has more nodes than places have bits for.
    pub(super) fn new(tree: &Tree, objects: &[Primitive], frame: &UnitFrame) -> Self {
        assert!(tree.nodes().len() < MOST_NODES, "a tree of 2 GiB of nodes");
        let bounds = objects
            .iter()
            .map(Shape::bounds)
            .fold(crate::geometry::Aabb::EMPTY, |all, b| all.union(&b));
        let (_, half) = tree.frame().center_and_half();
        // A plane may be half a unit in the last place from the end of an object that it parts from
        // its neighbour.
        let thick = THICKNESS + 0.5 * f32::EPSILON * (half.max_element() * frame.scale()) as f32;
        let corner = |v: Vec3, away: f32| (frame.point(v).as_vec3() + away).to_array();
        let corners = if bounds.is_empty() {
            [[1.0; 3], [-1.0; 3]]
        } else {
            [corner(bounds.lo, -thick), corner(bounds.hi, thick)]
        };
        let blocks = |node: &structure::Node| match node.is_leaf() {
            true => node.as_leaf().1.div_ceil(BLOCK),
            false => 0,
        };
        let mut maker = Maker {
            tree,
            objects,
            frame,
            held: Vec::new(),
            made: Prepared {
                nodes: Pages::with_room(tree.nodes().len() + 1),
                blocks: Pages::with_room(tree.nodes().iter().map(blocks).sum()),
                most_waiting: 0,
                thick,
                corners,
            },
        };
        // The root, and none beside it.
        maker.two_nodes();
        maker.node(0, 0, [[-1.0, 1.0]; 3], 0);
        maker.made
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.blocks)
    }
}

struct Maker<'a, B> {
    tree: &'a Tree,
    objects: &'a [Primitive],
    frame: &'a UnitFrame,
    /// Objects of the leaf in work.
    held: Vec<u32>,
    made: Prepared<B>,
}

impl<B: Block> Maker<'_, B> {
    /// Makes the node `from` of the tree, whose cell is `cell`, at the place `to`, below `waiting`
    /// inner nodes.
    fn node(&mut self, from: usize, to: usize, cell: [[f32; 2]; 3], waiting: usize) {
        let node = self.tree.nodes()[from];
        if node.is_leaf() {
            self.made.nodes[to] = self.leaf(from, cell);
            self.made.most_waiting = self.made.most_waiting.max(waiting);
            return;
        }
        let (axis, plane, above) = node.as_inner();
        let place = self.two_nodes();
        let (mut lower, mut upper) = (cell, cell);
        lower[axis][1] = plane;
        upper[axis][0] = plane;
        self.node(from + 1, place, lower, waiting + 1);
        self.node(above as usize, place + 1, upper, waiting + 1);
        let mut word = (place as u32) << PLACE | axis as u32;
        for (child, flag) in [(place, BELOW_EMPTY), (place + 1, ABOVE_EMPTY)] {
            if self.made.nodes[child].is_empty_leaf() {
                word |= flag;
            }
        }
        self.made.nodes[to] = Node {
            payload: self.plane(axis, plane).to_bits(),
            word,
        };
    }

    /// Room for two nodes side by side; gives the place of the first.
    fn two_nodes(&mut self) -> usize {
        let nodes = &mut self.made.nodes;
        nodes.push(Node::default());
        nodes.push(Node::default());
        nodes.len() - 2
    }

    /// A plane in the frame's coordinates. None of the scene is beyond ±½ there, so that planes
    /// outside ±1 part as well at ±1.
    fn plane(&self, axis: usize, plane: f32) -> f32 {
        let world = self
            .tree
            .frame()
            .to_world(Axis::from_index(axis), f64::from(plane));
        (self.frame.point(Vec3::splat(world))[axis] as f32).clamp(-1.0, 1.0)
    }

    fn leaf(&mut self, from: usize, cell: [[f32; 2]; 3]) -> Node {
        let (first, count) = self.tree.nodes()[from].as_leaf();
        let references = &self.tree.references()[first..first + count];
        let mut held = std::mem::take(&mut self.held);
        held.clear();
        held.extend(references.iter().filter(|&&o| self.is_held(o, &cell)));
        let first = self.made.blocks.len();
        for objects in held.chunks(BLOCK) {
            let mut block = B::default();
            for (lane, &object) in objects.iter().enumerate() {
                block.set(lane, object, &self.objects[object as usize], self.frame);
            }
            self.made.blocks.push(block);
        }
        self.held = held;
        Node::leaf(first, self.made.blocks.len() - first)
    }

    /// Whether a leaf that refers to an object must hold it. If it only touches the cell from outside
    /// the neighbour holds it, and planes are thick enough for both to be visited. That the neighbour
    /// does is certain where objects belong to cells by their bounds.
    fn is_held(&self, object: u32, cell: &[[f32; 2]; 3]) -> bool {
        let primitive = &self.objects[object as usize];
        let settings = self.tree.settings();
        let by_bounds = match settings.overlap {
            OverlapRule::Bounds => true,
            OverlapRule::Exact => false,
            OverlapRule::Paper => {
                primitive.kind() != PrimitiveKind::Sphere || !settings.method.paper_spheres_exactly
            }
        };
        !by_bounds || is_inside(&self.tree.frame().planes_around(&primitive.bounds()), cell)
    }
}
