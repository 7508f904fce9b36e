//! Accuracy vs. time: every choice as a point of a plot and a row of a table, and the error of every
//! pixel for the chosen one. A click on a choice loads its settings.

mod error_map;
mod plot;
mod study;
mod table;
mod words;

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::widgets::common::{busy, no_picture};
use crate::gui::widgets::study_bar;
use crate::measure::accuracy::ERROR_MEASURES;
use crate::present::number::{counted, significant};
use egui::vec2;
use study::{Found, Trading};

/// From this width on, in points, table and error map both stand beside the plot.
const WIDE: f32 = 1000.0;

#[derive(Default)]
pub struct AccuracyPane {
    trading: Trading,
    /// Place in [`ERROR_MEASURES`].
    error: usize,
    /// Whether the error map stands in the table's place, where there is not room for both.
    map_first: bool,
    map: error_map::ErrorMap,
    /// The outcome that the table was scrolled to.
    followed: Option<usize>,
}

impl Pane for AccuracyPane {
    const ID: &'static str = "accuracy";
    const TITLE: &'static str = "Speed and error";
    const ALIASES: &'static [&'static str] = &["Trade"];
    const ABOUT: &'static str = "What each choice that trades accuracy for speed costs and saves.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "accuracy.run" Here NONE [Enter] "Measure speed and error; Esc ends it" => |pane, cx| pane.trading.start(cx.doc);
        "accuracy.previous-outcome" Here NONE [ArrowUp] "Load the settings of the previous outcome" => |pane, cx| pane.step(false, cx.edits);
        "accuracy.next-outcome" Here NONE [ArrowDown] "Load the settings of the next outcome" => |pane, cx| pane.step(true, cx.edits);
        "accuracy.next-error" Here NONE [E] "Show the next measure of the error" => |pane, _| pane.error = (pane.error + 1) % ERROR_MEASURES.len();
        "accuracy.error-map" Here NONE [M] "Show the table of outcomes or the error of every pixel" => |pane, _| pane.map_first ^= true;
    };

    fn update(&mut self, _: &mut Cx<'_>) {
        self.trading.receive();
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let found = self.trading.study.found().cloned();
        ui.horizontal_wrapped(|ui| self.toolbar(ui, doc));
        let Some(found) = found.filter(|found| !found.trade.outcomes.is_empty()) else {
            if doc.current.is_none() {
                no_picture(ui, doc);
            } else if self.trading.study.is_running() {
                busy(ui, "Rendering the reference…");
            } else {
                ui.weak(
                    "What does accuracy cost? The error and rendering time of every setting that gives \
                     up accuracy for speed, compared with a reference.",
                );
            }
            return;
        };
        ui.add(egui::Label::new(about(&found)).wrap());
        let measure = &ERROR_MEASURES[self.error];
        let front = found.trade.front_by(measure);
        let size = crate::gui::widgets::common::rest_of(ui);
        let wide = size.x >= WIDE;
        let parts = if wide { 3.0 } else { 2.0 };
        let part = vec2((size.x - 8.0 * (parts - 1.0)) / parts, size.y - 2.0);
        let chosen = self.trading.chosen;
        let mut click = None;
        let mut picked = None;
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 8.0;
            let mut column = |add: &mut dyn FnMut(&mut egui::Ui)| {
                ui.allocate_ui_with_layout(part, egui::Layout::top_down(egui::Align::Min), |ui| {
                    ui.set_min_size(part);
                    add(ui);
                });
            };
            let trade = &found.trade;
            column(&mut |ui| {
                click = click.or(plot::show(ui, trade, measure, &front, chosen));
            });
            if wide || !self.map_first {
                let scroll = chosen.filter(|_| self.followed != chosen);
                self.followed = chosen;
                column(&mut |ui| {
                    click = click.or(table::show(ui, trade, &front, chosen, scroll));
                });
            }
            if wide || self.map_first {
                column(&mut |ui| picked = self.map.ui(ui, &found, chosen).or(picked));
            }
        });
        if let Some(place) = click {
            self.choose(place, cx.edits);
        }
        if let Some(pixel) = picked {
            let size = found.size();
            cx.edits.add(move |doc| {
                if let Some(current) = &mut doc.current {
                    let render = &current.shown.setup.render;
                    if Some([render.width, render.height]) == size {
                        current.pick(pixel);
                    }
                }
            });
        }
    }
}

