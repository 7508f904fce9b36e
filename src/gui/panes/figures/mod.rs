//! The septet Δ and the triplet Λ of what is on view.

mod export;

use crate::gui::action::actions;
use crate::gui::document::{Current, Document};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::symbol::symbol;
use crate::measure::{Class, DELTA, LAMBDA, Parameter, parameter};

/// The figures of the picture on view.
#[derive(Default)]
pub struct FiguresPane;

impl Pane for FiguresPane {
    const ID: &'static str = "figures";
    const TITLE: &'static str = "Figures";
    const ALIASES: &'static [&'static str] = &["Δ  the tree in seven figures", "Λ  the times"];
    const ABOUT: &'static str = "The septet Δ of counts and the triplet Λ of times.";
    const REVEALS: &'static [Fact] = &[Fact::Counters(&DELTA), Fact::Counters(&LAMBDA)];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "figures.export" Everywhere ALT [Num4] "Export the figures: text, JSON, CSV, Markdown, LaTeX" => |_, cx| {
            let export = export::figures(cx.doc, cx.ctx);
            cx.edits.request(Request::Export(Box::new(export)));
        };
        "figures.export-report" Everywhere ALT [Num6] "Export a report: one HTML file" => |_, cx| {
            let export = export::page(cx.doc, cx.ctx);
            cx.edits.request(Request::Export(Box::new(export)));
        };
    };

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        delta(ui, cx.doc);
        ui.add_space(8.0);
        lambda(ui, cx.doc);
    }
}

/// Whether a value can still change while rays are being counted.
fn is_provisional(parameter: &Parameter, current: &Current) -> bool {
    let from_rays = matches!(parameter.class, Class::R | Class::D | Class::T);
    let from_build = parameter.symbol.starts_with("T_CB");
    !current.complete && from_rays && !from_build
}

/// A value; one that can still change has an ellipsis and is in italics.
pub fn value(ui: &mut egui::Ui, parameter: &Parameter, current: &Current) {
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
pub fn standing(ui: &mut egui::Ui, doc: &Document, current: &Current) {
    let mut text = if current.complete {
        "complete".to_owned()
    } else if doc.stopped {
        "… provisional (stopped)".to_owned()
    } else {
        "… provisional".to_owned()
    };
    if doc.is_previous() {
        text += " · previous settings";
    }
    ui.label(egui::RichText::new(text).strong())
        .on_hover_text(current.settings_text());
}

fn delta(ui: &mut egui::Ui, doc: &mut Document) {
    let Some(current) = &doc.current else {
        ui.weak("No figures yet");
        return;
    };
    standing(ui, doc, current);
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

fn lambda(ui: &mut egui::Ui, doc: &mut Document) {
    let Some(current) = &doc.current else {
        ui.weak("No times yet");
        return;
    };
    standing(ui, doc, current);
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
