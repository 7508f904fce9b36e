//! All parameters of the paper's Tables 1 to 3, and those beside them.

use super::figures::{standing, value};
use super::{Panel, Side};
use crate::gui::state::State;
use crate::gui::symbol::symbol;
use crate::measure::{Table, parameters};

pub(super) const PANEL: Panel = Panel {
    title: "All parameters (Tables 1 to 3)",
    side: Side::Right,
    open: false,
    show,
};

fn show(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        ui.weak("No figures yet");
        return;
    };
    standing(ui, state, current);
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
