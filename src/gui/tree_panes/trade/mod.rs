//! The trade of time for accuracy: every choice as a point of a plot and a row of a table, and the
//! chosen one's error of every pixel. Choosing one loads its settings.

mod error_map;
mod plot;
mod table;

use super::is_under_pointer;
use crate::gui::shortcuts::{Action, Scope, pressed, tip};
use crate::gui::state::State;
use crate::gui::trading::Found;
use crate::jobs::{End, Standing};
use crate::measure::accuracy::{AccuracyStudy, ERROR_MEASURES, ErrorMeasure, Outcome};
use crate::present::number::significant;
use egui::vec2;

/// From this width on, in points, table and error map both stand beside the plot.
const WIDE: f32 = 1000.0;

#[derive(Default)]
pub struct TradePane {
    /// Place in [`ERROR_MEASURES`].
    error: usize,
    /// Whether the error map stands in the table's place, where there is not room for both.
    map_first: bool,
    map: error_map::ErrorMap,
    /// The outcome that the table was scrolled to.
    followed: Option<usize>,
}

impl TradePane {
    pub fn ui(&mut self, ui: &mut egui::Ui, state: &mut State) {
        for action in pressed(ui.ctx(), Scope::Trade, is_under_pointer(ui)) {
            self.act(action, state);
        }
        let found = state.trading.study.found().cloned();
        ui.horizontal_wrapped(|ui| self.toolbar(ui, state));
        let Some(found) = found.filter(|found| !found.trade.outcomes.is_empty()) else {
            ui.weak(
                "What does accuracy cost? Every choice that buys time with it, alone and together, \
                 against a reference.",
            );
            return;
        };
        ui.add(egui::Label::new(about(&found)).truncate());
        let measure = &ERROR_MEASURES[self.error];
        let front = found.trade.front_by(measure);
        let size = crate::gui::rest_of(ui);
        let wide = size.x >= WIDE;
        let parts = if wide { 3.0 } else { 2.0 };
        let part = vec2((size.x - 8.0 * (parts - 1.0)) / parts, size.y - 2.0);
        let chosen = state.trading.chosen;
        let mut click = None;
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
                column(&mut |ui| self.map.ui(ui, &found, state));
            }
        });
        if let Some(place) = click {
            state.choose_outcome(place);
        }
    }

    fn act(&mut self, action: Action, state: &mut State) {
        match action {
            Action::RunTrade => state.begin_trade(),
            Action::NextOutcome | Action::PreviousOutcome => {
                let next = match (state.trading.chosen, action) {
                    (None, _) => 0,
                    (Some(at), Action::NextOutcome) => at + 1,
                    (Some(at), _) => at.saturating_sub(1),
                };
                state.choose_outcome(next);
            }
            Action::NextError => self.error = (self.error + 1) % ERROR_MEASURES.len(),
            Action::ErrorMap => self.map_first ^= true,
            _ => {}
        }
    }

    fn toolbar(&mut self, ui: &mut egui::Ui, state: &mut State) {
        if let Some(status) = state.trading.study.status() {
            if ui
                .button("Cancel trade")
                .on_hover_text(tip(
                    "End the trade; what is known of it stays.",
                    Action::Cancel,
                ))
                .clicked()
            {
                state.trading.study.cancel();
            }
            ui.label(format!("{:.0} %", status.fraction * 100.0));
            ui.weak(match status.standing {
                Standing::Running => "taking times …",
                Standing::Waiting | Standing::Paused => "waits for the picture",
            });
            ui.ctx().request_repaint_after_secs(0.2);
        } else {
            let run = ui.add_enabled(state.may_trade(), egui::Button::new("Run trade"));
            let about = "Trace the scene on view with every choice that trades accuracy for time, in \
                         the background, while nothing else is traced.";
            if run
                .on_hover_text(tip(about, Action::RunTrade))
                .on_disabled_hover_text("Begins with a finished picture.")
                .clicked()
            {
                state.begin_trade();
            }
            for (value, most, suffix, name, about) in [
                (
                    &mut state.trading.samples,
                    256,
                    " samples",
                    "Samples of the reference",
                    "Samples a pixel of the reference.",
                ),
                (
                    &mut state.trading.rounds,
                    99,
                    " rounds",
                    "Rounds of the trade",
                    "Rounds in which every choice is timed once; the median counts.",
                ),
            ] {
                let edit = egui::DragValue::new(value).range(1..=most).speed(0.1);
                ui.add(edit.suffix(suffix))
                    .accessible_name(name)
                    .on_hover_text(about);
            }
            match state.trading.study.end() {
                Some(End::Cancelled) => {
                    ui.label("cancelled: what was found stays");
                }
                Some(End::Failed(why)) => {
                    ui.label(format!("ended: {why}"));
                }
                Some(End::Done(()) | End::Replaced) | None => {}
            }
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
            .on_hover_text(tip(ERROR_MEASURES[self.error].about, Action::NextError));
        if ui.max_rect().width() < WIDE {
            for (map, name) in [(false, "Table"), (true, "Error map")] {
                ui.selectable_value(&mut self.map_first, map, name)
                    .on_hover_text(tip("What stands beside the plot.", Action::ErrorMap));
            }
        }
    }
}

/// What the trade is of.
fn about(found: &Found) -> String {
    let first = &found.trade.outcomes[0];
    let render = &first.choice.setup.render;
    format!(
        "{} · reference: f64, exact shapes, D_AREC {}, {} samples a pixel, {} × {} pixels, {}: {} s of \
         CPU time · {} of {} turns",
        found.of.scene.source,
        render.d_arec,
        render.samples,
        render.width,
        render.height,
        first.choice.setup.build.method.name,
        significant(first.median()),
        found.taken,
        found.steps,
    )
}

/// An outcome in words: its choice, its time and its error by one measure.
fn words(trade: &AccuracyStudy, outcome: &Outcome, measure: &ErrorMeasure) -> String {
    format!(
        "{}: {:.3} of the reference's time, {} {}",
        outcome.choice.words(),
        trade.ratios(outcome)[1],
        measure.name,
        significant((measure.value)(outcome))
    )
}
