//! Histograms of the leaves and of the rays. Dragging over bars of leaves selects leaves: the 3D view
//! shows them alone. Dragging over bars of rays selects pixels: the picture marks them.

use crate::gui::action::{Gesture, actions, tip};
use crate::gui::document::inspect::{LeavesKey, TreeKey};
use crate::gui::pane::{Cx, Pane, PaneAction};
use crate::gui::widgets::common::waiting;
use crate::gui::widgets::symbol::grouped;
use crate::gui::widgets::visits_note::visits_note;
use crate::present::overlay::{
    Bars, HISTOGRAMS, HistogramAxis, Leaf, NODES_PER_RAY, Spread, ray_bars,
};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, pos2, vec2};
use std::sync::Arc;

/// The histograms of the latest tree and picture.
#[derive(Default)]
pub struct Histograms {
    bars: Option<(LeavesKey, Vec<Bars>)>,
    /// The bar where a drag began.
    from: usize,
    /// Whether heights go by the logarithm, so that low bars are seen beside high ones.
    log: bool,
}

/// The most bars that can be told apart in a third of a narrow pane.
const MOST_BARS: usize = 36;

/// The least width of a histogram beside others, in points.
const LEAST_WIDTH: f32 = 185.0;

const FULL: Color32 = Color32::from_rgb(76, 145, 205);
const BRUSH: Color32 = Color32::from_rgba_premultiplied(60, 46, 0, 70);

impl Pane for Histograms {
    const ID: &'static str = "histograms";
    const TITLE: &'static str = "Histograms";
    const ALIASES: &'static [&'static str] = &["Leaf histograms"];
    const ABOUT: &'static str = "How leaves and rays are distributed; drag to select.";
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "histograms.clear-ranges" Here NONE [Delete] "Select all leaves again" => |_, cx| cx.doc.inspect.clear_ranges();
    };
    const GESTURES: &'static [Gesture] = &[Gesture {
        gesture: "Drag",
        about: "Select the leaves of these bars; click: of one bar, again: of all",
    }];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = &mut *cx.doc;
        let Some(current) = &doc.current else {
            return;
        };
        let visits = doc.inspect.visits.of(current, &doc.jobs);
        let Some(leaves) = doc.inspect.leaves(current, visits.as_ref(), ui.ctx()) else {
            waiting(ui);
            return;
        };
        let tree = &current.shown.tree;
        let picture = visits.as_ref().map(|_| current.number);
        let key = (TreeKey(Arc::clone(tree)), picture);
        if self.bars.as_ref().is_none_or(|(of, _)| *of != key) {
            let of_leaves = HISTOGRAMS.iter().map(|h| h.bars(&leaves, MOST_BARS));
            let of_rays = visits.iter().map(|visits| ray_bars(visits, MOST_BARS));
            self.bars = Some((key, of_leaves.chain(of_rays).collect()));
        }
        let [selected, of] = doc.inspect.selected_leaves(&leaves);
        ui.horizontal(|ui| {
            ui.strong(format!(
                "{} of {} leaves selected",
                grouped(selected),
                grouped(of)
            ));
            let some =
                doc.inspect.ranges.iter().any(Option::is_some) || doc.inspect.nodes_a_ray.is_some();
            if ui
                .add_enabled(some, egui::Button::new("Clear ranges"))
                .on_hover_text(tip(
                    "Select all leaves and rays again.",
                    "histograms.clear-ranges",
                ))
                .clicked()
            {
                doc.inspect.clear_ranges();
            }
            ui.checkbox(&mut self.log, "Log heights").on_hover_text(
                "Bars as high as the logarithm of their leaves, so that few are seen beside many; \
                 the full share of a bar stays true.",
            );
            if visits_note(ui, &doc.inspect.visits, current) {
                cx.edits.add(|doc| doc.inspect.visits.cancel_or_restart());
            }
            let key = "filled: full leaves, rays · hollow: empty leaves · drag to select";
            ui.add(egui::Label::new(key).truncate());
        });
        let node = current.selection.node;
        let marked = node.and_then(|node| {
            let cell = tree.cell_of(node);
            Leaf::of(tree, &cell, visits.as_deref().map(|v| &v.visits))
        });
        let Some((_, all)) = &self.bars else {
            return;
        };
        let nothing = Bars {
            start: 0.0,
            width: 1.0,
            counts: Vec::new(),
        };
        let plots: Vec<_> = HISTOGRAMS
            .iter()
            .map(|histogram| {
                (
                    &histogram.axis,
                    marked.and_then(|leaf| histogram.value(&leaf)),
                )
            })
            .chain([(&NODES_PER_RAY, None)])
            .collect();
        let ranges = doc.inspect.ranges.iter_mut();
        let mut ranges: Vec<_> = ranges.chain([&mut doc.inspect.nodes_a_ray]).collect();
        let size = crate::gui::widgets::common::rest_of(ui);
        let gap = 8.0;
        let columns = ((size.x / LEAST_WIDTH) as usize).clamp(1, plots.len());
        let rows = plots.len().div_ceil(columns);
        let width = (size.x + gap) / columns as f32 - gap;
        let height = ((size.y + gap) / rows as f32 - gap).max(80.0);
        ui.spacing_mut().item_spacing = vec2(gap, gap);
        egui::ScrollArea::vertical().show(ui, |ui| {
            for first in (0..plots.len()).step_by(columns) {
                ui.horizontal(|ui| {
                    for i in first..(first + columns).min(plots.len()) {
                        let (axis, marked) = plots[i];
                        let plot = Plot {
                            axis,
                            bars: all.get(i).unwrap_or(&nothing),
                            log: self.log,
                            marked,
                            selects_pixels: i >= HISTOGRAMS.len(),
                        };
                        plot.ui(ui, vec2(width, height), ranges[i], &mut self.from);
                    }
                });
            }
        });
    }
}

