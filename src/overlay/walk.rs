//! The walk of a ray through the tree: the leaves it visited in order, and one step in detail.

use super::lines::{Line, box_lines, order_color};
use crate::geometry::{Aabb, Axis, Vec3};
use crate::trace::{RayPath, Step};
use crate::tree::Tree;

/// Colour of the current cell and of the ray inside it.
pub const CELL: [u8; 3] = [90, 255, 120];
/// Colour of the current node's plane.
pub const PLANE: [u8; 3] = [255, 160, 40];
/// Colour of the cells that wait.
pub const WAITING: [u8; 3] = [200, 200, 200];

const SOLID: u8 = 255;
const DASHED: u8 = 0;

/// Lines across the plane of a node.
const HATCHES: u32 = 9;

fn rgba([r, g, b]: [u8; 3], strokes: u8) -> [u8; 4] {
    [r, g, b, strokes]
}

/// The outlines of the leaves that a ray visited, coloured by their order; empty ones are dashed,
/// and those after the current step thin.
pub fn visited_lines(path: &RayPath, step: usize, center: Vec3) -> Vec<Line> {
    let n = path.leaves().count();
    let leaves = path.steps.iter().enumerate().filter_map(|(i, s)| match s {
        Step::Leaf(leaf) => Some((i, leaf)),
        Step::Inner(_) => None,
    });
    let mut lines = Vec::new();
    for (order, (i, leaf)) in leaves.enumerate() {
        let strokes = if leaf.objects == 0 { DASHED } else { SOLID };
        let width = if i <= step { 2.5 } else { 1.0 };
        let color = rgba(order_color(order, n), strokes);
        lines.extend(box_lines(&leaf.bounds, center, color, width));
    }
    lines
}

/// One step: what waits, the plane inside the node's cell, the cell, and the ray inside it. Nothing
/// where there is no such step.
pub fn step_lines(tree: &Tree, path: &RayPath, step: usize, center: Vec3) -> Vec<Line> {
    let Some(current) = path.steps.get(step) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for waiting in path.waiting(step) {
        let bounds = tree.cell_of(waiting.node).bounds;
        lines.extend(box_lines(&bounds, center, rgba(WAITING, DASHED), 1.0));
    }
    let (bounds, t_enter, t_exit) = match current {
        Step::Inner(inner) => {
            let bounds = tree.cell_of(inner.node).bounds;
            lines.extend(plane_lines(&bounds, inner.axis, inner.plane, center));
            (bounds, inner.t_enter, inner.t_exit)
        }
        Step::Leaf(leaf) => (leaf.bounds, leaf.t_enter, leaf.t_exit),
    };
    let green = rgba(CELL, SOLID);
    lines.extend(box_lines(&bounds, center, green, 3.5));
    if t_enter.is_finite() && t_exit.is_finite() {
        let [from, to] = [t_enter, t_exit].map(|t| path.ray.at(t));
        lines.push(Line::new(from, to, center, green, 8.0));
    }
    lines
}

/// The rectangle in which a plane cuts a box, hatched.
fn plane_lines(bounds: &Aabb, axis: Axis, plane: f64, center: Vec3) -> Vec<Line> {
    let [u, v] = [axis.next(), axis.next().next()].map(Axis::index);
    let at = |[a, b]: [f64; 2]| {
        let mut point = bounds.lo;
        point[axis.index()] = plane;
        point[u] += a * (bounds.hi[u] - bounds.lo[u]);
        point[v] += b * (bounds.hi[v] - bounds.lo[v]);
        point
    };
    let color = rgba(PLANE, SOLID);
    let line = |a, b, width| Line::new(at(a), at(b), center, color, width);
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut lines: Vec<Line> = (0..4)
        .map(|i| line(corners[i], corners[(i + 1) % 4], 2.5))
        .collect();
    for i in 1..=HATCHES {
        // Where the sides' shares sum to the same, from 0 in one corner to 2 in the other.
        let sum = 2.0 * f64::from(i) / f64::from(HATCHES + 1);
        let (low, high) = ((sum - 1.0).max(0.0), sum.min(1.0));
        lines.push(line([low, high], [high, low], 1.0));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hatches_lie_in_the_plane_and_in_the_box() {
        let bounds = Aabb::new(Vec3::new(-1.0, 2.0, 3.0), Vec3::new(4.0, 5.0, 7.0));
        for axis in Axis::ALL {
            let plane = bounds.center()[axis.index()];
            let lines = plane_lines(&bounds, axis, plane, Vec3::ZERO);
            assert_eq!(lines.len(), 4 + HATCHES as usize);
            for end in lines.iter().flat_map(|line| [line.a, line.b]) {
                let end = Vec3::from(end.map(f64::from));
                assert!(bounds.enlarged(1e-6).contains(end), "{end}");
                assert!((end[axis.index()] - plane).abs() < 1e-6);
            }
        }
    }
}
