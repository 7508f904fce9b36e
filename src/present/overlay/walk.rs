//! The traversal of a ray: the visited leaves in order, and one step in detail.

use super::lines::{Line, box_lines, order_color};
use crate::geometry::Vec3;
use crate::structure::Tree;
use crate::trace::{RayPath, Step};

/// Color of the ray inside the current cell.
pub const INTERVAL: [u8; 3] = [90, 255, 120];
/// Color of the pending cells.
pub const WAITING: [u8; 3] = [200, 200, 200];

/// Color of the nodes that were culled, and of the part of the ray before the current one of them.
pub const CULLED: [u8; 3] = [255, 120, 90];

const SOLID: u8 = 255;
const DASHED: u8 = 0;

fn rgba([r, g, b]: [u8; 3], strokes: u8) -> [u8; 4] {
    [r, g, b, strokes]
}

/// Returns the edges of the leaves that a ray visited, colored by their order. Empty leaves are
/// dashed. Leaves after the current step are thin.
pub fn visited_lines(path: &RayPath, step: usize, center: Vec3) -> Vec<Line> {
    let n = path.leaves().count();
    let leaves = path.steps.iter().enumerate().filter_map(|(i, s)| match s {
        Step::Leaf(leaf) => Some((i, leaf)),
        _ => None,
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

/// Returns one step: the pending cells, the nodes that were culled so far, and the part of the ray inside the node's cell. The cell
/// itself is drawn as the selected node's. Returns no lines if there is no such step.
pub fn step_lines(tree: &Tree, path: &RayPath, step: usize, center: Vec3) -> Vec<Line> {
    let Some(current) = path.steps.get(step) else {
        return Vec::new();
    };
    let mut lines = Vec::new();
    for waiting in path.pending(step) {
        let bounds = tree.cell_of(waiting.node).bounds;
        lines.extend(box_lines(&bounds, center, rgba(WAITING, DASHED), 1.0));
    }
    for culled in path.steps.iter().take(step + 1) {
        if let Step::Culled(culled) = culled {
            let bounds = tree.cell_of(culled.node).bounds;
            lines.extend(box_lines(&bounds, center, rgba(CULLED, DASHED), 1.0));
        }
    }
    if let Step::Culled(culled) = current {
        // From the closest hit to where the box begins: what the ray does not visit.
        let [from, to] = [culled.limit, culled.t_enter].map(|t| path.ray.at(t));
        lines.push(Line::new(from, to, center, rgba(CULLED, DASHED), 5.0));
        return lines;
    }
    let [t_enter, t_exit] = current.interval();
    if t_enter.is_finite() && t_exit.is_finite() {
        let [from, to] = [t_enter, t_exit].map(|t| path.ray.at(t));
        lines.push(Line::new(from, to, center, rgba(INTERVAL, SOLID), 8.0));
    }
    lines
}
