//! The legend below the picture: what the colours mean, how many pixels have them, and where the
//! pointer's and the picked pixel's values lie.

use super::look::Look;
use super::{HeatView, Progress};
use crate::gui::document::Document;
use crate::gui::widgets::hidden::HIDDEN;
use crate::gui::widgets::scale_bar::{NUMBERS, TICK, color_bar, numbers};
use crate::gui::widgets::symbol::grouped;
use egui::{Color32, Painter, Rect, Shape, Stroke, pos2, vec2};

/// Heights in points.
const HISTOGRAM: f32 = 34.0;
const BAR: f32 = 12.0;
/// Of the whole legend, until it was laid out once: in a short pane, and in others.
const USUAL: [f32; 2] = [106.0, 152.0];
/// A pane of less than this is short.
const SHORT: f32 = 480.0;
/// A mark's half width.
const MARK: f32 = 5.0;

impl HeatView {
    /// Height to keep free for the legend; none without a heatmap.
    pub fn legend_height(&self) -> f32 {
        if self.choice.heatmap.is_none() {
            0.0
        } else {
            let [short, usual] = USUAL;
            self.legend_height
                .max(if self.short { short } else { usual })
        }
    }

    /// Whether a lesson asks for what the heatmap tells.
    pub fn is_secret(&self, doc: &Document) -> bool {
        let heatmap = self.choice.heatmap();
        heatmap.is_some_and(|(_, heatmap)| doc.asked.hides_heatmap(heatmap.symbol))
    }

    /// Shows the legend of what is on view, or why there is nothing yet.
    pub fn legend(&mut self, ui: &mut egui::Ui, doc: &Document, hovered: Option<[u32; 2]>) {
        if self.choice.heatmap.is_none() {
            return;
        }
        let short = ui.max_rect().height() < SHORT;
        if short != self.short {
            (self.short, self.legend_height) = (short, 0.0);
        }
        let shown = ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Truncate);
            if self.is_secret(doc) {
                ui.set_min_height(self.legend_height());
                ui.weak(HIDDEN);
                return;
            }
            match self.look().cloned() {
                Some(look) => self.contents(ui, &look, doc, hovered),
                None => {
                    // The picture keeps its size while its values are on their way.
                    ui.set_min_height(self.legend_height());
                    self.waiting(ui, doc);
                }
            }
        });
        let height = shown.response.rect.height();
        if height != self.legend_height {
            self.legend_height = height;
            ui.ctx().request_repaint();
        }
    }

    fn waiting(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let Some((_, heatmap)) = self.choice.heatmap() else {
            return;
        };
        ui.strong(format!("{} · {}", heatmap.symbol, heatmap.name));
        ui.add(egui::Label::new(self.note(doc)).wrap());
        if self.is_timed() {
            self.timing_button(ui);
        }
    }

    /// Stops the pass that takes the times, or begins it anew.
    fn timing_button(&mut self, ui: &mut egui::Ui) {
        let (name, about) = match self.timing().progress() {
            Progress::Waiting | Progress::Done => return,
            Progress::Running(_) => ("Cancel timing", "Stop taking the time of every pixel."),
            Progress::Ended(_) => ("Take times", "Take the time of every pixel after all."),
        };
        if ui.button(name).on_hover_text(about).clicked() {
            match self.timing().progress() {
                Progress::Running(_) => self.timing().cancel(),
                _ => self.timing().again(),
            }
        }
    }

    fn contents(&self, ui: &mut egui::Ui, look: &Look, doc: &Document, hovered: Option<[u32; 2]>) {
        self.words(ui, look);
        let picked = doc.current.as_ref().and_then(|c| c.picked_pixel());
        scale(ui, look, hovered, picked);
        let text = |pixel: Option<[u32; 2]>| {
            let none = || format!("– {}", look.heatmap().unit);
            pixel.map_or_else(none, |pixel| look.value_text(pixel))
        };
        marked(ui, Mark::Pointer, &format!("Pointer: {}", text(hovered)));
        let mut words = format!("Picked: {}", text(picked));
        let ranked = doc.current.as_ref().and_then(|c| self.rank_of_picked(c));
        if let Some(ranked) = ranked {
            let (rank, of) = (grouped(ranked.rank + 1), grouped(ranked.of));
            words += &format!(" · rank {rank} of {of}");
        }
        marked(ui, Mark::Picked, &words);
    }

    /// What is shown in which unit, of which rays and how: three lines, or one in a short pane,
    /// whose tooltip has the rest.
    fn words(&self, ui: &mut egui::Ui, look: &Look) {
        let heatmap = look.heatmap();
        let title = look.title();
        let mut terms = look.terms();
        if self.choice.opacity < 1.0 {
            let percent = self.choice.opacity * 100.0;
            terms += &format!(" · {percent:.0} % over the picture");
        }
        let (unit, meaning) = (heatmap.unit, heatmap.meaning);
        let (span, whole) = (look.span(), look.whole());
        let without = look.without();
        let about = format!("{meaning}\nIn {unit} · {terms}\n{span}\n{whole}");
        if self.short {
            let without = without.map_or_else(String::new, |text| format!("{text} · "));
            ui.horizontal(|ui| {
                ui.strong(title).on_hover_text(&about);
                ui.label(format!("{unit} · {without}{terms}"))
                    .on_hover_text(&about);
            });
        } else {
            let without = without.map_or_else(String::new, |text| format!("; {text}"));
            ui.strong(title).on_hover_text(&about);
            ui.label(format!("{unit} · {terms}")).on_hover_text(&about);
            ui.label(format!("{span}{without}")).on_hover_text(&about);
        }
    }
}

