//! The legend below the picture: what the colors mean, how many pixels have them, and where the values
//! of the pointer and of the picked pixel lie.

use super::look::Look;
use super::{HeatView, Progress, chosen, is_timed};
use crate::gui::document::Document;
use crate::gui::theme::hint;
use crate::gui::widgets::hidden::HIDDEN;
use crate::gui::widgets::scale_bar::{NUMBERS, TICK, color_bar, numbers};
use crate::gui::widgets::symbol::grouped;
use egui::{Color32, Painter, Rect, Shape, Stroke, pos2, vec2};

/// Height of the color bar in points.
const BAR: f32 = 12.0;
/// Height of a line of the legend.
const LINE: f32 = 20.0;
/// From this width on, the line of a short legend has room for the terms.
const WIDE: f32 = 900.0;
/// From this width on, the last line of a full legend has room for units.
const WITH_UNITS: f32 = 560.0;
/// A mark's half width.
const MARK: f32 = 5.0;

/// How much the legend says.
#[derive(Clone, Copy, PartialEq)]
enum Size {
    /// One line and the scale.
    Short,
    Full,
}

impl Size {
    /// The full legend where the picture leaves room for it below.
    fn in_room(room: f32) -> Size {
        if room >= Size::Full.height() {
            Size::Full
        } else {
            Size::Short
        }
    }

    fn histogram(self) -> f32 {
        match self {
            Size::Short => 18.0,
            Size::Full => 34.0,
        }
    }

    fn scale(self) -> f32 {
        self.histogram() + BAR + TICK + NUMBERS
    }

    fn height(self) -> f32 {
        let lines = match self {
            Size::Short => 1.0,
            // The title, three lines of terms, and the marks.
            Size::Full => 5.0,
        };
        lines * LINE + self.scale()
    }
}

/// Returns the height to keep free below a picture that leaves this room.
pub fn height(room: f32) -> f32 {
    Size::in_room(room).height()
}

impl HeatView {
    /// Shows the legend of what is on view, or why there is nothing yet. `room` is what the picture
    /// leaves free below it.
    pub fn legend(
        &mut self,
        ui: &mut egui::Ui,
        doc: &Document,
        room: f32,
        hovered: Option<[u32; 2]>,
    ) {
        let size = Size::in_room(room);
        let area = vec2(ui.available_width(), size.height());
        // The same height whatever it says: the picture above never moves.
        let (rect, _) = ui.allocate_exact_size(area, egui::Sense::hover());
        let mut ui = ui.new_child(egui::UiBuilder::new().max_rect(rect));
        ui.spacing_mut().item_spacing.y = 0.0;
        ui.spacing_mut().interact_size.y = LINE;
        if doc.hides_heatmap() {
            ui.label(hint(HIDDEN));
            return;
        }
        match self.look().cloned() {
            Some(look) => self.contents(&mut ui, &look, doc, size, hovered),
            None => self.waiting(&mut ui, doc),
        }
    }

    fn waiting(&mut self, ui: &mut egui::Ui, doc: &Document) {
        let Some((_, heatmap)) = chosen(doc) else {
            return;
        };
        ui.strong(format!("{} · {}", heatmap.symbol, heatmap.name));
        ui.add(egui::Label::new(self.note(doc)).wrap());
        if is_timed(doc) {
            self.timing_button(ui);
        }
    }

    /// Stops measuring times, or begins again.
    fn timing_button(&mut self, ui: &mut egui::Ui) {
        let (name, about) = match self.timing().progress() {
            Progress::Waiting | Progress::Done => return,
            Progress::Running(_) => ("Cancel timing", "Stop measuring the time of every pixel."),
            Progress::Ended(_) => ("Measure times", "Measure the time of every pixel."),
        };
        if ui.button(name).on_hover_text(about).clicked() {
            match self.timing().progress() {
                Progress::Running(_) => self.timing().cancel(),
                _ => self.timing().again(),
            }
        }
    }

