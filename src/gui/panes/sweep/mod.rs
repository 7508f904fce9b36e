//! Which depth, which leaf size? A parameter over a grid of settings, as curves and as a map. A click on
//! a point loads its settings.

mod map;
mod plot;
mod shown;
mod study;

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::widgets::choice_list;
use crate::gui::widgets::common::{busy, no_picture};

use crate::jobs::{End, Scheduler, Standing};
use crate::measure::sweep::{Row, answers};
use crate::measure::{Class, Parameter, parameter, parameters};
use crate::present::number::Digits;
use crate::structure::{MaxDepth, Method};
use egui::vec2;
use shown::Shown;
use study::{Found, Saving, Sweeping};

/// From this width on, in points, the map stands beside the curves.
const WIDE: f32 = 900.0;

pub struct SweepPane {
    sweeping: Sweeping,
    shown: &'static Parameter,
    /// Whether the map stands in the curves' place, where there is not room for both.
    map_first: bool,
}

impl Default for SweepPane {
    fn default() -> Self {
        SweepPane {
            sweeping: Sweeping::default(),
            shown: parameter("T_TR"),
            map_first: false,
        }
    }
}

/// What depends on the tree, and so is worth a curve.
fn choices() -> impl Iterator<Item = &'static Parameter> {
    let depends = |p: &&Parameter| matches!(p.class, Class::C | Class::R | Class::T);
    parameters().iter().filter(depends)
}

impl Pane for SweepPane {
    const ID: &'static str = "sweep";
    const TITLE: &'static str = "Depth & leaf size";
    const ALIASES: &'static [&'static str] = &["Depth and leaf size", "Sweep"];
    const ABOUT: &'static str = "Every parameter over a grid of depths and leaf sizes.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "sweep.run" Here NONE [Enter] "Measure all depths and leaf sizes; Esc ends it" => |pane, cx| pane.sweeping.start(cx.doc);
        "sweep.previous-parameter" Here SHIFT [E] "Show the previous parameter of the sweep" => |pane, _| pane.turn(false);
        "sweep.next-parameter" Here NONE [E] "Show the next parameter of the sweep" => |pane, _| pane.turn(true);
        "sweep.sweep-map" Here NONE [M] "Show the curves of the sweep or its map" => |pane, _| pane.map_first ^= true;
    };

    fn update(&mut self, _: &mut Cx<'_>) {
        self.sweeping.receive();
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let found = self.sweeping.study.found().cloned();
        ui.horizontal_wrapped(|ui| self.toolbar(ui, doc, found.as_deref()));
        let Some(found) = found.filter(|found| !found.rows.is_empty()) else {
            nothing_yet(ui, doc, &self.sweeping);
            return;
        };
        // All rows are from this process.
        let best = answers(&found.rows, self.shown).unwrap_or_default();
        for answer in &best {
            let sentence = shown::in_words(&answer.sentence(self.shown));
            ui.add(egui::Label::new(sentence).wrap());
        }
        let best: Vec<&Row> = best.iter().map(|answer| answer.best).collect();
        let size = crate::gui::widgets::common::rest_of(ui);
        let wide = size.x >= WIDE;
        let parts = if wide { 2.0 } else { 1.0 };
        let part = vec2((size.x - 8.0 * (parts - 1.0)) / parts, size.y - 2.0);
        let shown = Shown {
            rows: &found.rows,
            parameter: self.shown,
            best: &best,
            chosen: self.sweeping.chosen,
        };
        let mut click = None;
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 8.0;
            let mut column = |show: fn(&mut egui::Ui, &Shown<'_>) -> Option<usize>| {
                ui.allocate_ui_with_layout(part, egui::Layout::top_down(egui::Align::Min), |ui| {
                    ui.set_min_size(part);
                    click = click.or(show(ui, &shown));
                });
            };
            if wide || !self.map_first {
                column(plot::show);
            }
            if wide || self.map_first {
                column(map::show);
            }
        });
        if let Some(place) = click {
            self.choose(place, cx.edits);
        }
    }
}

/// Says what is happening, or what to do, while there are no rows.
fn nothing_yet(ui: &mut egui::Ui, doc: &Document, sweeping: &Sweeping) {
    if doc.current.is_none() {
        no_picture(ui, doc);
    } else if sweeping.study.is_running() {
        busy(ui, "Measuring the first point…");
    } else {
        ui.weak("Which depth, which leaf size? Every parameter over a grid of settings.");
    }
}

impl SweepPane {
    fn turn(&mut self, forward: bool) {
        let all: Vec<_> = choices().collect();
        let at = all.iter().position(|p| p.symbol == self.shown.symbol);
        let step = if forward { 1 } else { all.len() - 1 };
        self.shown = all[(at.unwrap_or(0) + step) % all.len()];
    }

    /// Loads the settings of a row into tree A.
    fn choose(&mut self, place: usize, edits: &mut Edits) {
        if let Some(setup) = self.sweeping.choose(place) {
            edits.add(|doc| {
                doc.show(Which::A);
                doc.wanted = setup;
            });
        }
    }