impl AccuracyPane {
    /// Chooses the next outcome or the previous one; the first if none is chosen.
    fn step(&mut self, forward: bool, edits: &mut Edits) {
        let next = match self.trading.chosen {
            None => 0,
            Some(at) if forward => at + 1,
            Some(at) => at.saturating_sub(1),
        };
        self.choose(next, edits);
    }

    fn choose(&mut self, place: usize, edits: &mut Edits) {
        if let Some(mut setup) = self.trading.choose(place) {
            edits.add(|doc| {
                setup.render.threads = doc.wanted.render.threads;
                doc.wanted = setup;
            });
        }
    }

    fn toolbar(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let words = [
            "Cancel",
            "Cancel the measurement; what was measured stays.",
            "waiting for the picture",
        ];
        if !study_bar::running(ui, &mut self.trading.study, words) {
            let run = egui::Button::new("Measure speed and error");
            let run = ui.add_enabled(self.trading.may_start(doc), run);
            let about = "Render the scene on view with every setting that gives up accuracy for speed, \
                         in the background, while nothing else is measured.";
            if run
                .on_hover_text(tip(about, "accuracy.run"))
                .on_disabled_hover_text("Needs a finished picture.")
                .clicked()
            {
                self.trading.start(doc);
            }
            for (value, most, suffix, name, about) in [
                (
                    &mut self.trading.samples,
                    256,
                    " samples",
                    "Samples of the reference",
                    "Samples per pixel of the reference.",
                ),
                (
                    &mut self.trading.rounds,
                    99,
                    " rounds",
                    "Rounds",
                    "Rounds in which every choice is timed once. The time is the median.",
                ),
            ] {
                let edit = egui::DragValue::new(value).range(1..=most).speed(0.1);
                ui.add(edit.suffix(suffix))
                    .accessible_name(name)
                    .on_hover_text(about);
            }
            let cancelled = "cancelled: what was measured stays";
            study_bar::ended(ui, &self.trading.study, cancelled);
        }
        egui::ComboBox::from_id_salt("error measure")
            .selected_text(format!("Error: {}", ERROR_MEASURES[self.error].name))
            .show_ui(ui, |ui| {
                for (place, measure) in ERROR_MEASURES.iter().enumerate() {
                    ui.selectable_value(&mut self.error, place, measure.name)
                        .on_hover_text(measure.about);
                }
            })
            .response
            .accessible_name("Measure of the error")
            .on_hover_text(tip(ERROR_MEASURES[self.error].about, "accuracy.next-error"));
        if ui.max_rect().width() < WIDE {
            for (map, name) in [(false, "Table"), (true, "Error map")] {
                ui.selectable_value(&mut self.map_first, map, name)
                    .on_hover_text(tip("What stands beside the plot.", "accuracy.error-map"));
            }
        }
    }
}

/// What was measured, and how far.
fn about(found: &Found) -> String {
    let first = &found.trade.outcomes[0];
    let render = &first.choice.setup.render;
    let samples = counted(render.samples as usize, "sample") + " per pixel";
    format!(
        "{} · reference: f64, exact shapes, {} bounces, {}, {} × {} pixels, {}: {} s of \
         CPU time · {} of {} turns",
        found.of.scene.source,
        render.d_arec,
        samples,
        render.width,
        render.height,
        first.choice.setup.build.method.name,
        significant(first.median()),
        found.taken,
        found.steps,
    )
}
