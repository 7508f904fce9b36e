//! What is marked in the 3D view: the selected node's cell with its plane, or its box with those of its
//! children, and the leaves that refer to the selected object.

use super::camera::ViewCamera;
use super::settings::{Cells, Settings};
use crate::geometry::{Aabb, Axis, Ray, Vec3};
use crate::gui::document::inspect::WhatIf;
use crate::gui::document::picked::Picked;
use crate::gui::document::{Current, Document};
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::present::number::Digits;
use crate::present::overlay::{
    CELL_COLOR, FaceCorner, Leaf, Line, Outside, PLANE_COLOR, REFERRING_COLOR, box_lines,
    cell_faces, cell_lines, cells_along, child_lines, overlap_faces, overlap_share,
};
use crate::structure::{CellOfNode, Nodes};
use crate::trace::Step;
use egui::{Align2, Color32, Rect, vec2};

/// So many of an object's leaves are drawn.
const MOST_CELLS: usize = 300;

/// What is marked.
#[derive(Default)]
pub struct Marks {
    cell: Option<CellOfNode>,
    /// The cell's plane, or the one tried instead; in a hierarchy, only one that is tried.
    plane: Option<(Axis, f64)>,
    is_what_if: bool,
    /// The boxes into which a node of a hierarchy is divided, or would be by what is tried.
    parts: Vec<Part>,
    /// The selected object and the cells of its leaves, as far as they are drawn.
    object: Option<(u32, Vec<Aabb>)>,
    /// How many leaves that object has.
    leaves: usize,
}

/// A box into which a node of a hierarchy is divided.
struct Part {
    bounds: Aabb,
    /// What is written at it.
    name: String,
}

impl Marks {
    /// What the selection asks to mark.
    pub fn of(doc: &Document, ctx: &egui::Context) -> Marks {
        let Some(current) = &doc.current else {
            return Marks::default();
        };
        let tree = &current.shown.tree;
        let mut marks = Marks::default();
        if let Some(node) = current.selection.node {
            let cell = tree.cell_of(node);
            marks.cell = Some(cell);
            marks.plane = tree.plane(node);
            marks.parts = parts(current, &cell);
            if let Some(tried) = doc.inspect.what_if {
                marks.plane = Some((tried.axis, tried.plane));
                marks.is_what_if = true;
                marks.parts = tried_parts(doc, current, &tried, ctx);
            }
        }
        // Beside a ray, only its own leaves are drawn.
        let object = current.selection.object.filter(|_| doc.task != "ray");
        if let Some(object) = object
            && let Some(index) = doc.inspect.index(current, ctx)
        {
            let leaves = index.leaves_of(object);
            marks.leaves = leaves.len();
            let cells = leaves.iter().take(MOST_CELLS);
            let cells = cells.map(|&leaf| tree.cell_of(leaf).bounds).collect();
            marks.object = Some((object, cells));
        }
        marks
    }

    /// The plane that divides the cell; none where boxes do.
    fn drawn_plane(&self) -> Option<(Axis, f64)> {
        self.plane.filter(|_| self.parts.is_empty())
    }

    fn boxes(&self) -> Vec<Aabb> {
        self.parts.iter().map(|part| part.bounds).collect()
    }

    pub fn lines(&self, center: Vec3) -> Vec<Line> {
        let mut lines = Vec::new();
        if let Some((_, cells)) = &self.object {
            let [r, g, b] = REFERRING_COLOR;
            for cell in cells {
                lines.extend(box_lines(cell, center, [r, g, b, 255], 1.0));
            }
        }
        if let Some(cell) = &self.cell {
            lines.extend(cell_lines(&cell.bounds, self.drawn_plane(), center));
            lines.extend(child_lines(&self.boxes(), center));
        }
        lines
    }

    pub fn faces(&self, center: Vec3) -> Vec<FaceCorner> {
        let cell = self.cell.iter();
        let mut faces: Vec<_> = cell
            .flat_map(|cell| cell_faces(&cell.bounds, self.drawn_plane(), center))
            .collect();
        faces.extend(overlap_faces(&self.boxes(), center));
        faces
    }

