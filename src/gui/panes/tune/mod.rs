//! What the best tree is searched for, and among which methods; progress while the search runs.

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::theme::{ROW, heading, hint, strong, tokens};
use crate::gui::widgets::choice_list;
use crate::gui::widgets::common::{no_picture, sentence};
use crate::jobs::{End, Standing};
use crate::measure::tune::{Goal, MOST_SLOWDOWN, NAIVE_LIMIT, is_tried};
use crate::present::number::{Digits, grouped};
use crate::present::report::tune::left_out;
use crate::structure::Method;
use egui::vec2;

#[derive(Default)]
pub struct TunePane;

impl Pane for TunePane {
    const ID: &'static str = "tune";
    const TITLE: &'static str = "Best tree";
    const ABOUT: &'static str = "Finds the method and the settings that suit this scene best.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "tune.find" Here NONE [Enter] "Find the best tree; Esc stops it" => |_, cx| cx.edits.add(Document::tune);
    };

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let is_running = doc.tuning.study.is_running();
        ui.add_enabled_ui(!is_running, |ui| {
            ui.label(heading("Goal"));
            goal(ui, doc, cx.edits);
            ui.add_space(12.0);
            ui.label(heading("Methods"));
            methods(ui, doc, cx.edits);
            ui.add_space(12.0);
            budget(ui, doc, cx.edits);
        });
        ui.add_space(12.0);
        if is_running {
            progress(ui, doc, cx.edits);
        } else {
            start(ui, doc, cx.edits);
        }
        ending(ui, doc);
    }
}

fn goal(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    for goal in Goal::ALL {
        let (name, about) = match goal {
            Goal::Time => (
                "Fastest rendering",
                "The least median rendering time, T_TR.".into(),
            ),
            Goal::Memory => (
                "Least memory",
                format!(
                    "The smallest tree that renders in at most {MOST_SLOWDOWN} times the time of the \
                     fastest."
                ),
            ),
        };
        let choice = ui.radio(doc.tuning.goal == goal, name);
        if choice.on_hover_text(about).clicked() {
            edits.add(move |doc| doc.tuning.goal = goal);
        }
    }
}

/// A box per method by family, in two columns so that all are in view.
fn methods(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let objects = doc.current.as_ref().map(|c| c.shown.scene.objects().len());
    let width = ui.available_width() / 2.0;
    for (family, methods) in Method::families() {
        choice_list::group(ui, family);
        for pair in methods.chunks(2) {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                for method in pair {
                    let fits = objects.is_none_or(|objects| is_tried(*method, objects));
                    let left = egui::Layout::left_to_right(egui::Align::Center);
                    ui.allocate_ui_with_layout(vec2(width, ROW), left, |ui| {
                        ui.set_min_size(vec2(width, ROW));
                        self::method(ui, *method, fits, doc, edits);
                    });
                }
            });
        }
    }
}

fn method(ui: &mut egui::Ui, method: Method, fits: bool, doc: &Document, edits: &mut Edits) {
    let mut is_chosen = fits && doc.tuning.methods.contains(&method);
    let choice = egui::Checkbox::new(&mut is_chosen, method.name);
    let choice = ui
        .add_enabled(fits, choice)
        .on_hover_text(format!("{}.\n{}", sentence(method.summary), method.about))
        .on_disabled_hover_text(format!(
            "Only measured in scenes of up to {} objects.",
            grouped(NAIVE_LIMIT as f64)
        ));
    if choice.changed() {
        edits.add(move |doc| {
            let methods = &mut doc.tuning.methods;
            methods.retain(|known| *known != method);
            if is_chosen {
                methods.push(method);
            }
        });
    }
}

fn budget(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    ui.horizontal(|ui| {
        let about =
            "Time for the measurements. Every method is measured at least once with its defaults.";
        ui.label("Time limit").on_hover_text(about);
        let mut budget = doc.tuning.budget;
        let edit = egui::DragValue::new(&mut budget)
            .range(1..=86_400)
            .suffix(" s");
        let edit = ui.add(edit).accessible_name("Time limit");
        if edit.on_hover_text(about).changed() {
            edits.add(move |doc| doc.tuning.budget = budget);
        }
    });
}

fn start(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    if doc.current.is_none() {
        no_picture(ui, doc);
        return;
    }
    let t = tokens(ui);
    let text = strong("Find the best tree").color(t.on_accent);
    let button = egui::Button::new(text)
        .fill(t.accent)
        .min_size(vec2(0.0, 36.0));
    let about = "Measure the chosen methods with many settings on a small version of your picture, the better \
                 ones more and more often.";
    if ui
        .vertical_centered_justified(|ui| ui.add_enabled(doc.may_tune(), button))
        .inner
        .on_hover_text(tip(about, "tune.find"))
        .on_disabled_hover_text("Needs a finished picture of a scene with objects, and a method.")
        .clicked()
    {
        edits.add(Document::tune);
    }
}

fn progress(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    if let Some(status) = doc.tuning.study.status() {
        let bar = egui::ProgressBar::new(status.fraction as f32)
            .desired_height(ROW)
            .text(Digits::Three.percent(status.fraction));
        ui.add(bar);
        let stage = match status.standing {
            Standing::Running => status.stage,
            Standing::Waiting | Standing::Paused => "waiting for the picture".to_owned(),
        };
        // Two lines high, so that nothing moves.
        let size = vec2(ui.available_width(), 40.0);
        ui.allocate_ui(size, |ui| {
            ui.set_min_size(size);
            ui.add(egui::Label::new(hint(stage)).wrap());
        });
        ui.ctx().request_repaint_after_secs(0.1);
    }
    let stop = ui.button("Stop").on_hover_text(tip(
        "Stop the search; what was measured stays.",
        "window.cancel",
    ));
    if stop.clicked() {
        edits.add(|doc| doc.tuning.study.cancel());
    }
}

/// How the last search ended, and what was left out.
fn ending(ui: &mut egui::Ui, doc: &Document) {
    let study = &doc.tuning.study;
    match study.end() {
        Some(End::Cancelled) => {
            ui.label("Stopped; what was measured stays.");
        }
        Some(End::Failed(why)) => {
            ui.label(format!("The search failed: {why}"));
        }
        Some(End::Done(()) | End::Replaced) | None => {}
    }
    let tuned = study.found().and_then(|found| found.tuned.as_ref());
    for line in tuned.map_or_else(Vec::new, |tuned| left_out(tuned)) {
        ui.add(egui::Label::new(hint(line)).wrap());
    }
}
