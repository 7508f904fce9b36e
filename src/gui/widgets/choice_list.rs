//! The parts of a list of choices: headings, and items that say what they are beside their names.

use crate::gui::theme::{HINT, hint, named, tokens};
use egui::text::LayoutJob;
use egui::{Button, Response, TextFormat, TextStyle, Ui};

/// The width of the names, in points.
const NAME: f32 = 128.0;

/// Leaves no space between items, so that long lists fit on the screen.
pub fn close_together(ui: &mut Ui) {
    ui.spacing_mut().item_spacing.y = 0.0;
}

/// Shows the heading of the items that follow.
pub fn group(ui: &mut Ui, title: &str) {
    ui.label(hint(title));
}

/// Shows an item: its name, and in a column what it is. Screen readers and tests know it by its name.
pub fn item(ui: &mut Ui, is_chosen: bool, name: &str, about: &str) -> Response {
    let t = tokens(ui);
    let style = ui.style();
    let [font, small] = [TextStyle::Body, named(HINT)].map(|text| text.resolve(style));
    let width = ui
        .painter()
        .layout_no_wrap(name.to_owned(), font.clone(), t.text)
        .size()
        .x;
    let mut text = LayoutJob::default();
    text.append(name, 0.0, TextFormat::simple(font, t.text));
    if !about.is_empty() {
        let color = if is_chosen { t.text } else { t.hint };
        let gap = (NAME - width).max(8.0);
        text.append(about, gap, TextFormat::simple(small, color));
    }
    ui.add(Button::selectable(is_chosen, text))
        .accessible_name(name)
}
