//! A guess and what was measured, on one scale.

use crate::gui::theme;
use crate::gui::widgets::common::{nice_step, short};
use egui::{Align2, Color32, FontId, Painter, Rect, Shape, Stroke, pos2, vec2};

/// Values whose ratio is larger than this share a logarithmic scale.
const LARGE: f64 = 20.0;
/// A mark's half width.
const MARK: f32 = 6.0;
const HEIGHT: f32 = 96.0;

/// What the scale shows.
pub struct Scale<'a> {
    pub guess: f64,
    pub truth: f64,
    /// Between these a guess is close.
    pub close: [f64; 2],
    /// What was measured, as text.
    pub measured: &'a str,
}

/// Where values lie on the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Axis {
    lo: f64,
    hi: f64,
    logarithmic: bool,
}

impl Axis {
    /// A scale that has room for all of these.
    fn over(values: &[f64]) -> Self {
        let lo = values.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if lo > 0.0 && hi / lo > LARGE {
            return Axis {
                lo: lo / 1.5,
                hi: hi * 1.5,
                logarithmic: true,
            };
        }
        let (lo, hi) = (lo.min(0.0), hi.max(0.0));
        // Two zeros have a scale, too.
        let room = if hi > lo { 0.12 * (hi - lo) } else { 1.0 };
        Axis {
            lo: if lo < 0.0 { lo - room } else { 0.0 },
            hi: hi + room,
            logarithmic: false,
        }
    }

    /// The place of a value: 0 at the left end to 1 at the right one.
    fn place(&self, value: f64) -> f32 {
        let share = if self.logarithmic {
            (value.max(self.lo) / self.lo).ln() / (self.hi / self.lo).ln()
        } else {
            (value - self.lo) / (self.hi - self.lo)
        };
        share.clamp(0.0, 1.0) as f32
    }

    /// Round values on the scale, at most six.
    fn ticks(&self) -> Vec<f64> {
        if self.logarithmic {
            let powers = self.lo.log10().ceil() as i32..=self.hi.log10().floor() as i32;
            let step = 1 + powers.clone().count() / 6;
            return powers.step_by(step).map(|p| 10.0_f64.powi(p)).collect();
        }
        let step = nice_step((self.hi - self.lo) / 5.0);
        let first = (self.lo / step).ceil() as i64;
        let last = (self.hi / step).floor() as i64;
        (first..=last).map(|i| i as f64 * step).collect()
    }
}

impl Scale<'_> {
    /// Shows the guess above the line, what was measured below it.
    pub fn show(&self, ui: &mut egui::Ui) {
        let size = vec2(ui.available_width(), HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
        let guess = short_number(self.guess);
        let name = format!("Scale: you said {guess}, measured {}", self.measured);
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
        let axis = Axis::over(&[self.guess, self.truth, self.close[0], self.close[1]]);
        let t = theme::tokens(ui);
        let painter = ui.painter().with_clip_rect(rect);
        let line = Rect::from_min_max(
            pos2(rect.left() + MARK, rect.top() + 38.0),
            pos2(rect.right() - MARK, rect.top() + 42.0),
        );
        let x = |value: f64| egui::lerp(line.x_range(), axis.place(value));
        painter.rect_filled(line, 2.0, t.divider);
        let [from, to] = self.close.map(x);
        let band = Rect::from_x_y_ranges(from..=to.max(from + 2.0), line.y_range());
        painter.rect_filled(band.expand2(vec2(0.0, 4.0)), 2.0, t.selected);
        for tick in axis.ticks() {
            let at = pos2(x(tick), line.bottom() + 5.0);
            painter.vline(at.x, line.bottom()..=at.y, Stroke::new(1.0, t.border));
            let (small, top) = (FontId::proportional(12.0), Align2::CENTER_TOP);
            painter.text(at, top, short(tick), small, t.hint);
        }
        // The guess, as a hollow diamond.
        let at = pos2(x(self.guess), line.top() - 2.0);
        let diamond = vec![
            at,
            at + vec2(-MARK, -MARK),
            at + vec2(0.0, -2.0 * MARK),
            at + vec2(MARK, -MARK),
        ];
        painter.add(Shape::convex_polygon(
            diamond,
            t.panel,
            Stroke::new(2.0, t.text),
        ));
        let above = at - vec2(0.0, 2.0 * MARK + 2.0);
        caption(
            &painter,
            rect,
            above,
            Align2::CENTER_BOTTOM,
            &format!("You said {guess}"),
            t.text,
        );
        // What was measured, as a full bar that ends in its caption.
        let at = x(self.truth);
        let bar =
            Rect::from_x_y_ranges(at - 2.0..=at + 2.0, line.top() - 4.0..=rect.bottom() - 18.0);
        painter.rect_filled(bar, 1.0, t.accent);
        let below = pos2(at, rect.bottom());
        let text = format!("Measured {}", self.measured);
        caption(
            &painter,
            rect,
            below,
            Align2::CENTER_BOTTOM,
            &text,
            t.accent,
        );
    }
}

/// A text at a place, moved into the scale where it would be cut.
fn caption(
    painter: &Painter,
    rect: Rect,
    at: egui::Pos2,
    anchor: Align2,
    text: &str,
    color: Color32,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), color);
    let mut place = anchor.anchor_size(at, galley.size());
    let left = place
        .left()
        .clamp(rect.left(), (rect.right() - place.width()).max(rect.left()));
    place = place.translate(vec2(left - place.left(), 0.0));
    painter.galley(place.min, galley, color);
}

/// A guess as it was typed, without digits that say nothing.
fn short_number(value: f64) -> String {
    value.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guess_and_measurement_lie_in_order_on_one_scale() {
        for [guess, truth] in [
            [6.0, 12.0],
            [1.0, 5000.0],
            [-3.0, 4.0],
            [0.0, 7.0],
            [0.01, 0.5],
        ] {
            let axis = Axis::over(&[guess, truth]);
            assert!(0.0 <= axis.place(guess) && axis.place(truth) < 1.0);
            let apart = axis.place(truth) - axis.place(guess);
            assert!(apart > 0.3, "{guess} {truth}: {apart}");
            let ticks = axis.ticks();
            assert!((2..=8).contains(&ticks.len()), "{guess} {truth}: {ticks:?}");
            assert!(ticks.iter().all(|&tick| axis.lo <= tick && tick <= axis.hi));
        }
    }

    #[test]
    fn what_is_far_apart_has_a_logarithmic_scale() {
        assert!(!Axis::over(&[6.0, 12.0]).logarithmic);
        assert!(Axis::over(&[6.0, 1200.0]).logarithmic);
        assert!(!Axis::over(&[0.0, 1200.0]).logarithmic);
        // Equal values, zeros among them, have a place.
        for value in [0.0, 5.0] {
            let place = Axis::over(&[value, value]).place(value);
            assert!((0.0..=1.0).contains(&place), "{place}");
        }
    }
}
