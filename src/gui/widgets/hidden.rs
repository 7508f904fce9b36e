//! What takes the place of figures that a lesson asks for.

use crate::gui::icons;
use crate::gui::theme;

/// Says why there are no figures.
pub const HIDDEN: &str = "Hidden until you check your prediction";

/// Shows a quiet card in the place of a pane.
pub fn card(ui: &mut egui::Ui) {
    ui.add_space(12.0);
    ui.vertical_centered(|ui| {
        theme::card(ui).show(ui, |ui| {
            ui.set_max_width(320.0);
            ui.label(theme::hint(icons::EYE_SLASH));
            ui.label(theme::hint(HIDDEN));
        });
    });
}