/// One histogram in one frame.
struct Plot<'a> {
    axis: &'static HistogramAxis,
    /// None where there is nothing to count, or while it is not counted.
    bars: &'a Bars,
    log: bool,
    /// Value of the selected leaf.
    marked: Option<f64>,
    /// A range selects pixels, not leaves.
    selects_pixels: bool,
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
                format!("Histogram: {}", self.axis.title),
            )
        });
        let area = Rect::from_min_max(outer.min + vec2(34.0, 18.0), outer.max - vec2(8.0, 32.0));
        if !area.is_positive() {
            return;
        }
        if self.bars.counts.is_empty() {
            let text = format!("{}: not counted yet", self.axis.title);
            let color = ui.visuals().weak_text_color();
            let painter = ui.painter().with_clip_rect(outer);
            let at = outer.left_top() + vec2(34.0, 0.0);
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
                    "{} rays of all kinds\nA range marks the pixels in the picture of which at \
                     least one ray visits so many nodes.",
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
        let below = pos2(area.center().x, outer.bottom());
        painter.text(below, Align2::CENTER_BOTTOM, self.axis.unit, small, weak);
    }

    /// Numbers below the bars: as many as there is room for.
    fn ticks(&self, painter: &egui::Painter, area: Rect, font: &FontId, color: Color32) {
        let n = self.bars.counts.len();
        let room = (area.width() / 48.0).max(1.0) as usize;
        let every = n.div_ceil(room).max(1);
        let step = area.width() / n as f32;
        for i in (0..n).step_by(every) {
            let [lo, hi] = self.values_of([i, i]);
            let (x, value) = match self.axis.spread {
                Spread::Whole => (step * (i as f32 + 0.5), (lo + 0.5).min(hi - 0.5)),
                Spread::Powers | Spread::Counts => (step * i as f32, lo),
            };
            let at = pos2(area.left() + x, area.bottom() + 2.0);
            painter.vline(at.x, area.bottom()..=at.y, Stroke::new(1.0, color));
            let text = self.axis.format(value);
            painter.text(at, Align2::CENTER_TOP, text, font.clone(), color);
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
