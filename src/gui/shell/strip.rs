//! The strip at the bottom: tabs of the panes that no task shows by itself, and how the work stands.

use super::app::App;
use super::places::PaneId;
use egui::containers::menu::MenuButton;
use egui::{Align, Button, Layout};

/// The height of the strip in points.
const HEIGHT: f32 = 32.0;

/// What the status at the right end may take, in points.
const STATUS: f32 = 300.0;

/// The most tabs beside the menu of all others: more would be read by nobody.
const MOST_TABS: usize = 5;

/// The share of the window that a pane opens to.
const OPEN: f32 = 0.4;

impl App {
    /// Draws the strip.
    pub(super) fn strip(&mut self, ui: &mut egui::Ui) {
        let frame = egui::Frame::new()
            .fill(ui.visuals().panel_fill)
            .inner_margin(egui::Margin::symmetric(8, 0));
        egui::Panel::bottom("strip")
            .exact_size(HEIGHT)
            .frame(frame)
            .show(ui, |ui| {
                ui.horizontal_centered(|ui| {
                    self.tabs(ui, ui.available_width() - STATUS);
                    let to_the_left = Layout::right_to_left(Align::Center);
                    ui.with_layout(to_the_left, |ui| self.status.ui(ui, &mut self.doc));
                });
            });
    }

    /// The tabs that fit into `room`, then a menu of the others.
    fn tabs(&mut self, ui: &mut egui::Ui, room: f32) {
        ui.spacing_mut().item_spacing.x = 2.0;
        let more = "More panes";
        let width = |ui: &egui::Ui, title: &str| {
            let font = egui::TextStyle::Button.resolve(ui.style());
            let text = ui.ctx().fonts_mut(|fonts| {
                let color = ui.visuals().text_color();
                fonts.layout_no_wrap(title.to_owned(), font, color).size().x
            });
            text + 2.0 * ui.spacing().button_padding.x + ui.spacing().item_spacing.x
        };
        let opened = self.layout.opened();
        let mut left = room - width(ui, more) - 16.0;
        let mut hidden = Vec::new();
        for (place, pane) in self.layout.strip().into_iter().enumerate() {
            left -= width(ui, pane.entry().title);
            let has_room = left >= 0.0 && place < MOST_TABS;
            if !has_room && opened != Some(pane) {
                hidden.push(pane);
            } else {
                self.tab(ui, pane, opened == Some(pane));
            }
        }
        hidden.extend(self.layout.of_other_tasks());
        MenuButton::new(more).ui(ui, |ui| {
            for pane in hidden {
                self.tab(ui, pane, opened == Some(pane));
            }
        });
    }

    fn tab(&mut self, ui: &mut egui::Ui, pane: PaneId, is_open: bool) {
        let entry = pane.entry();
        let tab = ui.add(Button::selectable(is_open, entry.title));
        if tab.on_hover_text(entry.about).clicked() {
            self.layout.open = (!is_open).then(|| entry.id.to_owned());
        }
    }

    /// Draws the pane that is open above the strip.
    pub(super) fn opened_pane(&mut self, ui: &mut egui::Ui) {
        let Some(pane) = self.layout.opened() else {
            return;
        };
        let room = ui.available_height();
        egui::Panel::bottom("open pane")
            .resizable(true)
            .default_size(OPEN * room)
            .size_range(80.0..=0.8 * room)
            .show(ui, |ui| {
                ui.set_min_height(ui.available_height());
                self.pane_with_header(ui, pane);
            });
    }
}
