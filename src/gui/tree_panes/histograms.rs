//! Histograms of the leaves. Dragging over bars selects leaves: the 3D view shows them alone.

use super::{is_under_pointer, waiting};
use crate::gui::inspect::TreeKey;
use crate::gui::shortcuts::{Action, Scope, pressed, tip};
use crate::gui::state::State;
use crate::gui::symbol::grouped;
use crate::overlay::{Bars, HISTOGRAM_COUNT, HISTOGRAMS, Histogram, Leaf, Ranges};
use crate::tree::NodeKind;
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, pos2, vec2};
use std::sync::Arc;

/// The histograms of the latest tree.
#[derive(Default)]
pub struct Histograms {
    bars: Option<(TreeKey, [Bars; HISTOGRAM_COUNT])>,
    /// The bar where a drag began.
    from: usize,
    /// Whether heights go by the logarithm, so that low bars are seen beside high ones.
    log: bool,
}

/// The most bars that can be told apart in a third of a narrow pane.
const MOST_BARS: usize = 36;

const FULL: Color32 = Color32::from_rgb(76, 145, 205);
const BRUSH: Color32 = Color32::from_rgba_premultiplied(60, 46, 0, 70);

impl Histograms {
    pub fn ui(&mut self, ui: &mut egui::Ui, state: &mut State) {
        let Some(current) = &state.current else {
            return;
        };
        let Some(leaves) = state.inspect.leaves(current, ui.ctx()) else {
            waiting(ui);
            return;
        };
        let tree = &current.shown.tree;
        let key = TreeKey(Arc::clone(tree));
        if self.bars.as_ref().is_none_or(|(of, _)| *of != key) {
            let bars = std::array::from_fn(|i| HISTOGRAMS[i].bars(&leaves, MOST_BARS));
            self.bars = Some((key, bars));
        }
        if pressed(ui.ctx(), Scope::Leaves, is_under_pointer(ui)).contains(&Action::ClearRanges) {
            state.inspect.ranges = Ranges::default();
        }
        let [selected, of] = state.inspect.selected_leaves(&leaves);
        ui.horizontal(|ui| {
            ui.strong(format!(
                "{} of {} leaves selected",
                grouped(selected),
                grouped(of)
            ));
            let some = state.inspect.ranges.iter().any(Option::is_some);
            if ui
                .add_enabled(some, egui::Button::new("Clear ranges"))
                .on_hover_text(tip("Select all leaves again.", Action::ClearRanges))
                .clicked()
            {
                state.inspect.ranges = Ranges::default();
            }
            ui.checkbox(&mut self.log, "Log heights").on_hover_text(
                "Bars as high as the logarithm of their leaves, so that few are seen beside many; \
                 the full share of a bar stays true.",
            );
            let key = "filled: full leaves · hollow: empty · drag to select";
            ui.add(egui::Label::new(key).truncate());
        });
        let marked = current.selection.node.and_then(|node| {
            let cell = tree.cell_of(node);
            match tree.kind(node) {
                NodeKind::Leaf { count, .. } => Some(Leaf {
                    depth: cell.depth,
                    objects: count,
                    volume: cell.bounds.volume(),
                }),
                NodeKind::Inner { .. } => None,
            }
        });
        let Some((_, all)) = &self.bars else {
            return;
        };
        let size = crate::gui::rest_of(ui);
        let gap = 10.0;
        let width = ((size.x - gap * 2.0) / HISTOGRAM_COUNT as f32).max(40.0);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = gap;
            for (i, bars) in all.iter().enumerate() {
                let range = &mut state.inspect.ranges[i];
                let plot = Plot {
                    histogram: &HISTOGRAMS[i],
                    bars,
                    log: self.log,
                    marked: marked.map(|leaf| HISTOGRAMS[i].value(&leaf)),
                };
                plot.ui(ui, vec2(width, size.y), range, &mut self.from);
            }
        });
    }
}

/// One histogram in one frame.
struct Plot<'a> {
    histogram: &'a Histogram,
    bars: &'a Bars,
    log: bool,
    /// Value of the selected leaf.
    marked: Option<f64>,
}

