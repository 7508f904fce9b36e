//! The window that lists all shortcuts, from the one table that defines them.

use super::shortcuts::{SHORTCUTS, Scope};

/// Shows the list while `open`.
pub fn show(ctx: &egui::Context, open: &mut bool) {
    egui::Window::new("Shortcuts")
        .open(open)
        .collapsible(false)
        .default_size([430.0, 640.0])
        .vscroll(true)
        .show(ctx, |ui| {
            for scope in Scope::ALL {
                ui.heading(scope.title());
                egui::Grid::new(scope.title())
                    .num_columns(2)
                    .striped(true)
                    .min_col_width(110.0)
                    .show(ui, |ui| {
                        for shortcut in SHORTCUTS.iter().filter(|s| s.scope == scope) {
                            ui.strong(shortcut.text);
                            ui.label(shortcut.about);
                            ui.end_row();
                        }
                    });
                ui.add_space(8.0);
            }
        });
}
