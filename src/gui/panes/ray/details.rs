//! The details of the current step: why, which tests, and which nodes are pending.

use crate::gui::document::Document;
use crate::gui::document::picked::Picked;
use crate::gui::widgets::step_text;
use crate::gui::widgets::symbol::grouped;
use crate::scene::Scene;
use crate::trace::{RayPath, Step, TestStep};
use egui::{Label, ScrollArea, Ui};

/// Shows the details at a height that does not depend on them.
pub fn show(ui: &mut Ui, doc: &Document, height: f32) {
    let current = doc.current.as_ref();
    let Some((current, picked)) = current.and_then(|c| Some((c, c.picked.as_ref()?))) else {
        return;
    };
    ui.spacing_mut().item_spacing.y = 2.0;
    ScrollArea::vertical()
        .id_salt("step details")
        .max_height(height)
        .min_scrolled_height(height)
        .auto_shrink(false)
        .show(ui, |ui| {
            step(ui, &current.shown.scene, picked);
            stack(ui, picked);
            summary(ui, picked.path());
        });
}

fn wrapped(ui: &mut Ui, text: String) {
    ui.add(Label::new(text).wrap());
}

/// What happens in the step.
fn step(ui: &mut Ui, scene: &Scene, picked: &Picked) {
    let Some(step) = picked.current() else {
        ui.label("It misses the root cell: it visits no node.");
        return;
    };
    let number = picked.step + 1;
    let index = grouped(step.node() as usize);
    match step {
        Step::Inner(inner) => {
            ui.strong(format!("Step {number}: inner node {index}"));
            wrapped(ui, format!("Because {}.", step_text::why(inner)));
        }
        Step::Boxes(step) => {
            ui.strong(format!("Step {number}: inner node {index}"));
            let tests = step_text::count(step.tests.len() as u32, "child", "children");
            ui.label(format!("Tests the boxes of its {tests}:"));
            for test in &step.tests {
                wrapped(ui, step_text::box_test(step, test));
            }
        }
        Step::Culled(step) => {
            ui.strong(format!("Step {number}: node {index} is culled"));
            wrapped(ui, format!("Because {}.", step_text::why_culled(step)));
        }
        Step::Leaf(leaf) => {
            let kind = if leaf.objects == 0 { "empty" } else { "full" };
            ui.strong(format!("Step {number}: {kind} leaf {index}"));
            let (lo, hi) = (leaf.bounds.lo, leaf.bounds.hi);
            let [x, y, z] = [0, 1, 2]
                .map(|k| format!("{} to {}", step_text::short(lo[k]), step_text::short(hi[k])));
            let stop = leaf.stop.text();
            wrapped(
                ui,
                format!("x {x}, y {y}, z {z} units; a leaf because: {stop}"),
            );
            wrapped(ui, format!("Then: {}.", leaf.outcome.text()));
            if let Some(why) = step_text::overlap(picked.path(), picked.step) {
                wrapped(ui, format!("{why}."));
            }
            tests(ui, scene, picked.path(), &leaf.tests);
        }
    }
}

fn tests(ui: &mut Ui, scene: &Scene, path: &RayPath, tests: &[TestStep]) {
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

/// The pending nodes, the next one first.
fn stack(ui: &mut Ui, picked: &Picked) {
    let pending = picked.path().pending(picked.step);
    ui.strong(format!(
        "Stack: {} pending",
        step_text::count(pending.len() as u32, "node", "nodes")
    ))
    .on_hover_text(
        "Children that are visited later: after a leaf, the traversal continues with the first of them. In a \
         hierarchy, those that begin beyond the closest hit are culled.",
    );
    for (i, node) in pending.iter().rev().enumerate() {
        let next = if i == 0 { " (next)" } else { "" };
        let interval = step_text::interval(node.t_enter, node.t_exit);
        let index = grouped(node.node as usize);
        ui.label(format!("node {index}: {interval} units{next}"));
    }
}

/// What the whole ray does.
fn summary(ui: &mut Ui, path: &RayPath) {
    let counts = path.counts();
    ui.strong("Whole ray");
    let has_boxes = path.steps.iter().any(|step| matches!(step, Step::Boxes(_)));
    let tests = step_text::count(counts.tests, "intersection test", "intersection tests");
    let tests = if has_boxes {
        let boxes = step_text::count(counts.box_tests, "box test", "box tests");
        let culled = step_text::count(counts.culled, "pending node", "pending nodes");
        format!("{boxes} and {tests}. It culls {culled}")
    } else {
        tests
    };
    wrapped(
        ui,
        format!(
            "The {} ray visits {} ({} empty) and {}, and makes {tests}.",
            path.kind.name(),
            step_text::count(counts.leaves, "leaf", "leaves"),
            counts.empty_leaves,
            step_text::count(counts.inner_nodes, "inner node", "inner nodes"),
        ),
    );
    if let Some(first) = step_text::first_hit(path) {
        wrapped(ui, first);
    }
}
