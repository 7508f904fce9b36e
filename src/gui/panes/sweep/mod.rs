//! Which depth, which leaf size? A parameter over a grid of settings, as curves and as a map. Choosing
//! a point loads its settings.

mod map;
mod plot;
mod study;

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::pane::{Cx, Pane, PaneAction};

use crate::jobs::{End, Scheduler, Standing};
use crate::measure::sweep::{Row, answers, rule_depth};
use crate::measure::{Class, Parameter, parameter, parameters};
use crate::structure::{MaxDepth, Method};
use egui::vec2;
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
    const TITLE: &'static str = "Depth and leaf size";
    const ALIASES: &'static [&'static str] = &["Sweep"];
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
        let doc = &mut *cx.doc;
        let found = self.sweeping.study.found().cloned();
        ui.horizontal_wrapped(|ui| self.toolbar(ui, doc, found.as_deref()));
        let Some(found) = found.filter(|found| !found.rows.is_empty()) else {
            ui.weak("Which depth, which leaf size? Every parameter over a grid of settings.");
            return;
        };
        let best = answers(&found.rows, self.shown);
        for answer in &best {
            ui.add(egui::Label::new(answer.sentence(self.shown)).wrap());
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
            self.choose(place, doc);
        }
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
    fn choose(&mut self, place: usize, doc: &mut Document) {
        if let Some(setup) = self.sweeping.choose(place) {
            doc.show(Which::A);
            doc.wanted = setup;
        }
    }

    fn toolbar(&mut self, ui: &mut egui::Ui, doc: &mut Document, found: Option<&Found>) {
        let status = self.sweeping.study.status();
        if status.is_some() {
            let about = "End the sweep; its rows stay, and it can be gone on with.";
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
            let about = "Measure the scene on view over all of these settings, in the background, while \
                         nothing else is measured. One that was cancelled goes on.";
            if run
                .on_hover_text(tip(about, "sweep.run"))
                .on_disabled_hover_text(
                    "Begins with a finished picture, a method, and leaf sizes such as 1, 2, 4.",
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
                    Standing::Waiting | Standing::Paused => ", waits",
                };
                format!("{:.0} %{waits}", status.fraction * 100.0)
            }
            (None, Some(End::Cancelled)) => "cancelled: the rows stay".to_owned(),
            (None, Some(End::Failed(why))) => format!("ended: {why}"),
            (None, Some(End::Done(()) | End::Replaced) | None) => String::new(),
        };
        if let Some(found) = found {
            let (done, of) = (found.rows.len(), found.plan.points.len());
            ui.label(format!("{done} of {of} points {said}"));
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

/// What the next sweep is over; stays in its place while one is taken, so that nothing jumps.
fn settings(ui: &mut egui::Ui, sweeping: &mut Sweeping, may_change: bool) {
    let [from, to] = &mut sweeping.depths;
    ui.label("D_MAX")
        .on_hover_text("Greatest depths, from least to most");
    for (depth, name) in [(from, "Least D_MAX"), (to, "Greatest D_MAX")] {
        let edit = egui::DragValue::new(depth)
            .range(0..=MaxDepth::LIMIT)
            .speed(0.1);
        ui.add_enabled(may_change, edit)
            .accessible_name(name)
            .on_hover_text(name);
    }
    ui.label("N_OILF")
        .on_hover_text("Leaf sizes, separated by commas");
    let field = egui::TextEdit::singleline(&mut sweeping.leaf_sizes).desired_width(80.0);
    ui.add_enabled(may_change, field)
        .accessible_name("Leaf sizes of the sweep")
        .on_hover_text("Leaf sizes, separated by commas, such as 1, 2, 4");
    let text = format!("Methods: {}", sweeping.methods.len());
    let methods = |ui: &mut egui::Ui| {
        for method in Method::all() {
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

/// What curves and map show.
struct Shown<'a> {
    rows: &'a [Row],
    parameter: &'static Parameter,
    /// Of every method.
    best: &'a [&'a Row],
    /// The row that was loaded last.
    chosen: Option<usize>,
}

impl Shown<'_> {
    /// The depth that the rule 1.2 log2 N + 2 gives.
    fn rule(&self) -> Option<u32> {
        self.rows.first().and_then(rule_depth)
    }

    fn is_best(&self, row: &Row) -> bool {
        self.best.iter().any(|best| best.point == row.point)
    }

    /// A row in words.
    fn words(&self, row: &Row) -> String {
        let depth = parameter("D_MAX");
        format!(
            "{}, D_MAX {}, N_OILF {}: {} {}{}",
            row.key.method,
            depth.format(row.value(depth)),
            row.key.n_oilf,
            self.parameter.symbol,
            self.parameter.format(row.value(self.parameter)),
            if self.is_best(row) { " (least)" } else { "" }
        )
    }
}
