//! The nodes of a hierarchy from those of a file.

use super::error::TreeFileError;
use super::faults::{FaultKind, Faults};
use super::graph::{Graph, Placed, check_now_and_then};
use crate::geometry::{Aabb, Axis, Vec3};
use crate::primitive::{Primitive, Shape};
use crate::progress::Progress;
use crate::structure::box_node::BoxNode;
use crate::structure::bvh::{close, sides};
use crate::structure::frame::Frame;

/// The boxes of a file.
pub struct Boxes<'a> {
    /// For each node of the file.
    pub boxes: Vec<[f64; 6]>,
    /// Whether they were rounded to `f32`.
    pub rounded: bool,
    /// Whether leaves hold parts of objects.
    pub split: bool,
    pub objects: &'a [Primitive],
    pub frame: &'a Frame,
}

/// Lower and upper corner in local coordinates.
type Sides = [[f32; 3]; 2];

/// A box around nothing.
const NOTHING: Sides = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];

/// The largest error of a number that was rounded to `f32`, relative to it.
const ROUNDING: f64 = f32::EPSILON as f64;

impl Boxes<'_> {
    fn of(&self, node: u32) -> Aabb {
        let [a, b, c, d, e, f] = self.boxes[node as usize];
        Aabb::new(Vec3::new(a, b, c), Vec3::new(d, e, f))
    }

    /// Returns the nodes in depth-first order with their references, and counts what is wrong with boxes.
    ///
    /// # Errors
    /// Cancellation.
    pub fn lay_out(
        &self,
        graph: &Graph<'_>,
        order: &[Placed],
        faults: &mut Faults,
        progress: &Progress,
    ) -> Result<(Vec<BoxNode>, Vec<u32>), TreeFileError> {
        let (mut nodes, mut references) = (Vec::with_capacity(order.len()), Vec::new());
        let mut covered = vec![Aabb::EMPTY; self.objects.len()];
        for (i, placed) in order.iter().enumerate() {
            check_now_and_then(i, progress)?;
            let node = placed.node;
            self.check_box(graph, order, placed, faults);
            if !graph.is_leaf(node) {
                nodes.push(BoxNode::inner(NOTHING, graph.children(node).len(), 0));
                continue;
            }
            let first = references.len();
            let count = graph.copy_objects(node, &mut references, faults);
            let held = &references[first..];
            for &object in held {
                let covered = &mut covered[object as usize];
                *covered = covered.union(&self.of(node));
            }
            let sides = self.sides_of_leaf(node, held);
            nodes.push(BoxNode::leaf(sides, first as u32, count, graph.stop(node)));
        }
        self.check_cover(&covered, faults);
        let parents: Vec<u32> = order.iter().map(|placed| placed.parent).collect();
        close(&mut nodes, &parents);
        enclose(&mut nodes, &parents);
        Ok((nodes, references))
    }

    /// Returns the box of a leaf; [`NOTHING`] for a leaf without objects.
    fn sides_of_leaf(&self, node: u32, held: &[u32]) -> Sides {
        if held.is_empty() {
            return NOTHING;
        }
        // Nothing is outside the root cell, and infinite boxes are of no use.
        let within = |corners: Sides| corners.map(|corner| corner.map(|c| c.clamp(-2.0, 2.0)));
        let given = self.of(node);
        match (self.split, self.rounded) {
            (false, _) => {
                let bounds = held
                    .iter()
                    .map(|&object| self.objects[object as usize].bounds());
                let all = bounds.fold(Aabb::EMPTY, |all, bounds| all.union(&bounds));
                sides(self.frame, &all)
            }
            (true, true) => {
                let lo = given.lo - given.lo.abs() * ROUNDING;
                let hi = given.hi + given.hi.abs() * ROUNDING;
                within(sides(self.frame, &Aabb::new(lo, hi)))
            }
            (true, false) => within(self.nearest(&given)),
        }
    }

    /// Returns the smallest box around one in world coordinates, without any margin.
    fn nearest(&self, given: &Aabb) -> Sides {
        let is_at =
            |k: usize, plane: f32| self.frame.to_world(Axis::from_index(k), f64::from(plane));
        let nearest = |k: usize, world: f64| self.frame.nearest_plane(Axis::from_index(k), world);
        let wide = sides(self.frame, given);
        let mut found = [
            std::array::from_fn(|k| nearest(k, given.lo[k])),
            std::array::from_fn(|k| nearest(k, given.hi[k])),
        ];
        for k in 0..3 {
            // Rounded inward.
            if is_at(k, found[0][k]) > given.lo[k] {
                found[0][k] = wide[0][k];
            }
            if is_at(k, found[1][k]) < given.hi[k] {
                found[1][k] = wide[1][k];
            }
        }
        found
    }

    /// Returns the length by which numbers of this size may differ through rounding.
    fn rounding(&self, bounds: &Aabb) -> f64 {
        self.frame.slack() + bounds.magnitude() * ROUNDING
    }

    fn check_box(&self, graph: &Graph<'_>, order: &[Placed], placed: &Placed, faults: &mut Faults) {
        let node = placed.node;
        let given = self.of(node);
        let holds_nothing = graph.is_leaf(node) && graph.objects(node).is_empty();
        if holds_nothing {
            return;
        }
        if !given.lo.is_finite() || !given.hi.is_finite() {
            return faults.add(FaultKind::NotFinite, || {
                format!("node {node}: its box is {:?}", self.boxes[node as usize])
            });
        }
        if self.split && !given.lo.cmple(given.hi).all() {
            return faults.add(FaultKind::Inverted, || {
                format!("node {node}: its box is {:?}", self.boxes[node as usize])
            });
        }
        let parent = order[placed.parent as usize].node;
        let around = self.of(parent).enlarged(self.rounding(&given));
        if !contains(&around, &given) {
            faults.add(FaultKind::Outside, || {
                let [own, above] = [node, parent].map(|node| self.boxes[node as usize]);
                format!("node {node}: its box {own:?} extends beyond that of its parent {parent}, {above:?}")
            });
        }
    }

    /// Counts objects that extend beyond the boxes of their leaves. Objects in no leaf are counted elsewhere.
    fn check_cover(&self, covered: &[Aabb], faults: &mut Faults) {
        for (i, (object, covered)) in self.objects.iter().zip(covered).enumerate() {
            let bounds = object.bounds();
            let around = covered.enlarged(self.rounding(&bounds));
            if !covered.is_empty() && !contains(&around, &bounds) {
                faults.add(FaultKind::Uncovered, || {
                    let [lo, hi] = [bounds.lo, bounds.hi].map(|corner| corner.to_array());
                    format!(
                        "object {i}, from {lo:?} to {hi:?}, extends beyond the boxes of its leaves"
                    )
                });
            }
        }
    }
}

/// Returns whether a box contains another one, which can be empty.
pub fn contains(outer: &Aabb, inner: &Aabb) -> bool {
    inner.is_empty() || outer.lo.cmple(inner.lo).all() && inner.hi.cmple(outer.hi).all()
}

/// Makes the box of every inner node that around its children. The box of a node that holds nothing is a point
/// in that of its parent.
fn enclose(nodes: &mut [BoxNode], parents: &[u32]) {
    for i in (1..nodes.len()).rev() {
        let (lo, hi) = (nodes[i].lo, nodes[i].hi);
        let parent = &mut nodes[parents[i] as usize];
        for k in 0..3 {
            parent.lo[k] = parent.lo[k].min(lo[k]);
            parent.hi[k] = parent.hi[k].max(hi[k]);
        }
    }
    if nodes[0].lo[0] > nodes[0].hi[0] {
        (nodes[0].lo, nodes[0].hi) = ([-1.0; 3], [1.0; 3]);
    }
    for i in 1..nodes.len() {
        if nodes[i].lo[0] > nodes[i].hi[0] {
            let corner = nodes[parents[i] as usize].lo;
            (nodes[i].lo, nodes[i].hi) = (corner, corner);
        }
    }
}
