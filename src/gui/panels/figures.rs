//! The septet Δ and the triplet Λ of what is on view.

use super::{Panel, Side};
use crate::gui::state::{Current, State};
use crate::gui::symbol::symbol;
use crate::measure::{Class, DELTA, LAMBDA, Parameter, parameter};

pub(super) const DELTA_PANEL: Panel = Panel {
    title: "Δ  the tree in seven figures",
    side: Side::Right,
    open: true,
    show: delta,
};

pub(super) const LAMBDA_PANEL: Panel = Panel {
    title: "Λ  the times",
    side: Side::Right,
    open: true,
    show: lambda,
};

/// Whether a value can still change while rays are being counted.
fn is_provisional(parameter: &Parameter, current: &Current) -> bool {
    let from_rays = matches!(parameter.class, Class::R | Class::D | Class::T);
    let from_build = parameter.symbol.starts_with("T_CB");
    !current.complete && from_rays && !from_build
}

/// A value; one that can still change has an ellipsis and is in italics.
pub(super) fn value(ui: &mut egui::Ui, parameter: &Parameter, current: &Current) {
    let text = parameter.format(parameter.value(&current.shown.measurement));
    let text = egui::RichText::new(text).monospace();
    if is_provisional(parameter, current) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            ui.label(text.italics());
            ui.label("…")
                .on_hover_text("Provisional: rays are still being counted");
        });
    } else {
        ui.label(text);
    }
}

/// Whose figures these are, and whether they are final.
pub(super) fn standing(ui: &mut egui::Ui, state: &State, current: &Current) {
    let mut text = if current.complete {
        "complete".to_owned()
    } else if state.stopped {
        "… provisional (stopped)".to_owned()
    } else {
        "… provisional".to_owned()
    };
    if state.is_previous() {
        text += " · previous settings";
    }
    ui.label(egui::RichText::new(text).strong())
        .on_hover_text(current.settings_text());
}

fn delta(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        ui.weak("No figures yet");
        return;
    };
    standing(ui, state, current);
    egui::Grid::new("delta")
        .num_columns(3)
        .striped(true)
        .show(ui, |ui| {
            for p in DELTA.map(parameter) {
                symbol(ui, p, &current.shown.measurement);
                ui.label(p.name);
                value(ui, p, current);
                ui.end_row();
            }
        });
}

fn lambda(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        ui.weak("No times yet");
        return;
    };
    standing(ui, state, current);
    egui::Grid::new("lambda")
        .num_columns(4)
        .striped(true)
        .show(ui, |ui| {
            for title in ["", "", "CPU", "wall"] {
                ui.label(title).on_hover_text(match title {
                    "CPU" => "Time of all threads together",
                    "wall" => "Wall-clock time",
                    _ => "",
                });
            }
            ui.end_row();
            for p in LAMBDA.map(parameter) {
                symbol(ui, p, &current.shown.measurement);
                ui.label(p.name);
                value(ui, p, current);
                match p.symbol {
                    "T_CB" => value(ui, parameter("T_CB_WALL"), current),
                    "T_TR" => value(ui, parameter("T_TR_WALL"), current),
                    _ => {}
                }
                ui.end_row();
            }
        });
    let used = current.shown.setup.render.kernel.description();
    ui.weak(format!("Timed kernel: {used}"))
        .on_hover_text("How timed passes walk rays through the tree; chosen under Picture");
}
