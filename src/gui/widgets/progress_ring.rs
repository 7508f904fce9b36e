//! A ring that fills as work progresses.

use crate::gui::theme::{ROW, tokens};
use egui::{Pos2, Sense, Shape, Stroke, pos2, vec2};
use std::f32::consts::TAU;

/// How long work takes before its progress is shown, in seconds.
pub const PATIENCE: f64 = 0.3;

/// Shows how much of some work is done, 0 to 1. `about` says what the work is.
pub fn progress_ring(ui: &mut egui::Ui, done: f64, about: &str) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ROW, ROW), Sense::hover());
    let t = tokens(ui);
    let radius = ROW / 2.0 - 5.0;
    let (center, width) = (rect.center(), 3.0);
    let painter = ui.painter();
    painter.circle_stroke(center, radius, Stroke::new(width, t.control));
    let line = arc(center, radius, done.clamp(0.0, 1.0) as f32);
    painter.add(Shape::line(line, Stroke::new(width, t.accent)));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ProgressIndicator, true, about));
    response.on_hover_text(about)
}

/// Points on a part of a circle, clockwise from the top.
fn arc(center: Pos2, radius: f32, part: f32) -> Vec<Pos2> {
    const PIECES: usize = 48;
    let pieces = (PIECES as f32 * part).ceil().max(1.0);
    let points = (0..=pieces as usize).map(|i| {
        let angle = TAU * part * i as f32 / pieces;
        pos2(
            center.x + radius * angle.sin(),
            center.y - radius * angle.cos(),
        )
    });
    points.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_ends_at_the_right() {
        let points = arc(pos2(10.0, 10.0), 5.0, 0.25);
        let (first, last) = (points[0], points[points.len() - 1]);
        assert!((first - pos2(10.0, 5.0)).length() < 1e-4);
        assert!((last - pos2(15.0, 10.0)).length() < 1e-4);
        let full = arc(pos2(10.0, 10.0), 5.0, 1.0);
        assert!((full[0] - full[full.len() - 1]).length() < 1e-4);
    }
}
