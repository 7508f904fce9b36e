//! A guess and what was measured, on one scale.

use crate::gui::theme;
use crate::gui::widgets::common::nice_step;
use crate::lesson::{GuessScale, Verdict};
use crate::present::number::Digits;
use egui::{Align2, Color32, FontId, Painter, Rect, Shape, Stroke, pos2, vec2};

/// A mark's half width.
const MARK: f32 = 6.0;
const HEIGHT: f32 = 96.0;

/// Shows the guess above the line, and what was measured below it.
pub fn show(ui: &mut egui::Ui, scale: &GuessScale, verdict: &Verdict) {
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let guess = format!("You said {}", verdict.predicted);
    let measured = format!("Measured {}", verdict.truth);
    let name = format!("Scale. {guess}. {measured}.");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let t = theme::tokens(ui);
    let painter = ui.painter().with_clip_rect(rect);
    let line = Rect::from_min_max(
        pos2(rect.left() + MARK, rect.top() + 38.0),
        pos2(rect.right() - MARK, rect.top() + 42.0),
    );
    let x = |place: f64| egui::lerp(line.x_range(), place as f32);
    painter.rect_filled(line, 2.0, t.divider);
    let [from, to] = scale.close.map(x);
    let close = Rect::from_x_y_ranges(from..=to.max(from + 2.0), line.y_range());
    painter.rect_filled(close.expand2(vec2(0.0, 4.0)), 2.0, t.selected);
    for tick in ticks(scale) {
        let at = pos2(x(scale.position(tick)), line.bottom() + 5.0);
        painter.vline(at.x, line.bottom()..=at.y, Stroke::new(1.0, t.border));
        let small = FontId::proportional(12.0);
        caption(
            &painter,
            rect,
            at + vec2(0.0, 14.0),
            &Digits::All.number(tick),
            small,
            t.hint,
        );
    }
    let font = FontId::proportional(13.0);
    // The guess is a hollow diamond.
    let at = pos2(x(scale.guess), line.top() - 2.0);
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
    caption(&painter, rect, above, &guess, font.clone(), t.text);
    // What was measured is a full bar that ends in its caption.
    let at = x(scale.measured);
    let down = line.top() - 4.0..=rect.bottom() - 18.0;
    let bar = Rect::from_x_y_ranges(at - 2.0..=at + 2.0, down);
    painter.rect_filled(bar, 1.0, t.accent);
    caption(
        &painter,
        rect,
        pos2(at, rect.bottom()),
        &measured,
        font,
        t.accent,
    );
}

/// A text that ends above a place, moved into the scale where it would be cut.
fn caption(
    painter: &Painter,
    rect: Rect,
    at: egui::Pos2,
    text: &str,
    font: FontId,
    color: Color32,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), font, color);
    let place = Align2::CENTER_BOTTOM.anchor_size(at, galley.size());
    let most = (rect.right() - place.width()).max(rect.left());
    let left = place.left().clamp(rect.left(), most);
    painter.galley(pos2(left, place.top()), galley, color);
}

/// Round values on a scale, at most eight.
fn ticks(scale: &GuessScale) -> Vec<f64> {
    let [lo, hi] = scale.bounds;
    if scale.logarithmic {
        let powers = lo.log10().round() as i32..=hi.log10().round() as i32;
        let step = 1 + powers.clone().count() / 7;
        return powers
            .step_by(step)
            .map(|p| libm::exp10(f64::from(p)))
            .collect();
    }
    let step = nice_step((hi - lo) / 5.0);
    let (first, last) = ((lo / step).ceil() as i64, (hi / step).floor() as i64);
    (first..=last).map(|i| i as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scale(bounds: [f64; 2], logarithmic: bool) -> GuessScale {
        GuessScale {
            bounds,
            logarithmic,
            guess: 0.0,
            measured: 1.0,
            close: [1.0, 1.0],
        }
    }

    #[test]
    fn ticks_are_round_and_few_and_lie_on_the_scale() {
        assert_eq!(ticks(&scale([0.0, 13.2], false)), [0.0, 5.0, 10.0]);
        assert_eq!(
            ticks(&scale([-4.0, 4.4], false)),
            [-4.0, -2.0, 0.0, 2.0, 4.0]
        );
        assert_eq!(ticks(&scale([1.0, 1e3], true)), [1.0, 10.0, 100.0, 1000.0]);
        let wide = ticks(&scale([1e-6, 1e9], true));
        assert!((3..=8).contains(&wide.len()), "{wide:?}");
    }
}
