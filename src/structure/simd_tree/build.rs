//! Builds the tree for SIMD kernels from the nodes of a tree and the objects of its scene.

use super::block::BlockData;
use super::layout::{
    ABOVE_EMPTY, AnyTree, BELOW_EMPTY, BlockTree, ByKind, CHILD_SHIFT, Node, SimdTree,
};
use super::pages::Pages;
use crate::geometry::{Axis, Vec3};
use crate::primitive::{Primitive, PrimitiveKind, Shape, UnitFrame};
use crate::scene::Scene;
use crate::structure::frame::is_inside;
use crate::structure::node;
use crate::structure::nodes::Nodes;
use crate::structure::settings::OverlapRule;
use crate::structure::tree::Tree;

/// Number of nodes that an index has bits for.
const MAX_NODES: usize = 1 << (32 - CHILD_SHIFT);

impl SimdTree {
    /// Returns the prepared tree of this scene. It is built by the first call and kept with the tree.
    pub fn of<'a>(scene: &Scene, tree: &'a Tree) -> &'a SimdTree {
        tree.simd_tree.get_or_init(|| SimdTree::new(scene, tree))
    }

    /// # Panics
    /// If the tree has 2²⁸ nodes or more, which take 2 GiB.
    fn new(scene: &Scene, tree: &Tree) -> SimdTree {
        let objects = scene.objects();
        let frame = UnitFrame::around(&scene.bounds());
        let (half_thickness, corners) = corners_of(tree, objects, &frame);
        let trees = match tree.nodes() {
            Nodes::Planes(nodes) => AnyTree::Planes(by_kind(
                objects,
                || BlockTree::of_planes(tree, nodes, objects, &frame),
                || BlockTree::of_planes(tree, nodes, objects, &frame),
                || BlockTree::of_planes(tree, nodes, objects, &frame),
            )),
            Nodes::Boxes(nodes) => AnyTree::Boxes(by_kind(
                objects,
                || BlockTree::of_boxes(tree, nodes, objects, &frame),
                || BlockTree::of_boxes(tree, nodes, objects, &frame),
                || BlockTree::of_boxes(tree, nodes, objects, &frame),
            )),
        };
        SimdTree {
            frame,
            half_thickness,
            corners,
            tree: trees,
        }
    }
}

/// Builds the tree with the blocks that suit these objects.
fn by_kind<T, S, B>(
    objects: &[Primitive],
    triangles: impl FnOnce() -> T,
    spheres: impl FnOnce() -> S,
    boxes: impl FnOnce() -> B,
) -> ByKind<T, S, B> {
    let all = |kind| !objects.is_empty() && objects.iter().all(|o| o.kind() == kind);
    if all(PrimitiveKind::Triangle) {
        ByKind::Triangles(triangles())
    } else if all(PrimitiveKind::Sphere) {
        ByKind::Spheres(spheres())
    } else {
        ByKind::Boxes(boxes())
    }
}

/// Half the thickness of planes: bound on the distance between a computed hit and the object, in lengths
/// of the unit frame.
///
/// The frame holds the scene from −½ to ½, and rays start at most 2 from its center. The parts are
/// 4 ε · 3 between a hit and the exact object ([`crate::primitive::Form`]), 2½ ε for a direction and
/// 1 ε for an origin in `f32`, 4 ε for the arithmetic of the traversal, and 1 ε for a plane.
const HALF_THICKNESS: f32 = 40.0 * f32::EPSILON;

impl<B: BlockData> BlockTree<Pages<Node>, B> {
    /// Builds the tree of one with planes.
    ///
    /// # Panics
    /// If the tree has more than [`MAX_NODES`] nodes.
    fn of_planes(
        tree: &Tree,
        nodes: &[node::Node],
        objects: &[Primitive],
        frame: &UnitFrame,
    ) -> Self {
        assert!(nodes.len() < MAX_NODES, "a tree of 2 GiB of nodes");
        let blocks = |node: &node::Node| match node.is_leaf() {
            true => node.as_leaf().1.div_ceil(B::PLACES),
            false => 0,
        };
        let mut builder = Builder {
            tree,
            from: nodes,
            objects,
            frame,
            held: Vec::new(),
            nodes: Pages::with_capacity(nodes.len() + 1),
            blocks: Pages::with_capacity(nodes.iter().map(blocks).sum()),
            max_pending: 0,
        };
        // The root has no sibling; its place stays empty.
        builder.reserve_siblings();
        builder.node(0, 0, [[-1.0, 1.0]; 3], 0);
        BlockTree {
            nodes: builder.nodes,
            blocks: builder.blocks,
            max_pending: builder.max_pending,
        }
    }
}

