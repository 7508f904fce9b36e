//! The walk of the selected ray through the tree: every inner node and leaf in order, and what
//! happens in the current one.

use crate::gui::document::Document;
use crate::gui::document::picked::Picked;
use crate::gui::document::walk::listed;
use crate::gui::widgets::rows::{Column, List, Row};
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::order_color;
use crate::scene::Scene;
use crate::trace::{RayPath, Step};
use egui::{Color32, Painter, Rect, Stroke, pos2, vec2};

const COLUMNS: &[Column] = &[
    Column {
        title: "#",
        about: "Number of the step",
        width: 28.0,
    },
    Column {
        title: "what",
        about: "Inner node (a fork), full leaf (a filled square in the colour of its box) or empty \
                leaf (a hollow one)",
        width: 58.0,
    },
    Column {
        title: "node",
        about: "Index of the node in the tree's array",
        width: 48.0,
    },
    Column {
        title: "depth",
        about: "Levels below the root",
        width: 42.0,
    },
    Column {
        title: "from – to",
        about: "Where on the ray the cell lies, in units of the scene",
        width: 103.0,
    },
    Column {
        title: "what happens",
        about: "The plane and which children are visited, or the tests and the nearest hit of a leaf",
        width: 110.0,
    },
];

pub fn show(ui: &mut egui::Ui, doc: &mut Document) {
    let leaves_only = doc.walking.leaves_only;
    let Some(current) = &mut doc.current else {
        ui.weak("No picture yet");
        return;
    };
    let Some(picked) = &current.picked else {
        ui.weak("Pick a pixel to step through the walk of a ray.");
        return;
    };
    let (path, scene) = (picked.path(), &current.shown.scene);
    let counts = path.counts();
    ui.add(
        egui::Label::new(format!(
            "The {} ray visits {} ({} empty) and {}, and makes {}.",
            path.kind.name(),
            step_text::count(counts.leaves, "leaf", "leaves"),
            counts.empty_leaves,
            step_text::count(counts.inner_nodes, "inner node", "inner nodes"),
            step_text::count(counts.tests, "intersection test", "intersection tests"),
        ))
        .wrap(),
    );
    let steps = listed(path, leaves_only);
    let orders = orders(path);
    let n = counts.leaves as usize;
    let list = List {
        name: "walk",
        columns: COLUMNS,
        rows: steps.len(),
        selected: steps.iter().position(|&i| i == picked.step),
        most: 9,
    };
    let clicked = list.show(
        ui,
        |i| row(scene, steps[i], &path.steps[steps[i]]),
        |i, painter, rect, _| icon(painter, rect, &path.steps[steps[i]], orders[steps[i]], n),
    );
    ui.add_space(3.0);
    detail(ui, scene, picked);
    stack(ui, picked);
    if let Some(i) = clicked {
        let step = steps[i];
        current.go_to_step(step);
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
            inner.depth.to_string(),
            step_text::interval(inner.t_enter, inner.t_exit),
            format!(
                "{} = {}, {}",
                inner.axis.name(),
                step_text::short(inner.plane),
                step_text::way(inner.children)
            ),
        ],
        Step::Leaf(leaf) => {
            let hit = leaf.tests.iter().rev().find_map(|test| test.hit);
            let tests = step_text::count(leaf.tests.len() as u32, "test", "tests");
            vec![
                number,
                "     leaf".to_owned(),
                grouped(leaf.node as usize),
                leaf.depth.to_string(),
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

/// A fork for an inner node; for a leaf a square in the colour of its box in the 3D view.
fn icon(painter: &Painter, number: Rect, step: &Step, order: usize, n: usize) {
    let gray = Color32::from_gray(150);
    let middle = pos2(number.right() + 9.0, number.center().y);
    let square = Rect::from_center_size(middle, vec2(9.0, 9.0));
    match step {
        Step::Inner(_) => {
            let stroke = Stroke::new(1.5, gray);
            let fork = middle - vec2(0.0, 1.0);
            painter.line_segment([square.center_top(), fork], stroke);
            painter.line_segment([fork, square.left_bottom()], stroke);
            painter.line_segment([fork, square.right_bottom()], stroke);
        }
        Step::Leaf(leaf) => {
            let [r, g, b] = order_color(order, n);
            let color = Color32::from_rgb(r, g, b);
            if leaf.objects == 0 {
                let stroke = Stroke::new(1.5, color);
                painter.rect_stroke(square, 0.0, stroke, egui::StrokeKind::Inside);
            } else {
                painter.rect_filled(square, 0.0, color);
            }
        }
    }
}

/// What happens in the current step, at a height that does not depend on it.
fn detail(ui: &mut egui::Ui, scene: &Scene, picked: &Picked) {
    const HEIGHT: f32 = 96.0;
    egui::ScrollArea::vertical()
        .id_salt("step")
        .max_height(HEIGHT)
        .min_scrolled_height(HEIGHT)
        .auto_shrink(false)
        .show(ui, |ui| {
            let Some(step) = picked.current() else {
                ui.label("It misses the root cell: it visits no node.");
                return;
            };
            let label = |ui: &mut egui::Ui, text: String| {
                ui.add(egui::Label::new(text).wrap());
            };
            let number = picked.step + 1;
            match step {
                Step::Inner(inner) => {
                    ui.strong(format!(
                        "Step {number}: inner node {}",
                        grouped(inner.node as usize)
                    ));
                    let why = step_text::why(inner);
                    label(ui, format!("Because {why}."));
                }
                Step::Leaf(leaf) => {
                    let kind = if leaf.objects == 0 { "empty" } else { "full" };
                    ui.strong(format!(
                        "Step {number}: {kind} leaf {}",
                        grouped(leaf.node as usize)
                    ));
                    let (lo, hi) = (leaf.bounds.lo, leaf.bounds.hi);
                    let short = step_text::short;
                    label(
                        ui,
                        format!(
                            "x {} to {}, y {} to {}, z {} to {} units; a leaf because: {}",
                            short(lo.x),
                            short(hi.x),
                            short(lo.y),
                            short(hi.y),
                            short(lo.z),
                            short(hi.z),
                            leaf.stop.text()
                        ),
                    );
                    label(ui, format!("Then: {}.", leaf.outcome.text()));
                    tests(ui, scene, picked.path(), &leaf.tests);
                }
            }
        });
}

fn tests(ui: &mut egui::Ui, scene: &Scene, path: &RayPath, tests: &[crate::trace::TestStep]) {
    /// A leaf that was never split can hold all objects.
    const MOST: usize = 200;
    for (i, test) in tests.iter().take(MOST).enumerate() {
        let text = step_text::test(scene, path.kind, test);
        ui.label(format!("Test {}: {text}", i + 1));
    }
    if tests.len() > MOST {
        ui.weak(format!("and {} more tests", grouped(tests.len() - MOST)));
    }
}

/// The nodes that wait, the next one first.
fn stack(ui: &mut egui::Ui, picked: &Picked) {
    const HEIGHT: f32 = 58.0;
    let waiting = picked.path().pending(picked.step);
    ui.strong(format!(
        "Stack: {} waiting",
        step_text::count(waiting.len() as u32, "node", "nodes")
    ))
    .on_hover_text(
        "Far children that wait once this step is done; after a leaf, the walk goes on with \
             the first of them.",
    );
    egui::ScrollArea::vertical()
        .id_salt("stack")
        .max_height(HEIGHT)
        .min_scrolled_height(HEIGHT)
        .auto_shrink(false)
        .show(ui, |ui| {
            for (i, node) in waiting.iter().rev().enumerate() {
                let next = if i == 0 { " (next)" } else { "" };
                let interval = step_text::interval(node.t_enter, node.t_exit);
                let index = grouped(node.node as usize);
                ui.label(format!("node {index}: {interval} units{next}"));
            }
        });
}