    fn toolbar(&mut self, ui: &mut egui::Ui, doc: &Document, found: Option<&Found>) {
        let status = self.sweeping.study.status();
        if status.is_some() {
            let about = "Cancel the sweep. Its rows stay, and it can be resumed.";
            if ui
                .button("Cancel sweep")
                .on_hover_text(tip(about, "window.cancel"))
                .clicked()
            {
                self.sweeping.study.cancel();
            }
            ui.ctx().request_repaint_after_secs(0.2);
        } else {
            let run = ui.add_enabled(self.sweeping.may_start(doc), egui::Button::new("Run sweep"));
            let about = "Measure the scene on view with all of these settings, in the background, while \
                         nothing else is measured. A sweep that was cancelled is resumed.";
            if run
                .on_hover_text(tip(about, "sweep.run"))
                .on_disabled_hover_text(
                    "Needs a finished picture, a method, and leaf sizes such as 1, 2, 4.",
                )
                .clicked()
            {
                self.sweeping.start(doc);
            }
        }
        settings(ui, &mut self.sweeping, status.is_none());
        let said = match (status, self.sweeping.study.end()) {
            (Some(status), _) => {
                let waits = match status.standing {
                    Standing::Running => "",
                    Standing::Waiting | Standing::Paused => ", waiting",
                };
                format!("{}{waits}", Digits::Three.percent(status.fraction))
            }
            (None, Some(End::Cancelled)) => "cancelled: the rows stay".to_owned(),
            (None, Some(End::Failed(why))) => format!("failed: {why}"),
            (None, Some(End::Done(()) | End::Replaced) | None) => String::new(),
        };
        if let Some(found) = found {
            let (done, of) = (found.rows.len(), found.plan.points.len());
            ui.label(format!("{done} of {of} points {said}").trim_end());
        }
        egui::ComboBox::from_id_salt("parameter of the sweep")
            .selected_text(format!("Show: {}", self.shown.symbol))
            .show_ui(ui, |ui| {
                for p in choices() {
                    let chosen = p.symbol == self.shown.symbol;
                    let item = ui.selectable_label(chosen, format!("{}: {}", p.symbol, p.name));
                    if item.on_hover_text(p.meaning).clicked() {
                        self.shown = p;
                    }
                }
            })
            .response
            .accessible_name("Parameter of the sweep")
            .on_hover_text(tip(
                &format!("{}: {}", self.shown.name, self.shown.meaning),
                "sweep.next-parameter",
            ));
        if ui.max_rect().width() < WIDE {
            for (map, name) in [(false, "Curves"), (true, "Map")] {
                ui.selectable_value(&mut self.map_first, map, name)
                    .on_hover_text(tip("How the parameter is shown.", "sweep.sweep-map"));
            }
        }
        if let Some(found) = found.filter(|found| !found.rows.is_empty()) {
            save(ui, &mut self.sweeping.saving, &doc.jobs, found);
        }
    }
}

/// What the next sweep is over; stays in its place while one runs, so that nothing moves.
fn settings(ui: &mut egui::Ui, sweeping: &mut Sweeping, may_change: bool) {
    let [from, to] = &mut sweeping.depths;
    ui.label("Depth")
        .on_hover_text("D_MAX, from the least to the greatest");
    for (depth, name) in [(from, "Least depth"), (to, "Greatest depth")] {
        let edit = egui::DragValue::new(depth)
            .range(0..=MaxDepth::LIMIT)
            .speed(0.1);
        ui.add_enabled(may_change, edit)
            .accessible_name(name)
            .on_hover_text(name);
    }
    ui.label("Leaf size")
        .on_hover_text("N_OILF, separated by commas, such as 1, 2, 4");
    let field = egui::TextEdit::singleline(&mut sweeping.leaf_sizes).desired_width(80.0);
    ui.add_enabled(may_change, field)
        .accessible_name("Leaf sizes of the sweep")
        .on_hover_text("Leaf sizes, separated by commas, such as 1, 2, 4");
    let text = format!("Methods: {}", sweeping.methods.len());
    let methods = |ui: &mut egui::Ui| {
        for (family, methods) in Method::families() {
            choice_list::group(ui, family);
            for method in methods {
                let mut chosen = sweeping.methods.contains(&method);
                if ui
                    .checkbox(&mut chosen, method.name)
                    .on_hover_text(method.summary)
                    .changed()
                {
                    sweeping.methods.retain(|known| *known != method);
                    if chosen {
                        sweeping.methods.push(method);
                    }
                }
            }
        }
    };
    ui.add_enabled_ui(may_change, |ui| ui.menu_button(text, methods).response)
        .inner
        .on_hover_text("Build methods, in the order in which they were chosen");
}

/// Where the rows go.
fn save(ui: &mut egui::Ui, saving: &mut Saving, jobs: &Scheduler, found: &Found) {
    let field = egui::TextEdit::singleline(&mut saving.path)
        .hint_text("rows.csv")
        .desired_width(110.0);
    ui.add(field)
        .accessible_name("File for the rows")
        .on_hover_text(
            "A file, .csv or .jsonl for JSON lines, as bspscope sweep writes and merges them",
        );
    if ui
        .button("Save rows")
        .on_hover_text("Write the rows to the file; one that is there is replaced.")
        .clicked()
    {
        saving.save(&found.rows, jobs);
    }
    if let Some(said) = &saving.said {
        ui.label(said);
    }
}
