//! All parameters of the paper's Tables 1 to 3, and those beside them.

use crate::gui::document::Figures;
use crate::gui::pane::{Cx, Pane};
use crate::gui::theme::{heading, hint, tokens};
use crate::gui::widgets::common::sentence;
use crate::gui::widgets::symbol::explain;
use crate::gui::widgets::value_row::{HEIGHT, Value, ValueRow};
use crate::measure::{Table, parameters};

/// The least width of a table in points.
const TABLE: f32 = 360.0;

/// Width of the values.
const VALUE: f32 = 120.0;

#[derive(Default)]
pub struct ParametersPane;

impl Pane for ParametersPane {
    const ID: &'static str = "parameters";
    const TITLE: &'static str = "All figures";
    const ALIASES: &'static [&'static str] = &["All parameters (Tables 1 to 3)"];
    const ABOUT: &'static str = "All parameters of the paper's Tables 1 to 3.";

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let Some(figures) = doc.figures(doc.which) else {
            ui.weak("No figures yet");
            return;
        };
        egui::ScrollArea::vertical()
            .id_salt("parameters")
            .auto_shrink(false)
            .show(ui, |ui| tables(ui, &figures));
    }
}

/// Shows the tables, as many beside each other as there is room for.
fn tables(ui: &mut egui::Ui, figures: &Figures<'_>) {
    const TABLES: [Table; 4] = [Table::Scene, Table::Static, Table::Dynamic, Table::Ours];
    if !figures.are_current {
        ui.label(hint(
            "Of earlier settings: the new figures are being measured.",
        ));
    }
    let count = ((ui.available_width() / TABLE) as usize).clamp(1, TABLES.len());
    ui.spacing_mut().item_spacing.x = 24.0;
    ui.columns(count, |columns| {
        for (i, of) in TABLES.into_iter().enumerate() {
            // The longest table, the third, is alone in its column if there are three.
            let place = if count == 3 && i == 3 { 0 } else { i % count };
            table(&mut columns[place], of, figures);
        }
    });
}

fn table(ui: &mut egui::Ui, of: Table, figures: &Figures<'_>) {
    let t = tokens(ui);
    let measurement = &figures.now.measurement;
    ui.spacing_mut().item_spacing.y = 0.0;
    ui.label(heading(of.title()));
    ui.add_space(4.0);
    let rows = parameters().iter().filter(|p| p.table == of);
    for (i, parameter) in rows.enumerate() {
        let row = ValueRow {
            name: &sentence(parameter.name),
            symbol: parameter.symbol,
            values: &[Value {
                text: parameter.format(parameter.value(measurement)),
                color: if figures.are_current { t.text } else { t.hint },
                width: VALUE,
            }],
            height: HEIGHT,
            striped: i % 2 == 1,
        };
        row.show(ui)
            .on_hover_ui(|ui| explain(ui, parameter, measurement));
    }
    ui.add_space(12.0);
}