    /// Writes the node's name at its cell and the plane's place at the plane.
    pub fn name(&self, camera: &ViewCamera, ui: &egui::Ui, rect: Rect) {
        let Some(cell) = &self.cell else {
            return;
        };
        let painter = ui.painter().with_clip_rect(rect);
        let on_screen = |point: &Vec3| {
            let [x, y] = camera.place(*point)?;
            let at = rect.center() + vec2(x as f32, -y as f32) * rect.height() * 0.5;
            rect.shrink(8.0).contains(at).then_some(at)
        };
        // The first of these points that can be seen and has no text yet.
        let mut taken: Vec<Rect> = Vec::new();
        let mut write = |points: &[Vec3], text: String, [r, g, b]: [u8; 3], anchor: Align2| {
            let font = egui::FontId::proportional(12.0);
            let galley = painter.layout_no_wrap(text, font, Color32::from_rgb(r, g, b));
            let seen = points.iter().filter_map(on_screen);
            let places = seen.map(|at| anchor.anchor_size(at, galley.size()).expand(2.0));
            let places: Vec<Rect> = places.collect();
            let is_free = |place: &&Rect| !taken.iter().any(|other| other.intersects(**place));
            let Some(place) = places.iter().find(is_free).or(places.first()) else {
                return;
            };
            let place = place.shrink(2.0);
            taken.push(place.expand(2.0));
            painter.rect_filled(place.expand(2.0), 2.0, Color32::from_black_alpha(190));
            painter.galley(place.min, galley, Color32::WHITE);
        };
        let mut corners = cell.bounds.corners();
        corners.reverse();
        write(
            &[corners.as_slice(), &[cell.bounds.center()]].concat(),
            format!("node {}", cell.node),
            CELL_COLOR,
            Align2::LEFT_BOTTOM,
        );
        for part in &self.parts {
            let corners = part.bounds.corners();
            let places = [corners.as_slice(), &[part.bounds.center()]].concat();
            write(&places, part.name.clone(), PLANE_COLOR, Align2::LEFT_TOP);
        }
        if let Some((axis, at)) = self.drawn_plane() {
            let mut on_plane = cell.bounds.corners();
            for corner in &mut on_plane {
                corner[axis.index()] = at;
            }
            write(
                &on_plane,
                self.plane_text(axis, at),
                PLANE_COLOR,
                Align2::LEFT_TOP,
            );
        }
    }

    fn plane_text(&self, axis: Axis, at: f64) -> String {
        let what = if self.is_what_if { "what if " } else { "" };
        format!("{what}{axis} = {at:.4}")
    }

    /// What the boxes mean into which a node is divided.
    fn key_of_parts(&self, cell: &Aabb) -> Vec<String> {
        if self.parts.is_empty() {
            return Vec::new();
        }
        let boxes = match (self.is_what_if, self.plane) {
            (true, Some((axis, at))) => {
                format!("blue boxes: what if it were divided at {axis} = {at:.4}")
            }
            _ => "blue boxes: its children".to_owned(),
        };
        let overlap = match overlap_share(cell, &self.boxes()) {
            Some(share) if share > 0.0 => format!(
                "violet: where they overlap, {} of its volume",
                Digits::Three.percent(share)
            ),
            Some(_) => "they do not overlap".to_owned(),
            None => "violet: where they overlap".to_owned(),
        };
        vec![boxes, overlap]
    }

    /// What the marks mean, one line each.
    pub fn key(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(cell) = &self.cell {
            let plane = match self.drawn_plane() {
                Some((axis, at)) => format!("; crossed: {}", self.plane_text(axis, at)),
                None => String::new(),
            };
            lines.push(format!(
                "thick box: selected node {}, depth {}{plane}",
                cell.node, cell.depth
            ));
            lines.extend(self.key_of_parts(&cell.bounds));
        }
        if let Some((object, cells)) = &self.object {
            let of = grouped(self.leaves);
            lines.push(if cells.len() < self.leaves {
                format!(
                    "thin red: {} of the {of} leaves of object {object}",
                    cells.len()
                )
            } else {
                format!("thin red: the {of} leaves of object {object}")
            });
        }
        lines
    }
}