impl Plot<'_> {
    fn ui(
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
                format!("Histogram: {}", self.histogram.title),
            )
        });
        let area = Rect::from_min_max(outer.min + vec2(34.0, 18.0), outer.max - vec2(8.0, 32.0));
        if !area.is_positive() || self.bars.counts.is_empty() {
            return;
        }
        self.brush(&response, area, range, from);
        self.paint(ui, outer, area, *range);
        if let Some(at) = response.hover_pos().filter(|at| area.contains(*at)) {
            let bar = self.bar_at(area, at.x);
            let [full, empty] = self.bars.counts[bar];
            let [lo, hi] = self.values_of([bar, bar]);
            let text = format!(
                "{}: {} {}\n{} full and {} empty leaves",
                self.histogram.title,
                self.text([lo, hi]),
                self.histogram.unit,
                grouped(full as usize),
                grouped(empty as usize)
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
        if response.dragged() {
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

    fn text(&self, [lo, hi]: [f64; 2]) -> String {
        use crate::overlay::Spread;
        let (lo, hi) = match self.histogram.spread {
            // Bars lie around whole numbers.
            Spread::Whole => (lo + 0.5, hi - 0.5),
            Spread::Powers => (lo, hi),
        };
        if lo == hi {
            self.histogram.format(lo)
        } else {
            format!(
                "{} to {}",
                self.histogram.format(lo),
                self.histogram.format(hi)
            )
        }
    }

    fn paint(&self, ui: &egui::Ui, outer: Rect, area: Rect, range: Option<[f64; 2]>) {
        let painter = ui.painter().with_clip_rect(outer);
        let (text, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
        let (font, small) = (FontId::proportional(12.5), FontId::proportional(10.5));
        let n = self.bars.counts.len();
        let highest = self.bars.highest().max(1);
        let x_of = |value: f64| {
            let place = (value - self.bars.start) / (self.bars.end() - self.bars.start);
            area.left() + area.width() * place.clamp(0.0, 1.0) as f32
        };
        let title = match range {
            Some(range) => format!("{}: {}", self.histogram.title, self.text(range)),
            None => self.histogram.title.to_owned(),
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
                f64::from(all).ln_1p() / f64::from(highest).ln_1p()
            } else {
                f64::from(all) / f64::from(highest)
            };
            let unit = area.height() * height as f32 / all.max(1) as f32;
            let y = |count: u32| area.bottom() - unit * count as f32;
            let part = |from: u32, to: u32| {
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
        painter.text(middle, Align2::RIGHT_CENTER, "leaves", small.clone(), weak);
        self.ticks(&painter, area, &small, weak);
        let below = pos2(area.center().x, outer.bottom());
        painter.text(
            below,
            Align2::CENTER_BOTTOM,
            self.histogram.unit,
            small,
            weak,
        );
    }

    /// Numbers below the bars: as many as there is room for.
    fn ticks(&self, painter: &egui::Painter, area: Rect, font: &FontId, color: Color32) {
        use crate::overlay::Spread;
        let n = self.bars.counts.len();
        let room = (area.width() / 48.0).max(1.0) as usize;
        let every = n.div_ceil(room).max(1);
        let step = area.width() / n as f32;
        for i in (0..n).step_by(every) {
            let [lo, hi] = self.values_of([i, i]);
            let (x, value) = match self.histogram.spread {
                Spread::Whole => (step * (i as f32 + 0.5), (lo + 0.5).min(hi - 0.5)),
                Spread::Powers => (step * i as f32, lo),
            };
            let at = pos2(area.left() + x, area.bottom() + 2.0);
            painter.vline(at.x, area.bottom()..=at.y, Stroke::new(1.0, color));
            let text = self.histogram.format(value);
            painter.text(at, Align2::CENTER_TOP, text, font.clone(), color);
        }
    }
}

/// A number of leaves in the room beside an axis.
fn count_text(count: u32) -> String {
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => format!("{:.0}k", f64::from(count) / 1e3),
        _ => format!("{:.1}M", f64::from(count) / 1e6),
    }
}
