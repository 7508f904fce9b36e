//! Signs over the pictures: the picked pixel, pinned pixels, the letters A and B, the line of the wipe.

use crate::gui::document::comparing::Which;
use crate::gui::theme::Tokens;
use egui::{Align2, Color32, FontId, Painter, Rect, Stroke, StrokeKind, Theme, vec2};

/// A letter in a corner that says whose picture this is.
pub fn badge(painter: &Painter, clip: Rect, which: Which, right: bool) {
    let size = vec2(20.0, 20.0);
    let corner = if right {
        clip.right_top() + vec2(-4.0 - size.x, 4.0)
    } else {
        clip.left_top() + vec2(4.0, 4.0)
    };
    let rect = Rect::from_min_size(corner, size);
    painter.rect_filled(rect, 4.0, Color32::from_black_alpha(190));
    let font = FontId::proportional(14.0);
    let middle = Align2::CENTER_CENTER;
    // The ground is dark in both themes.
    let colors = Tokens::of(Theme::Dark);
    let color = match which {
        Which::A => colors.a,
        Which::B => colors.b,
    };
    painter.text(rect.center(), middle, which.name(), font, color);
}

/// The line between two pictures, to be seen on any color.
pub fn wipe_line(ui: &egui::Ui, pane: Rect, x: f32) {
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        ui.painter()
            .vline(x, pane.y_range(), Stroke::new(width, color));
    }
}

/// Marks a pixel so that it can be seen on any color.
pub fn cross_hair(painter: &Painter, rect: Rect, [width, height]: [u32; 2], [x, y]: [u32; 2]) {
    let pixel = rect.size() / vec2(width as f32, height as f32);
    let corner = rect.min + pixel * vec2(x as f32, y as f32);
    let mark = Rect::from_min_size(corner, pixel).expand(2.0);
    let arm = 12.0;
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        let stroke = Stroke::new(width, color);
        painter.rect_stroke(mark, 0.0, stroke, StrokeKind::Middle);
        let (middle, half) = (mark.center(), mark.size() * 0.5);
        for sign in [-1.0, 1.0] {
            painter.line_segment(
                [
                    middle + vec2(sign * half.x, 0.0),
                    middle + vec2(sign * (half.x + arm), 0.0),
                ],
                stroke,
            );
            painter.line_segment(
                [
                    middle + vec2(0.0, sign * half.y),
                    middle + vec2(0.0, sign * (half.y + arm)),
                ],
                stroke,
            );
        }
    }
}

/// Numbers the pinned pixels.
pub fn pins(painter: &Painter, rect: Rect, picture: [u32; 2], pinned: &[[u32; 2]]) {
    let pixel = rect.size() / vec2(picture[0] as f32, picture[1] as f32);
    for (i, [x, y]) in pinned.iter().enumerate() {
        if *x >= picture[0] || *y >= picture[1] {
            continue;
        }
        let at = rect.min + pixel * vec2(*x as f32 + 0.5, *y as f32 + 0.5);
        painter.circle(
            at,
            9.0,
            Color32::from_black_alpha(190),
            (1.0, Color32::WHITE),
        );
        let (font, middle) = (FontId::proportional(12.0), Align2::CENTER_CENTER);
        painter.text(at, middle, i + 1, font, Color32::WHITE);
    }
}
