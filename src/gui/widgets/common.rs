//! Small pieces that several panes share.

use crate::gui::document::Document;

/// Says that figures of the nodes are being computed.
pub fn waiting(ui: &mut egui::Ui) {
    busy(ui, "Computing the figures of the nodes…");
}

/// Says why there is nothing to show before the first picture.
pub fn no_picture(ui: &mut egui::Ui, doc: &Document) {
    if doc.work.is_some() || doc.failure.is_none() && !doc.stopped {
        busy(ui, "Loading the scene…");
    } else {
        ui.weak("There is no scene yet. Open one in the menu at the top left.");
    }
}

/// Says what is being done.
pub fn busy(ui: &mut egui::Ui, what: &str) {
    ui.horizontal(|ui| {
        ui.spinner();
        ui.label(what);
    });
}

/// Returns a name as it begins a line: with a capital, except for a symbol or a unit.
pub fn sentence(name: &str) -> String {
    let mut rest = name.chars();
    let first = rest.next().filter(char::is_ascii_lowercase);
    first.map_or_else(
        || name.to_owned(),
        |first| format!("{}{}", first.to_ascii_uppercase(), rest.as_str()),
    )
}

/// Formats a number in few characters.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.2e}")
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.3}")
    }
}

/// Returns the least 1, 2 or 5 times a power of ten that is at least this.
pub fn nice_step(least: f64) -> f64 {
    let power = libm::exp10(least.max(f64::MIN_POSITIVE).log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|of| of * power);
    steps
        .into_iter()
        .find(|&step| step >= least)
        .unwrap_or(10.0 * power)
}

/// Returns the free space below what a pane shows already, never wider than the pane.
pub fn rest_of(ui: &egui::Ui) -> egui::Vec2 {
    let size = egui::vec2(ui.max_rect().width(), ui.available_height());
    size.max(egui::vec2(16.0, 16.0))
}

/// Sets the accessible name of a widget. Comes after its tooltip, which would be its name otherwise.
pub fn name_widget(ui: &egui::Ui, response: &egui::Response, name: &str) {
    let label = |node: &mut egui::accesskit::Node| node.set_label(name);
    ui.ctx().accesskit_node_builder(response.id, label);
}