/// The boxes of a node's children in a hierarchy. Beside a ray that is at this node, each with what became of it.
fn parts(current: &Current, cell: &CellOfNode) -> Vec<Part> {
    let tree = &current.shown.tree;
    if !matches!(tree.nodes(), Nodes::Boxes(_)) {
        return Vec::new();
    }
    let step = current.picked.as_ref().and_then(Picked::current);
    tree.children(cell)
        .map(|child| {
            let mut name = format!("node {}", child.node);
            if let Some(Step::Boxes(step)) = step
                && let Some(test) = step.tests.iter().find(|test| test.node == child.node)
            {
                name += &format!(": {}", step_text::fate(step, test));
            }
            Part {
                bounds: child.bounds,
                name,
            }
        })
        .collect()
}

/// The boxes of both parts of a division that is tried; none in a tree of planes.
fn tried_parts(
    doc: &Document,
    current: &Current,
    tried: &WhatIf,
    ctx: &egui::Context,
) -> Vec<Part> {
    let cost = doc.inspect.cost(current, tried.node, ctx);
    let scene = &current.shown.scene;
    let boxes = cost.and_then(|cost| cost.boxes_at(scene, tried.axis, tried.plane));
    let boxes = boxes.into_iter().flatten().zip(["below", "above"]);
    boxes
        .filter(|(bounds, _)| !bounds.is_empty())
        .map(|(bounds, side)| Part {
            bounds,
            name: format!("what if, {side} {} = {:.4}", tried.axis, tried.plane),
        })
        .collect()
}

/// The cell whose box is clicked: the nearest that is shown. A click where the selected cell lies moves to
/// the next behind it.
pub fn pick_cell(doc: &Document, shown: &Settings, ray: &Ray) -> Option<u32> {
    let current = doc.current.as_ref()?;
    let tree = &current.shown.tree;
    let (filter, root) = (shown.drawn(), tree.root_cell());
    let visits = doc.inspect.visits.ready();
    let passes =
        |cell: &CellOfNode| match Leaf::of(tree, cell, visits.as_deref().map(|v| &v.visits)) {
            Some(leaf) => filter.passes(&leaf),
            None => true,
        };
    let of_ray = match &current.picked {
        Some(picked) if shown.cells == Cells::Visited => Some(picked.path()),
        _ => None,
    };
    let depth = match (filter.to_depth, of_ray) {
        (Some(depth), None) => depth,
        _ => u32::MAX,
    };
    let cells = match shown.cells {
        Cells::None => Vec::new(),
        _ => {
            // Of a subtree that stands out, the depth counts from its root.
            let focus = filter.focus.filter(|_| of_ray.is_none());
            let root = focus.map(|focus| (tree.cell_of(focus.node), focus.outside));
            let within = root.map_or_else(Vec::new, |(root, _)| {
                cells_along(tree, root, ray, depth.saturating_add(root.depth))
            });
            match root {
                Some((_, Outside::Hidden)) => within,
                _ if within.is_empty() => cells_along(tree, tree.root(), ray, depth),
                _ => within,
            }
        }
    };
    let shown: Vec<u32> = cells
        .into_iter()
        .filter(|cell| {
            let is_drawn = match of_ray {
                Some(path) => path.leaves().any(|leaf| leaf.node == cell.node),
                None => passes(cell),
            };
            is_drawn && !shown.cut.hides(&cell.bounds, &root)
        })
        .map(|cell| cell.node)
        .collect();
    let selected = current.selection.node;
    let at = selected.and_then(|node| shown.iter().position(|&cell| cell == node));
    let next = at.map_or(0, |at| at + 1);
    shown.get(next).or(shown.first()).copied()
}
