//! The panels beside the panes. A panel is one file here and one line in [`PANELS`].

mod build_settings;
mod comparison;
mod figures;
mod judge;
mod notes;
pub mod paper;
mod parameters;
mod picture_settings;
mod pixel;
mod rays;
mod scene_facts;
mod walk;

use super::state::State;
use std::collections::BTreeMap;

/// Where a panel stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
}

/// A part of a side bar that can be folded.
pub struct Panel {
    pub title: &'static str,
    pub side: Side,
    /// Whether it is unfolded at first.
    pub open: bool,
    pub show: fn(&mut egui::Ui, &mut State),
}

/// All panels, from top to bottom.
pub static PANELS: &[Panel] = &[
    build_settings::PANEL,
    picture_settings::PANEL,
    scene_facts::PANEL,
    notes::PANEL,
    comparison::PANEL,
    judge::PANEL,
    figures::DELTA_PANEL,
    figures::LAMBDA_PANEL,
    pixel::PANEL,
    rays::PANEL,
    walk::PANEL,
    parameters::PANEL,
    paper::PANEL,
];

/// Shows the panels of one side; `unfolded` says by title which were folded or unfolded. The panel of
/// the title in `sought` is brought to the top, once.
pub fn show(
    ui: &mut egui::Ui,
    side: Side,
    state: &mut State,
    unfolded: &mut BTreeMap<String, bool>,
    sought: &mut Option<&'static str>,
) {
    egui::ScrollArea::vertical()
        .auto_shrink(false)
        .show(ui, |ui| {
            for panel in PANELS.iter().filter(|panel| panel.side == side) {
                let open = unfolded.get(panel.title).copied().unwrap_or(panel.open);
                let shown = egui::CollapsingHeader::new(egui::RichText::new(panel.title).strong())
                    .open(Some(open))
                    .show_unindented(ui, |ui| (panel.show)(ui, state));
                if sought.take_if(|title| *title == panel.title).is_some() {
                    shown.header_response.scroll_to_me(Some(egui::Align::TOP));
                }
                if shown.header_response.clicked() {
                    unfolded.insert(panel.title.to_owned(), !open);
                }
            }
        });
}

/// A row of a two-column grid: a name and a widget that goes by it.
pub(super) fn row<R>(
    ui: &mut egui::Ui,
    name: &str,
    about: &str,
    widget: impl FnOnce(&mut egui::Ui) -> R,
) -> R {
    ui.label(name).on_hover_text(about);
    let result = ui.horizontal(|ui| ui.name_inputs(name, widget)).inner;
    ui.end_row();
    result
}