/// What stands at a value of the colour bar; told apart by shape.
#[derive(Clone, Copy)]
enum Mark {
    /// A filled triangle.
    Pointer,
    /// A hollow diamond.
    Picked,
}

impl Mark {
    /// Draws it with its lower tip at a point.
    fn draw(self, painter: &Painter, tip: egui::Pos2, ink: Color32, ground: Color32) {
        let points = match self {
            Mark::Pointer => vec![
                tip,
                tip + vec2(-MARK, -1.6 * MARK),
                tip + vec2(MARK, -1.6 * MARK),
            ],
            Mark::Picked => vec![
                tip,
                tip + vec2(-MARK, -MARK),
                tip + vec2(0.0, -2.0 * MARK),
                tip + vec2(MARK, -MARK),
            ],
        };
        let fill = match self {
            Mark::Pointer => ink,
            Mark::Picked => ground,
        };
        painter.add(Shape::convex_polygon(points, fill, Stroke::new(1.5, ink)));
    }
}

/// A line of text behind the mark that it explains.
fn marked(ui: &mut egui::Ui, mark: Mark, text: &str) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let (rect, _) = ui.allocate_exact_size(vec2(2.0 * MARK, 14.0), egui::Sense::hover());
        let visuals = ui.visuals();
        let (ink, ground) = (visuals.text_color(), visuals.panel_fill);
        mark.draw(ui.painter(), rect.center() + vec2(0.0, MARK), ink, ground);
        ui.label(text);
    });
}

/// Histogram, colour bar and numbers on one axis.
fn scale(ui: &mut egui::Ui, look: &Look, hovered: Option<[u32; 2]>, picked: Option<[u32; 2]>) {
    let size = vec2(ui.available_width(), HISTOGRAM + BAR + TICK + NUMBERS);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    let Some(range) = &look.scale else {
        return;
    };
    let unit = look.heatmap().unit;
    let name = format!(
        "Legend from {} to {} {unit}",
        super::look::exact(range.lo),
        super::look::exact(range.hi)
    );
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let most = look.histogram.iter().copied().max().unwrap_or(0);
    let mut about = format!(
        "{name}\nColumns: how many pixels have these colours, by the logarithm; the highest {} \
         pixels",
        grouped(most as usize)
    );
    let [below, above] = look.beyond.map(grouped);
    if look.beyond != [0; 2] {
        about += &format!("\nBelow the range: {below} pixels; above: {above} pixels");
    }
    response.on_hover_text(about);

    // Room for a mark at either end.
    let axis = rect.shrink2(vec2(MARK, 0.0));
    let painter = ui.painter().with_clip_rect(rect);
    let visuals = ui.visuals();
    let (ink, soft, ground) = (
        visuals.text_color(),
        visuals.weak_text_color(),
        visuals.panel_fill,
    );
    let bar = Rect::from_min_size(axis.min + vec2(0.0, HISTOGRAM), vec2(axis.width(), BAR));
    columns(&painter, look, bar, soft);
    color_bar(
        &painter,
        &crate::present::overlay::COLORMAPS[look.key.colors],
        bar,
    );
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, soft), egui::StrokeKind::Outside);
    numbers(&painter, range, look.beyond, bar, rect, ink);
    let room = HISTOGRAM - 2.0;
    for (mark, pixel) in [(Mark::Picked, picked), (Mark::Pointer, hovered)] {
        if let Some(place) = pixel.and_then(|pixel| look.place(pixel)) {
            let x = bar.left() + place as f32 * bar.width();
            let line = [pos2(x, bar.top() - room), pos2(x, bar.bottom())];
            painter.line_segment(line, Stroke::new(3.0, ground));
            painter.line_segment(line, Stroke::new(1.0, ink));
            mark.draw(&painter, pos2(x, bar.top()), ink, ground);
        }
    }
}

/// One column for each stretch of the bar, as high as the logarithm of its pixels: rare values are
/// what is looked for.
fn columns(painter: &Painter, look: &Look, bar: Rect, color: Color32) {
    let most = look.histogram.iter().copied().max().unwrap_or(0) as f32;
    let step = bar.width() / look.histogram.len() as f32;
    for (i, &count) in look.histogram.iter().enumerate() {
        if count > 0 {
            let height = (HISTOGRAM - 4.0) * (1.0 + count as f32).ln() / (1.0 + most).ln();
            let corner = pos2(bar.left() + i as f32 * step, bar.top() - height);
            let column = Rect::from_min_size(corner, vec2(step, height));
            painter.rect_filled(column, 0.0, color);
        }
    }
}