    fn contents(
        &self,
        ui: &mut egui::Ui,
        look: &Look,
        doc: &Document,
        size: Size,
        hovered: Option<[u32; 2]>,
    ) {
        let picked = doc.current.as_ref().and_then(|c| c.picked_pixel());
        let rank = self.order.rank(look.key.values, picked);
        let rank = rank.map_or_else(String::new, |ranked| {
            let (rank, of) = (grouped(ranked.rank + 1), grouped(ranked.of));
            format!(" · rank {rank} of {of}")
        });
        let about = self.about(look);
        match size {
            Size::Short => {
                let is_wide = ui.available_width() >= WIDE;
                ui.horizontal(|ui| {
                    ui.strong(look.title()).on_hover_text(about);
                    if is_wide {
                        let terms = format!("{} · {}", look.heatmap().unit, look.terms());
                        ui.label(hint(terms));
                    }
                    let to_the_left = egui::Layout::right_to_left(egui::Align::Center);
                    ui.with_layout(to_the_left, |ui| {
                        if let Some(pixel) = picked {
                            let text = match look.number_text(pixel) {
                                Some(number) if !is_wide => number,
                                _ => format!("Picked: {}", look.value_text(pixel)),
                            };
                            ui.label(hint(format!("{text}{rank}")));
                            marked(ui, Mark::Picked);
                        }
                    });
                });
                scale(ui, look, size, hovered, picked);
            }
            Size::Full => {
                ui.strong(look.title()).on_hover_text(about);
                let terms = vec2(ui.available_width(), 3.0 * LINE);
                let (rect, _) = ui.allocate_exact_size(terms, egui::Sense::hover());
                let mut area = ui.new_child(egui::UiBuilder::new().max_rect(rect));
                area.add(egui::Label::new(hint(self.terms(look))).wrap());
                scale(ui, look, size, hovered, picked);
                // The unit stands above, too.
                let is_wide = ui.available_width() >= WITH_UNITS;
                let text = |pixel: Option<[u32; 2]>| match pixel {
                    None if is_wide => format!("– {}", look.heatmap().unit),
                    None => "–".to_owned(),
                    Some(pixel) => match look.number_text(pixel) {
                        Some(number) if !is_wide => number,
                        _ => look.value_text(pixel),
                    },
                };
                ui.horizontal(|ui| {
                    ui.spacing_mut().item_spacing.x = 4.0;
                    marked(ui, Mark::Picked);
                    ui.label(hint(format!("Picked: {}{rank}", text(picked))));
                    ui.add_space(12.0);
                    marked(ui, Mark::Pointer);
                    ui.label(hint(format!("Pointer: {}", text(hovered))));
                });
            }
        }
    }

    /// What is shown in which unit, of which rays, and how.
    fn terms(&self, look: &Look) -> String {
        let mut terms = format!("{} · {}", look.heatmap().unit, look.terms());
        if self.choice.opacity < 1.0 {
            let percent = self.choice.opacity * 100.0;
            terms += &format!(" · {percent:.0} % over the picture");
        }
        terms += &format!(" · {}", look.span());
        if let Some(without) = look.without() {
            terms += &format!(" · {without}");
        }
        terms
    }

    fn about(&self, look: &Look) -> String {
        format!(
            "{}\n{}\n{}",
            look.heatmap().meaning,
            self.terms(look),
            look.whole()
        )
    }
}

/// What stands at a value of the color bar; told apart by shape.
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

/// Shows the mark that the text beside it explains.
fn marked(ui: &mut egui::Ui, mark: Mark) {
    let (rect, _) = ui.allocate_exact_size(vec2(2.0 * MARK, 14.0), egui::Sense::hover());
    let visuals = ui.visuals();
    let (ink, ground) = (visuals.text_color(), visuals.panel_fill);
    mark.draw(ui.painter(), rect.center() + vec2(0.0, MARK), ink, ground);
}

/// Histogram, color bar and numbers on one axis.
fn scale(
    ui: &mut egui::Ui,
    look: &Look,
    size: Size,
    hovered: Option<[u32; 2]>,
    picked: Option<[u32; 2]>,
) {
    let area = vec2(ui.available_width(), size.scale());
    let (rect, response) = ui.allocate_exact_size(area, egui::Sense::hover());
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
        "{name}\nColumns: how many pixels have these colors, by the logarithm; the highest {} \
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
    let bar = Rect::from_min_size(
        axis.min + vec2(0.0, size.histogram()),
        vec2(axis.width(), BAR),
    );
    columns(&painter, look, bar, size.histogram() - 4.0, soft);
    color_bar(
        &painter,
        &crate::present::overlay::COLORMAPS[look.key.colors],
        bar,
    );
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, soft), egui::StrokeKind::Outside);
    numbers(&painter, range, look.beyond, bar, rect, ink);
    let room = size.histogram() - 2.0;
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
/// what people look for.
fn columns(painter: &Painter, look: &Look, bar: Rect, highest: f32, color: Color32) {
    let most = look.histogram.iter().copied().max().unwrap_or(0) as f32;
    let step = bar.width() / look.histogram.len() as f32;
    for (i, &count) in look.histogram.iter().enumerate() {
        if count > 0 {
            let height = highest * (1.0 + count as f32).ln() / (1.0 + most).ln();
            let corner = pos2(bar.left() + i as f32 * step, bar.top() - height);
            let column = Rect::from_min_size(corner, vec2(step, height));
            painter.rect_filled(column, 0.0, color);
        }
    }
}
