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