/// Returns half the thickness of planes and faces, and the corners of the scene's box enlarged by it, in the
/// unit frame.
fn corners_of(tree: &Tree, objects: &[Primitive], frame: &UnitFrame) -> (f32, [[f32; 3]; 2]) {
    let bounds = objects
        .iter()
        .map(Shape::bounds)
        .fold(crate::geometry::Aabb::EMPTY, |all, b| all.union(&b));
    let (_, half) = tree.frame().center_and_half();
    // A plane may be half a unit in the last place away from the end of an object that it separates
    // from its neighbor.
    let half_thickness =
        HALF_THICKNESS + 0.5 * f32::EPSILON * (half.max_element() * frame.scale()) as f32;
    let corner = |v: Vec3, away: f32| (frame.point(v).as_vec3() + away).to_array();
    let corners = if bounds.is_empty() {
        [[1.0; 3], [-1.0; 3]]
    } else {
        [
            corner(bounds.lo, -half_thickness),
            corner(bounds.hi, half_thickness),
        ]
    };
    (half_thickness, corners)
}

struct Builder<'a, B> {
    tree: &'a Tree,
    from: &'a [node::Node],
    objects: &'a [Primitive],
    frame: &'a UnitFrame,
    /// Objects of the current leaf.
    held: Vec<u32>,
    nodes: Pages<Node>,
    blocks: Pages<B>,
    /// Maximum number of pending nodes on a ray's stack.
    max_pending: usize,
}

impl<B: BlockData> Builder<'_, B> {
    /// Builds the node `from` of the tree, whose cell is `cell`, at index `to`. `depth` is the number of
    /// inner nodes above it.
    fn node(&mut self, from: usize, to: usize, cell: [[f32; 2]; 3], depth: usize) {
        let node = self.from[from];
        if node.is_leaf() {
            self.nodes[to] = self.leaf(from, cell);
            self.max_pending = self.max_pending.max(depth);
            return;
        }
        let (axis, plane, above) = node.as_inner();
        let first = self.reserve_siblings();
        let (mut lower, mut upper) = (cell, cell);
        lower[axis][1] = plane;
        upper[axis][0] = plane;
        self.node(from + 1, first, lower, depth + 1);
        self.node(above as usize, first + 1, upper, depth + 1);
        let mut word = (first as u32) << CHILD_SHIFT | axis as u32;
        for (child, flag) in [(first, BELOW_EMPTY), (first + 1, ABOVE_EMPTY)] {
            if self.nodes[child].is_empty_leaf() {
                word |= flag;
            }
        }
        self.nodes[to] = Node {
            payload: self.plane(axis, plane).to_bits(),
            word,
        };
    }

    /// Appends two adjacent nodes and returns the index of the first.
    fn reserve_siblings(&mut self) -> usize {
        let nodes = &mut self.nodes;
        nodes.push(Node::default());
        nodes.push(Node::default());
        nodes.len() - 2
    }

    /// Returns a plane in the coordinates of the unit frame. There the scene lies within ±½, so planes
    /// outside ±1 may as well be at ±1.
    fn plane(&self, axis: usize, plane: f32) -> f32 {
        let world = self
            .tree
            .frame()
            .to_world(Axis::from_index(axis), f64::from(plane));
        (self.frame.point(Vec3::splat(world))[axis] as f32).clamp(-1.0, 1.0)
    }

    fn leaf(&mut self, from: usize, cell: [[f32; 2]; 3]) -> Node {
        let (first, count) = self.from[from].as_leaf();
        let references = &self.tree.references()[first..first + count];
        let mut held = std::mem::take(&mut self.held);
        held.clear();
        held.extend(references.iter().filter(|&&o| self.is_held(o, &cell)));
        let first = self.blocks.len();
        B::append(&mut self.blocks, &held, self.objects, self.frame);
        self.held = held;
        Node::leaf(first, self.blocks.len() - first)
    }

    /// Returns whether a leaf must hold an object that it has a reference to.
    ///
    /// It need not hold an object that only touches the cell from outside: the neighbor holds it, and
    /// planes are thick enough that rays near the object visit both. That the neighbor holds it is only
    /// certain where objects are assigned to cells by their bounds.
    fn is_held(&self, object: u32, cell: &[[f32; 2]; 3]) -> bool {
        let primitive = &self.objects[object as usize];
        let settings = self.tree.settings();
        let by_bounds = match settings.overlap {
            // A file can have assigned them in any way.
            _ if settings.method.is_file() => false,
            OverlapRule::Bounds => true,
            OverlapRule::Exact => false,
            OverlapRule::Paper => {
                primitive.kind() != PrimitiveKind::Sphere || !settings.method.paper_spheres_exactly
            }
        };
        !by_bounds || is_inside(&self.tree.frame().planes_around(&primitive.bounds()), cell)
    }
}
