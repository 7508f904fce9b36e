//! The list of the selected ray's steps: every inner node and leaf in order.

use crate::gui::document::Document;
use crate::gui::document::walk::listed;
use crate::gui::edits::Edits;
use crate::gui::theme::ROW;
use crate::gui::widgets::rows::{Column, List, Row};
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::order_color;
use crate::scene::Scene;
use crate::trace::{RayPath, Step};
use egui::{Color32, Painter, Rect, Stroke, Ui, pos2, vec2};

const COLUMNS: &[Column] = &[
    Column {
        title: "#",
        about: "Number of the step",
        width: 48.0,
    },
    Column {
        title: "what",
        about: "Inner node (a fork), full leaf (a filled square in the color of its box), empty leaf (a \
                hollow one), or a pending node that is culled (a cross)",
        width: 84.0,
    },
    Column {
        title: "node",
        about: "Index of the node in the tree's array",
        width: 72.0,
    },
    Column {
        title: "t-range",
        about: "The interval of the ray in the node's cell, in units of the scene",
        width: 150.0,
    },
    Column {
        title: "result",
        about: "The plane and which children are visited, the box tests and which child is visited first, or \
                the tests and the closest hit of a leaf",
        width: 110.0,
    },
];

/// The column that a narrow list leaves out, by its place: the strip shows the same.
const T_RANGE: usize = 3;

/// Below this width, in points, a list is narrow.
const NARROW: f32 = 500.0;

/// Goes to a step of the ray.
pub fn go_to(doc: &mut Document, step: usize) {
    if let Some(current) = &mut doc.current {
        current.go_to_step(step);
    }
}

/// Shows the list at a height: a header and as many rows as fit.
pub fn show(ui: &mut Ui, doc: &Document, edits: &mut Edits, height: f32) {
    let Some(current) = &doc.current else {
        return;
    };
    let Some(picked) = &current.picked else {
        return;
    };
    let (path, scene) = (picked.path(), &current.shown.scene);
    let steps = listed(path, doc.walking.leaves_only);
    let orders = orders(path);
    let n = path.leaves().count();
    // Rows are a little lower or higher than elsewhere, so that all of the height is used.
    let lines = (height / ROW).round().max(2.0);
    let mut columns = COLUMNS.to_vec();
    let is_narrow = ui.available_width() < NARROW;
    if is_narrow {
        columns.remove(T_RANGE);
    }
    let list = List {
        name: "steps",
        columns: &columns,
        rows: steps.len(),
        selected: steps.iter().position(|&i| i == picked.step),
        most: lines as usize - 1,
        row: (height / lines).floor(),
    };
    let clicked = list.show(
        ui,
        |i| {
            let mut row = row(scene, steps[i], &path.steps[steps[i]]);
            if is_narrow {
                row.cells.remove(T_RANGE);
            }
            row
        },
        |i, painter, rect, color| {
            let order = (orders[steps[i]], n);
            icon(painter, rect, &path.steps[steps[i]], order, color);
        },
    );
    if let Some(i) = clicked {
        let step = steps[i];
        edits.add(move |doc| go_to(doc, step));
    }
}

/// For every step the number of leaves before it.
fn orders(path: &RayPath) -> Vec<usize> {
    let mut leaves = 0;
    path.steps
        .iter()
        .map(|step| {
            let before = leaves;
            leaves += usize::from(matches!(step, Step::Leaf(_)));
            before
        })
        .collect()
}

fn row(scene: &Scene, i: usize, step: &Step) -> Row {
    let number = (i + 1).to_string();
    let cells = match step {
        Step::Inner(inner) => vec![
            number,
            "     inner".to_owned(),
            grouped(inner.node as usize),
            step_text::interval(inner.t_enter, inner.t_exit),
            format!(
                "{} = {}, {}",
                inner.axis.name(),
                step_text::short(inner.plane),
                step_text::way(inner.children)
            ),
        ],
        Step::Boxes(step) => vec![
            number,
            "     inner".to_owned(),
            grouped(step.node as usize),
            step_text::interval(step.t_enter, step.t_exit),
            step_text::entered_briefly(step),
        ],
        Step::Culled(step) => vec![
            number,
            "     culled".to_owned(),
            grouped(step.node as usize),
            step_text::short(step.t_enter),
            format!("beyond the hit at {}", step_text::short(step.limit)),
        ],
        Step::Leaf(leaf) => {
            let hit = leaf.tests.iter().rev().find_map(|test| test.hit);
            let tests = step_text::count(leaf.tests.len() as u32, "test", "tests");
            vec![
                number,
                "     leaf".to_owned(),
                grouped(leaf.node as usize),
                step_text::interval(leaf.t_enter, leaf.t_exit),
                match (leaf.objects, hit) {
                    (0, _) => "empty".to_owned(),
                    (_, Some(t)) => format!("{tests}, hit at {}", step_text::short(t)),
                    (_, None) => format!("{tests}, no hit"),
                },
            ]
        }
    };
    Row {
        cells,
        label: step_text::step(scene, i + 1, step),
    }
}

/// A fork for an inner node; for a leaf a square in the color of its box in the 3D view.
fn icon(painter: &Painter, number: Rect, step: &Step, (order, n): (usize, usize), text: Color32) {
    let middle = pos2(number.right() + 9.0, number.center().y);
    let square = Rect::from_center_size(middle, vec2(9.0, 9.0));
    match step {
        Step::Culled(_) => {
            let stroke = Stroke::new(1.5, text);
            painter.line_segment([square.left_top(), square.right_bottom()], stroke);
            painter.line_segment([square.right_top(), square.left_bottom()], stroke);
        }
        Step::Inner(_) | Step::Boxes(_) => {
            let stroke = Stroke::new(1.5, text);
            let fork = middle - vec2(0.0, 1.0);
            painter.line_segment([square.center_top(), fork], stroke);
            painter.line_segment([fork, square.left_bottom()], stroke);
            painter.line_segment([fork, square.right_bottom()], stroke);
        }
        Step::Leaf(leaf) => {
            let [r, g, b] = order_color(order, n);
            let color = Color32::from_rgb(r, g, b);
            // The colors of leaves are made for a dark ground.
            painter.rect_filled(square.expand(2.0), 2.0, Color32::from_gray(24));
            if leaf.objects == 0 {
                let stroke = Stroke::new(1.5, color);
                painter.rect_stroke(square, 0.0, stroke, egui::StrokeKind::Inside);
            } else {
                painter.rect_filled(square, 0.0, color);
            }
        }
    }
}
