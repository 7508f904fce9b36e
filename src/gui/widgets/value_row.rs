//! A row of a table of figures: a name with the paper's symbol beside it, then values at fixed places.

use crate::gui::theme::{HINT, named, tokens};
use egui::{Color32, FontId, Galley, Id, Pos2, Rect, Response, Sense, Ui, pos2, vec2};
use std::sync::Arc;

/// Height of a row of one line.
pub const HEIGHT: f32 = 24.0;

/// Space between the parts of a row.
const SPACE: f32 = 8.0;

/// A value, aligned to the right.
pub struct Value {
    pub text: String,
    pub color: Color32,
    /// Width of its place in points.
    pub width: f32,
}

/// A row.
pub struct ValueRow<'a> {
    pub name: &'a str,
    /// The paper's symbol; empty where there is none.
    pub symbol: &'a str,
    /// Values from the left to the right; their places end at the right end of the row.
    pub values: &'a [Value],
    /// The least height.
    pub height: f32,
    pub striped: bool,
}

impl ValueRow<'_> {
    /// Shows the row. Returns the name and the symbol, for a tooltip. A name that is too long for one line
    /// takes more.
    pub fn show(self, ui: &mut Ui) -> Response {
        let t = tokens(ui);
        let font = named(HINT).resolve(ui.style());
        let width = ui.available_width();
        let of_values: f32 = self.values.iter().map(|value| value.width).sum();
        let painter = ui.painter().clone();
        let symbol = painter.layout_no_wrap(self.symbol.to_owned(), font.clone(), t.hint);
        let of_symbol = if self.symbol.is_empty() {
            0.0
        } else {
            symbol.size().x + SPACE
        };
        let room = (width - of_values - 2.0 * SPACE).max(60.0);
        let name = painter.layout_no_wrap(self.name.to_owned(), font.clone(), t.label);
        // The symbol stands below a name that leaves no room for it.
        let is_stacked = name.size().x + of_symbol > room;
        let name = if is_stacked {
            painter.layout(self.name.to_owned(), font.clone(), t.label, room)
        } else {
            name
        };
        let below = if is_stacked { symbol.size().y } else { 0.0 };
        let lines = name.size().y + below;
        let size = vec2(width, self.height.max(lines + 4.0));
        let (rect, row) = ui.allocate_exact_size(size, Sense::hover());
        if self.striped {
            painter.rect_filled(rect, 3.0, t.card);
        }
        let id = row.id;
        let at = pos2(rect.left() + SPACE / 2.0, rect.center().y - lines / 2.0);
        let to_symbol = if is_stacked {
            vec2(0.0, name.size().y)
        } else {
            vec2(name.size().x + SPACE, 0.0)
        };
        let mut response = text(ui, id.with("name"), at, name, self.name);
        if !self.symbol.is_empty() {
            let at = at + to_symbol;
            response = response.union(text(ui, id.with("symbol"), at, symbol, self.symbol));
        }
        let mut right = rect.right() - SPACE / 2.0;
        for (i, value) in self.values.iter().enumerate().rev() {
            show_value(ui, id.with(i), rect, right, font.clone(), value);
            right -= value.width;
        }
        response
    }
}

fn show_value(ui: &Ui, id: Id, row: Rect, right: f32, font: FontId, value: &Value) {
    if value.text.is_empty() {
        return;
    }
    let painter = ui.painter();
    let galley = painter.layout_no_wrap(value.text.clone(), font, value.color);
    let size = galley.size();
    let at = pos2(right - size.x, row.center().y - size.y / 2.0);
    text(ui, id, at, galley, &value.text);
}

/// Shows a text that is laid out, under its own name for screen readers.
pub fn text(ui: &Ui, id: Id, at: Pos2, galley: Arc<Galley>, name: &str) -> Response {
    let rect = Rect::from_min_size(at, galley.size());
    let color = ui.visuals().text_color();
    ui.painter().galley(at, galley, color);
    let response = ui.interact(rect, id, Sense::hover());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, name));
    response
}
