//! The colour bar of a legend and its numbers.

use crate::present::overlay::{Colormap, HeatScale};
use egui::{Color32, FontId, Painter, Rect, Stroke, pos2};

/// Length of a tick in points.
pub const TICK: f32 = 4.0;
/// Height of the numbers in points.
pub const NUMBERS: f32 = 16.0;
/// What a tick's number takes at most.
const TICK_ROOM: f32 = 36.0;

/// The colours of a map from end to end.
pub fn color_bar(painter: &Painter, colors: &Colormap, bar: Rect) {
    const PIECES: usize = 128;
    let mut mesh = egui::Mesh::default();
    for i in 0..=PIECES {
        let place = i as f32 / PIECES as f32;
        let [r, g, b] = colors.color(f64::from(place));
        let x = bar.left() + place * bar.width();
        for y in [bar.top(), bar.bottom()] {
            mesh.colored_vertex(pos2(x, y), Color32::from_rgb(r, g, b));
        }
        if i > 0 {
            let at = 2 * i as u32;
            mesh.add_triangle(at - 2, at - 1, at);
            mesh.add_triangle(at - 1, at, at + 1);
        }
    }
    painter.add(mesh);
}

/// Ticks below the bar and their numbers, as many as have room; `beyond` are the values below and
/// above the range.
pub fn numbers(
    painter: &Painter,
    scale: &HeatScale,
    beyond: [usize; 2],
    bar: Rect,
    rect: Rect,
    ink: Color32,
) {
    let [below, above] = beyond;
    let mut free_from = rect.left();
    for tick in scale.ticks((bar.width() / TICK_ROOM) as usize) {
        let x = bar.left() + tick.place as f32 * bar.width();
        let foot = pos2(x, bar.bottom() + TICK);
        painter.line_segment([pos2(x, bar.bottom()), foot], Stroke::new(1.0, ink));
        // The ends' colours stand for all that lies beyond, too.
        let text = match tick.place {
            place if place <= 0.0 && below > 0 => format!("≤ {}", tick.text),
            place if place >= 1.0 && above > 0 => format!("≥ {}", tick.text),
            _ => tick.text,
        };
        let laid_out = painter.layout_no_wrap(text, FontId::proportional(12.0), ink);
        let width = laid_out.rect.width();
        let left = (x - width / 2.0).min(rect.right() - width).max(rect.left());
        if left >= free_from {
            painter.galley(pos2(left, foot.y), laid_out, ink);
            free_from = left + width + 4.0;
        }
    }
}
