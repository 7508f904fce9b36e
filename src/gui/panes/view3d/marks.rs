//! What is marked in the 3D view: the selected node's cell with its plane, and the leaves that refer
//! to the selected object.

use super::camera::ViewCamera;
use super::settings::{Cells, Settings};
use crate::geometry::{Aabb, Axis, Ray, Vec3};
use crate::gui::document::Document;
use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::Leaf;
use crate::present::overlay::{
    CELL_COLOR, FaceCorner, Line, PLANE_COLOR, REFERRING_COLOR, box_lines, cell_faces, cell_lines,
    cells_along,
};
use crate::structure::CellOfNode;
use egui::{Align2, Color32, Rect, vec2};

/// So many of an object's leaves are drawn.
const MOST_CELLS: usize = 300;

/// What is marked.
#[derive(Default)]
pub struct Marks {
    cell: Option<CellOfNode>,
    /// The cell's plane, or the one tried instead.
    plane: Option<(Axis, f64)>,
    is_what_if: bool,
    /// The selected object and the cells of its leaves, as far as they are drawn.
    object: Option<(u32, Vec<Aabb>)>,
    /// How many leaves that object has.
    leaves: usize,
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
            marks.cell = Some(tree.cell_of(node));
            marks.plane = tree.plane(node);
            if let Some(tried) = doc.inspect.what_if {
                marks.plane = Some((tried.axis, tried.plane));
                marks.is_what_if = true;
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

    pub fn lines(&self, center: Vec3) -> Vec<Line> {
        let mut lines = Vec::new();
        if let Some((_, cells)) = &self.object {
            let [r, g, b] = REFERRING_COLOR;
            for cell in cells {
                lines.extend(box_lines(cell, center, [r, g, b, 255], 1.0));
            }
        }
        if let Some(cell) = &self.cell {
            lines.extend(cell_lines(&cell.bounds, self.plane, center));
        }
        lines
    }

    pub fn faces(&self, center: Vec3) -> Vec<FaceCorner> {
        self.cell
            .map(|cell| cell_faces(&cell.bounds, self.plane, center))
            .unwrap_or_default()
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
        // The first of these points that can be seen.
        let write = |points: &[Vec3], text: String, [r, g, b]: [u8; 3], anchor: Align2| {
            let Some(at) = points.iter().find_map(on_screen) else {
                return;
            };
            let font = egui::FontId::proportional(12.0);
            let galley = painter.layout_no_wrap(text, font, Color32::from_rgb(r, g, b));
            let place = anchor.anchor_size(at, galley.size());
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
        if let Some((axis, at)) = self.plane {
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

    /// What the marks mean, one line each.
    pub fn key(&self) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(cell) = &self.cell {
            let plane = match self.plane {
                Some((axis, at)) => format!("; crossed: {}", self.plane_text(axis, at)),
                None => String::new(),
            };
            lines.push(format!(
                "thick box: selected node {}, depth {}{plane}",
                cell.node, cell.depth
            ));
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
        _ => cells_along(tree, ray, depth),
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
