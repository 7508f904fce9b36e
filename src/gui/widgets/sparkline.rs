//! A small line through the last values of a figure.

use crate::gui::theme::tokens;
use egui::{Id, Pos2, Rect, Response, Sense, Shape, Stroke, Ui, pos2};

/// Radius of the points in points of the screen.
const POINT: f32 = 2.5;

/// A line through values; `None` where there is none.
pub struct Sparkline<'a> {
    /// What screen readers call it.
    pub name: &'a str,
    pub values: &'a [Option<f64>],
    /// How many values there is room for.
    pub room: usize,
}

impl Sparkline<'_> {
    /// Shows the line. Returns the place of the value under the pointer, with the line's response.
    pub fn show(self, ui: &Ui, id: Id, rect: Rect) -> (Option<usize>, Response) {
        let response = ui.interact(rect, id, Sense::click());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, self.name));
        let points = points(rect.shrink(POINT + 1.0), self.values, self.room);
        let hovered = response.hover_pos().and_then(|pos| nearest(&points, pos));
        let t = tokens(ui);
        let painter = ui.painter();
        let line: Vec<Pos2> = points.iter().copied().flatten().collect();
        painter.add(Shape::line(line, Stroke::new(1.5, t.hint)));
        for (i, point) in points.iter().enumerate() {
            let Some(point) = *point else {
                continue;
            };
            let is_last = i + 1 == points.len();
            let color = if is_last { t.accent } else { t.hint };
            painter.circle_filled(point, POINT, color);
            if hovered == Some(i) {
                painter.circle_stroke(point, POINT + 2.5, Stroke::new(1.5, t.text));
            }
        }
        if response.has_focus() {
            let ring = Stroke::new(2.0, t.border);
            painter.rect_stroke(rect, 4.0, ring, egui::StrokeKind::Inside);
        }
        (hovered, response)
    }
}

/// Where the values lie: from the left, the lowest at the bottom.
fn points(rect: Rect, values: &[Option<f64>], room: usize) -> Vec<Option<Pos2>> {
    let finite = || values.iter().flatten().copied();
    let (lo, hi) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), value| {
        (lo.min(value), hi.max(value))
    });
    let step = rect.width() / (room.max(2) - 1) as f32;
    let place = |(i, value): (usize, &Option<f64>)| {
        let height = if hi > lo {
            ((*value)? - lo) / (hi - lo)
        } else {
            (*value).map(|_| 0.5)?
        };
        let y = egui::lerp(rect.bottom()..=rect.top(), height as f32);
        Some(pos2(rect.left() + i as f32 * step, y))
    };
    values.iter().enumerate().map(place).collect()
}

/// The point nearest to the pointer from left to right.
fn nearest(points: &[Option<Pos2>], pointer: Pos2) -> Option<usize> {
    let distance = |point: &Pos2| (point.x - pointer.x).abs();
    let known = points.iter().enumerate();
    let known = known.filter_map(|(i, point)| Some((i, point.as_ref()?)));
    known
        .min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))
        .map(|(i, _)| i)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_value_is_at_the_bottom_and_the_nearest_is_found() {
        let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(40.0, 10.0));
        let points = points(rect, &[Some(3.0), None, Some(1.0), Some(2.0)], 5);
        assert_eq!(points[0], Some(pos2(0.0, 0.0)));
        assert_eq!(points[1], None);
        assert_eq!(points[2], Some(pos2(20.0, 10.0)));
        assert_eq!(points[3], Some(pos2(30.0, 5.0)));
        assert_eq!(nearest(&points, pos2(11.0, 5.0)), Some(2));
        assert_eq!(nearest(&points, pos2(9.0, 5.0)), Some(0));
        assert_eq!(nearest(&points, pos2(400.0, 5.0)), Some(3));
        assert_eq!(nearest(&[None], pos2(0.0, 0.0)), None);
    }

    #[test]
    fn equal_values_lie_in_the_middle() {
        let rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(10.0, 10.0));
        let points = points(rect, &[Some(2.0), Some(2.0)], 2);
        assert_eq!(points, [Some(pos2(0.0, 5.0)), Some(pos2(10.0, 5.0))]);
    }
}
