//! A rectangle of pixels that is dragged in the picture.

use crate::measure::model::Region;
use egui::{Color32, Pos2, Rect, vec2};

/// The pixels of a picture, shown in `rect`, from one point to another, as far as they lie in it.
pub fn between(rect: Rect, [width, height]: [u32; 2], from: Pos2, to: Pos2) -> Region {
    let pixel = |at: f32, start: f32, length: f32, count: u32| {
        let place = (at - start) / length * count as f32;
        (place.max(0.0) as u32).min(count - 1)
    };
    let [x0, x1] = [from.x, to.x].map(|x| pixel(x, rect.left(), rect.width(), width));
    let [y0, y1] = [from.y, to.y].map(|y| pixel(y, rect.top(), rect.height(), height));
    Region {
        x: x0.min(x1),
        y: y0.min(y1),
        width: x0.abs_diff(x1) + 1,
        height: y0.abs_diff(y1) + 1,
    }
}

/// The marked region's edge, to be seen on any colour; not where it lies outside of the picture.
pub fn frame(painter: &egui::Painter, rect: Rect, [width, height]: [u32; 2], region: Region) {
    if region.x >= width || region.y >= height {
        return;
    }
    let pixel = rect.size() / vec2(width as f32, height as f32);
    let corner = rect.min + pixel * vec2(region.x as f32, region.y as f32);
    let size = pixel * vec2(region.width as f32, region.height as f32);
    let edge = Rect::from_min_size(corner, size).intersect(rect);
    for (width, color) in [(3.0, Color32::BLACK), (1.0, Color32::WHITE)] {
        let stroke = egui::Stroke::new(width, color);
        painter.rect_stroke(edge, 0.0, stroke, egui::StrokeKind::Middle);
    }
}
