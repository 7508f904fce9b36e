//! The colors of a property of leaves, with their values.

use crate::present::overlay::Coloring;
use egui::{Color32, Rect, pos2, vec2};

/// Length of the colour bar in points, where there is room.
const BAR: f32 = 210.0;

/// The colours from the lowest to the highest value, with numbers.
pub fn color_bar(coloring: &Coloring, range: [f64; 2], ui: &mut egui::Ui) {
    let bar = BAR.min(ui.available_width() - 24.0);
    let (rect, _) = ui.allocate_exact_size(vec2(bar + 24.0, 32.0), egui::Sense::hover());
    let painter = ui.painter();
    let left = rect.left() + 6.0;
    let text = ui.visuals().text_color();
    let font = egui::FontId::proportional(12.0);
    let color = |place: f64| {
        let [r, g, b] = coloring.color_at(place);
        Color32::from_rgb(r, g, b)
    };
    let marks = coloring.marks(range);
    if coloring.is_continuous() {
        const STEPS: u32 = 64;
        for i in 0..STEPS {
            let x = left + bar * i as f32 / STEPS as f32;
            let piece =
                Rect::from_min_size(pos2(x, rect.top()), vec2(bar / STEPS as f32 + 0.5, 12.0));
            painter.rect_filled(piece, 0.0, color(f64::from(i) / f64::from(STEPS - 1)));
        }
    }
    for mark in marks {
        let x = left + bar * mark.place as f32;
        if coloring.is_continuous() {
            painter.vline(
                x,
                rect.top() + 12.0..=rect.top() + 15.0,
                egui::Stroke::new(1.0, text),
            );
            let at = pos2(x, rect.top() + 15.0);
            painter.text(at, egui::Align2::CENTER_TOP, mark.text, font.clone(), text);
        } else {
            let x = left + bar * 0.5 * mark.place as f32;
            let patch = Rect::from_min_size(pos2(x, rect.top() + 6.0), vec2(28.0, 12.0));
            painter.rect_filled(patch, 0.0, color(mark.place));
            let at = patch.right_center() + vec2(5.0, 0.0);
            painter.text(at, egui::Align2::LEFT_CENTER, mark.text, font.clone(), text);
        }
    }
}
