//! Widgets that egui lacks.

use super::style::{CARD_RADIUS, RADIUS, ROW};
use super::{HINT, named, tokens};
use egui::{Button, Color32, Frame, Margin, Response, RichText, Stroke, Ui, Widget, vec2};

/// Returns the frame of a card.
pub fn card(ui: &Ui) -> Frame {
    let t = tokens(ui);
    Frame::new()
        .fill(t.card)
        .stroke(Stroke::new(1.0, t.divider))
        .corner_radius(CARD_RADIUS)
        .inner_margin(Margin::same(12))
}

/// Shows a short text in a small frame: a change or a mark. The color never says it alone.
pub fn chip(ui: &mut Ui, text: impl Into<String>, color: Color32) -> Response {
    let t = tokens(ui);
    Frame::new()
        .fill(t.panel)
        .stroke(Stroke::new(1.0, t.divider))
        .corner_radius(RADIUS)
        .inner_margin(Margin::symmetric(8, 2))
        .show(ui, |ui| {
            let text = RichText::new(text).text_style(named(HINT)).color(color);
            ui.label(text)
        })
        .inner
}

/// A square button with an icon, of the height of a row.
pub struct IconButton<'a> {
    icon: &'a str,
    name: &'a str,
    tip: Option<&'a str>,
    selected: bool,
}

impl<'a> IconButton<'a> {
    /// Makes the button of `icon`, one of [`crate::gui::icons`]. `name` is what screen readers and tests
    /// know it by, and its tooltip unless there is another.
    pub fn new(icon: &'a str, name: &'a str) -> Self {
        IconButton {
            icon,
            name,
            tip: None,
            selected: false,
        }
    }

    /// What the tooltip says in place of the name.
    pub fn tip(mut self, tip: &'a str) -> Self {
        self.tip = Some(tip);
        self
    }

    /// Whether what the button switches is on.
    pub fn selected(mut self, selected: bool) -> Self {
        self.selected = selected;
        self
    }
}

impl Widget for IconButton<'_> {
    fn ui(self, ui: &mut Ui) -> Response {
        let button = Button::new(RichText::new(self.icon).size(18.0))
            .frame_when_inactive(self.selected)
            .selected(self.selected)
            .min_size(vec2(ROW, ROW));
        ui.scope(|ui| {
            // With the padding of text, the button would be higher than a row.
            ui.spacing_mut().button_padding = vec2(4.0, 2.0);
            ui.add(button)
        })
        .inner
        .on_hover_text(self.tip.unwrap_or(self.name))
        // The tooltip would be the name otherwise.
        .accessible_name(self.name)
    }
}
