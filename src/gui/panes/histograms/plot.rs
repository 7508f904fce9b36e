//! One histogram: its bars, its range, and the drag that selects one.

use crate::gui::widgets::symbol::grouped;
use crate::present::overlay::{Bars, HistogramAxis, Spread};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, pos2, vec2};

const FULL: Color32 = Color32::from_rgb(76, 145, 205);
const BRUSH: Color32 = Color32::from_rgba_premultiplied(60, 46, 0, 70);

/// Room for the numbers at the left, in points.
const LEFT: f32 = 46.0;

/// One histogram in one frame.
pub struct Plot<'a> {
    pub axis: &'static HistogramAxis,
    /// None where there is nothing to count, or while it is not counted.
    pub bars: &'a Bars,
    pub log: bool,
    /// Value of the selected leaf.
    pub marked: Option<f64>,
    /// A range selects pixels, not leaves.
    pub selects_pixels: bool,
}

impl Plot<'_> {
    pub fn ui(
        &self,
        ui: &mut egui::Ui,
        size: egui::Vec2,
        range: &mut Option<[f64; 2]>,
        from: &mut usize,
    ) {
        let (outer, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
        response.widget_info(|| {
            egui::WidgetInfo::labeled(
                egui::Role::Canvas,
                true,
                format!("Histogram: {}", self.axis.title),
            )
        });
        let area = Rect::from_min_max(outer.min + vec2(LEFT, 18.0), outer.max - vec2(8.0, 32.0));
        if !area.is_positive() {
            return;
        }
        if self.bars.counts.is_empty() {
            let text = format!("{}: not counted yet", self.axis.title);
            let color = ui.visuals().weak_text_color();
            let painter = ui.painter().with_clip_rect(outer);
            let at = outer.left_top() + vec2(LEFT, 0.0);
            painter.text(
                at,
                Align2::LEFT_TOP,
                text,
                FontId::proportional(12.5),
                color,
            );
            return;
        }
        self.brush(&response, area, range, from);
        self.paint(ui, outer, area, *range);
        if let Some(at) = response.hover_pos().filter(|at| area.contains(*at)) {
            let bar = self.bar_at(area, at.x);
            let [full, empty] = self.bars.counts[bar];
            let [lo, hi] = self.values_of([bar, bar]);
            let counted = if self.selects_pixels {
                format!(
                    "{} rays of all kinds\nA range marks the pixels of the picture with at least \
                     one ray that visits a number of nodes in this range.",
                    grouped(full as usize)
                )
            } else {
                let [full, empty] = [full, empty].map(|leaves| grouped(leaves as usize));
                format!("{full} full and {empty} empty leaves")
            };
            let text = format!(
                "{}: {} {}\n{counted}",
                self.axis.title,
                self.axis.format_range([lo, hi]),
                self.axis.unit,
            );
            response.on_hover_text_at_pointer(text);
        }
    }

    /// Takes a drag over bars as a range of whole bars; a click takes one bar, or on the range all.
    fn brush(
        &self,
        response: &egui::Response,
        area: Rect,
        range: &mut Option<[f64; 2]>,
        from: &mut usize,
    ) {
        let Some(at) = response.interact_pointer_pos() else {
            return;
        };
        let bar = self.bar_at(area, at.x);
        if response.clicked() {
            let [lo, hi] = self.values_of([bar, bar]);
            let again = *range == Some([lo, hi]);
            *range = (!again).then_some([lo, hi]);
        } else if response.drag_started() {
            let press = response
                .ctx
                .input(|i| i.pointer.press_origin())
                .unwrap_or(at);
            *from = self.bar_at(area, press.x);
        }
        // The end of a drag may have moved in the frame in which the button was released.
        if response.dragged() || response.drag_stopped() {
            *range = Some(self.values_of([bar.min(*from), bar.max(*from)]));
        }
    }

    fn bar_at(&self, area: Rect, x: f32) -> usize {
        let n = self.bars.counts.len();
        let place = (x - area.left()) / area.width() * n as f32;
        (place.max(0.0) as usize).min(n - 1)
    }

    /// The values from the first of these bars through the last.
    fn values_of(&self, [first, last]: [usize; 2]) -> [f64; 2] {
        let Bars { start, width, .. } = *self.bars;
        [
            start + width * first as f64,
            start + width * (last + 1) as f64,
        ]
    }

    fn paint(&self, ui: &egui::Ui, outer: Rect, area: Rect, range: Option<[f64; 2]>) {
        let painter = ui.painter().with_clip_rect(outer);
        let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
        let (font, small) = (FontId::proportional(12.5), FontId::proportional(12.0));
        let n = self.bars.counts.len();
        let highest = self.bars.highest().max(1);
        let x_of = |value: f64| {
            let place = (value - self.bars.start) / (self.bars.end() - self.bars.start);
            area.left() + area.width() * place.clamp(0.0, 1.0) as f32
        };
        let title = match range {
            Some(range) => format!("{}: {}", self.axis.title, self.axis.format_range(range)),
            None => self.axis.title.to_owned(),
        };
        let top = pos2(area.left(), outer.top());
        painter.text(top, Align2::LEFT_TOP, title, font, text);
        if let Some([lo, hi]) = range {
            let brushed = Rect::from_x_y_ranges(x_of(lo)..=x_of(hi), area.y_range());
            painter.rect_filled(brushed, 0.0, BRUSH);
            painter.rect_stroke(
                brushed,
                0.0,
                Stroke::new(1.5, text),
                egui::StrokeKind::Inside,
            );
        }
        let step = area.width() / n as f32;
        for (i, &[full, empty]) in self.bars.counts.iter().enumerate() {
            let left = area.left() + step * i as f32;
            let gap = if step > 4.0 { 1.0 } else { 0.0 };
            let all = full + empty;
            let height = if self.log {
                (all as f64).ln_1p() / (highest as f64).ln_1p()
            } else {
                all as f64 / highest as f64
            };
            let unit = area.height() * height as f32 / all.max(1) as f32;
            let y = |count: u64| area.bottom() - unit * count as f32;
            let part = |from: u64, to: u64| {
                Rect::from_min_max(pos2(left + gap, y(to)), pos2(left + step - gap, y(from)))
            };
            painter.rect_filled(part(0, full), 0.0, FULL);
            if empty > 0 {
                let stroke = Stroke::new(1.0, text);
                let hollow = part(full, full + empty);
                painter.rect_stroke(hollow, 0.0, stroke, egui::StrokeKind::Inside);
            }
        }
        if let Some(value) = self.marked {
            let x = x_of(value.max(self.bars.start));
            painter.vline(x, area.y_range(), Stroke::new(2.0, text));
            let (at, anchor) = if x < area.center().x {
                (x + 3.0, Align2::LEFT_TOP)
            } else {
                (x - 3.0, Align2::RIGHT_TOP)
            };
            let at = pos2(at, area.top());
            painter.text(at, anchor, "selected", small.clone(), text);
        }
        let axis = Stroke::new(1.0, weak);
        painter.hline(area.x_range(), area.bottom(), axis);
        for (count, anchor) in [(highest, Align2::RIGHT_TOP), (0, Align2::RIGHT_BOTTOM)] {
            let y = if count == 0 {
                area.bottom()
            } else {
                area.top()
            };
            let at = pos2(area.left() - 3.0, y);
            painter.text(at, anchor, count_text(count), small.clone(), weak);
        }
        let middle = pos2(area.left() - 3.0, area.center().y);
        painter.text(
            middle,
            Align2::RIGHT_CENTER,
            self.axis.counted,
            small.clone(),
            weak,
        );
        self.ticks(&painter, area, &small, weak);
        // In the middle of the whole: it can be wider than the bars.
        let below = pos2(outer.center().x, outer.bottom());
        painter.text(below, Align2::CENTER_BOTTOM, self.axis.unit, small, weak);
    }

    /// Numbers below the bars: as many as there is room for.
    fn ticks(&self, painter: &egui::Painter, area: Rect, font: &FontId, color: Color32) {
        let n = self.bars.counts.len();
        let room = (area.width() / 48.0).max(1.0) as usize;
        let every = n.div_ceil(room).max(1);
        let step = area.width() / n as f32;
        let mut free_from = f32::NEG_INFINITY;
        for i in (0..n).step_by(every) {
            let [lo, hi] = self.values_of([i, i]);
            let (x, value) = match self.axis.spread {
                Spread::Whole => (step * (i as f32 + 0.5), (lo + 0.5).min(hi - 0.5)),
                Spread::Powers | Spread::Counts => (step * i as f32, lo),
            };
            let at = pos2(area.left() + x, area.bottom() + 2.0);
            painter.vline(at.x, area.bottom()..=at.y, Stroke::new(1.0, color));
            let text = painter.layout_no_wrap(self.axis.format(value), font.clone(), color);
            let place = Align2::CENTER_TOP.anchor_size(at, text.size());
            if place.left() >= free_from {
                free_from = place.right() + 6.0;
                painter.galley(place.min, text, color);
            }
        }
    }
}

/// A number of leaves or rays in the room beside an axis.
fn count_text(count: u64) -> String {
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => format!("{:.0}k", count as f64 / 1e3),
        _ => format!("{:.1}M", count as f64 / 1e6),
    }
}
