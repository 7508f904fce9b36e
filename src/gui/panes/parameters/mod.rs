//! All parameters of the paper's Tables 1 to 3, and those beside them.

use crate::gui::document::Document;
use crate::gui::pane::{Cx, Pane};
use crate::gui::panes::figures::{standing, value};
use crate::gui::widgets::symbol::symbol;
use crate::measure::{Table, parameters};

#[derive(Default)]
pub struct ParametersPane;

impl Pane for ParametersPane {
    const ID: &'static str = "parameters";
    const TITLE: &'static str = "All figures";
    const ALIASES: &'static [&'static str] = &["All parameters (Tables 1 to 3)"];
    const ABOUT: &'static str = "All parameters of the paper's Tables 1 to 3.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        show(ui, cx.doc);
    }
}

fn show(ui: &mut egui::Ui, doc: &mut Document) {
    let Some(current) = &doc.current else {
        ui.weak("No figures yet");
        return;
    };
    standing(ui, doc, current);
    for table in [Table::Scene, Table::Static, Table::Dynamic, Table::Ours] {
        ui.add_space(4.0);
        ui.label(egui::RichText::new(table.title()).underline());
        egui::Grid::new(table.title())
            .num_columns(3)
            .striped(true)
            .show(ui, |ui| {
                for p in parameters().iter().filter(|p| p.table == table) {
                    symbol(ui, p, &current.shown.measurement);
                    ui.add(egui::Label::new(p.name).truncate());
                    value(ui, p, current);
                    ui.end_row();
                }
            });
    }
}
