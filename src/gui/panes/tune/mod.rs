//! What the best tree is searched for, and among which methods; progress while the search runs.

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::document::tuning::Switched;
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
use egui::{Align, Layout, vec2};

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
            rays(ui, doc, cx.edits);
            memory(ui, doc, cx.edits);
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
    ui.horizontal_wrapped(|ui| {
        for goal in Goal::ALL {
            let (name, about) = match goal {
                Goal::Time => (
                    "Fastest rendering",
                    "The least median rendering time, T_TR.".into(),
                ),
                Goal::Memory => (
                    "Least memory",
                    format!(
                        "The smallest tree that renders in at most {MOST_SLOWDOWN} times the time of the fastest."
                    ),
                ),
            };
            let choice = ui.radio(doc.tuning.goal == goal, name);
            if choice.on_hover_text(about).clicked() {
                edits.add(move |doc| doc.tuning.goal = goal);
            }
        }
    });
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
                    let left = Layout::left_to_right(Align::Center);
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

/// The number of rays, if the time of building counts.
fn rays(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let about = "Rank by the time of building the tree once and tracing this many rays like those of the picture, without \
                 shading. Off: rank by the time of the picture.";
    let rays = doc.tuning.rays;
    let names = ["Build once for", "Number of rays"];
    let rays = switched(ui, names, about, rays, |value| {
        egui::DragValue::new(value)
            .range(1..=1_000_000_000_000_u64)
            .speed(10_000.0)
            .custom_formatter(|value, _| grouped(value))
            .custom_parser(|text| {
                let digits = text.chars().filter(|c| !c.is_whitespace());
                digits.collect::<String>().parse().ok()
            })
            .suffix(" rays")
    });
    if let Some(rays) = rays {
        edits.add(move |doc| doc.tuning.rays = rays);
    }
}

/// The most memory of a tree.
fn memory(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let about = "Leave out trees whose nodes and references need more memory, M_TREE. They are built, but not timed.";
    let memory = doc.tuning.memory;
    let names = ["Memory limit", "Most memory"];
    let memory = switched(ui, names, about, memory, |value| {
        egui::DragValue::new(value)
            .range(0.001..=1_048_576.0)
            .speed(0.5)
            .max_decimals(3)
            .suffix(" MiB")
    });
    if let Some(memory) = memory {
        edits.add(move |doc| doc.tuning.memory = memory);
    }
}

/// A number that can be switched off. Returns the new setting if it was changed.
fn switched<T: Copy + PartialEq>(
    ui: &mut egui::Ui,
    [label, name]: [&str; 2],
    about: &str,
    before: Switched<T>,
    edit: impl for<'a> Fn(&'a mut T) -> egui::DragValue<'a>,
) -> Option<Switched<T>> {
    let mut after = before;
    ui.horizontal(|ui| {
        ui.checkbox(&mut after.is_on, label).on_hover_text(about);
        let edit = edit(&mut after.value);
        ui.add_enabled(before.is_on, edit)
            .accessible_name(name)
            .on_hover_text(about);
    });
    (after != before).then_some(after)
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
    let status = doc.tuning.study.status();
    ui.allocate_ui_with_layout(
        vec2(ui.available_width(), 36.0),
        Layout::right_to_left(Align::Center),
        |ui| {
            let stop = ui.button("Stop").on_hover_text(tip(
                "Stop the search; what was measured stays.",
                "window.cancel",
            ));
            if stop.clicked() {
                edits.add(|doc| doc.tuning.study.cancel());
            }
            let fraction = status.as_ref().map_or(0.0, |status| status.fraction);
            let bar = egui::ProgressBar::new(fraction as f32)
                .desired_height(ROW)
                .desired_width(ui.available_width())
                .text(Digits::Three.percent(fraction));
            ui.add(bar);
        },
    );
    if let Some(status) = status {
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
