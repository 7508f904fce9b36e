//! Presenting: the full screen with larger type, for a projector. Picture and 3D view stand over four
//! figures; a lesson keeps its column. The top bar slides in at the upper edge.

use super::app::App;
use super::places::{self, TOP_BAR};
use crate::gui::document::comparing::Which;
use crate::gui::document::{Current, Document, Fact};
use crate::gui::theme;
use crate::gui::widgets::hidden::HIDDEN;
use crate::measure::parameter;
use crate::present::number::Digits;
use egui::{Rect, RichText, UiBuilder, pos2, vec2};

/// How much larger everything is.
const SCALE: f32 = 1.25;
/// The height of the figures, and the distance of picture and 3D view, in points of the usual size.
const FIGURES: f32 = 88.0;
const GAP: f32 = 8.0;
/// So near the upper edge the pointer calls the bar.
const EDGE: f32 = 6.0;

/// The figures by their symbols, with what they count.
const SHOWN: [(&str, &str); 4] = [
    ("N_RPRT", "tests per hit"),
    ("N_AT", "nodes per ray"),
    ("N_LS", "leaves"),
    ("T_TR", "rendering time"),
];

/// Shows the task on view for an audience.
pub fn show(app: &mut App, ui: &mut egui::Ui) {
    let task = app.layout.current();
    match task.id {
        "lessons" => {
            if let Some(column) = &task.left {
                app.left_column(ui, column);
            }
            app.tiles(ui);
        }
        "ray" => {
            if let Some(row) = &task.below {
                app.row_below(ui, row);
            }
            halves(app, ui);
        }
        "explore" => {
            figures(ui, &app.doc);
            halves(app, ui);
        }
        "compare" => {
            figures(ui, &app.doc);
            app.tiles(ui);
        }
        _ => app.tiles(ui),
    }
}

/// Shows the top bar over what is presented, while the pointer is at the upper edge.
pub fn sliding_bar(app: &mut App, ctx: &egui::Context) {
    let seen = seen(ctx);
    if seen == 0.0 {
        return;
    }
    let width = ctx.content_rect().width();
    egui::Area::new(egui::Id::unique("sliding bar"))
        .order(egui::Order::Middle)
        .constrain(false)
        .fixed_pos([0.0, (seen - 1.0) * TOP_BAR])
        .show(ctx, |ui| {
            let rect = Rect::from_min_size(ui.max_rect().min, vec2(width, TOP_BAR));
            let (fill, line) = (ui.visuals().panel_fill, ui.visuals().window_stroke);
            ui.painter().rect_filled(rect, 0.0, fill);
            ui.painter().hline(rect.x_range(), rect.bottom(), line);
            let inside = rect.shrink2(vec2(8.0, 2.0));
            ui.scope_builder(UiBuilder::new().max_rect(inside), |ui| app.top_bar(ui));
            ui.expand_to_include_rect(rect);
        });
}

/// How much of the bar is to be seen: 0 to 1.
fn seen(ctx: &egui::Context) -> f32 {
    let id = egui::Id::unique("presented bar");
    let was = ctx.data(|data| data.get_temp::<bool>(id)).unwrap_or(false);
    let pointer = ctx.pointer_hover_pos();
    let near = pointer.is_some_and(|at| at.y <= if was { TOP_BAR + EDGE } else { EDGE });
    // What was opened from the bar hangs from it.
    let stays = was && (egui::Popup::is_any_open(ctx) || ctx.text_edit_focused());
    let is = near || stays;
    ctx.data_mut(|data| data.insert_temp(id, is));
    ctx.animate_bool(id, is)
}

/// Picture and 3D view, of equal size.
fn halves(app: &mut App, ui: &mut egui::Ui) {
    let frame = egui::Frame::new().fill(ui.visuals().panel_fill);
    egui::CentralPanel::default().frame(frame).show(ui, |ui| {
        let all = ui.max_rect();
        let half = (all.width() - GAP / SCALE) / 2.0;
        let left = Rect::from_min_size(all.min, vec2(half, all.height()));
        let right = Rect::from_min_max(pos2(all.right() - half, all.top()), all.max);
        for (id, rect) in [("picture", left), ("view3d", right)] {
            if let Some(pane) = places::pane(id) {
                ui.scope_builder(UiBuilder::new().id_salt(id).max_rect(rect), |ui| {
                    app.pane(ui, pane);
                });
            }
        }
    });
}

/// Four figures of the tree on view, or of two that are compared.
fn figures(ui: &mut egui::Ui, doc: &Document) {
    egui::Panel::bottom("presented figures")
        .exact_size(FIGURES / SCALE)
        .resizable(false)
        .show(ui, |ui| {
            if doc.hides(&[Fact::Counters(&["N_RPRT", "N_AT", "N_LS", "T_TR"])]) {
                ui.centered_and_justified(|ui| ui.label(theme::hint(HIDDEN)));
                return;
            }
            ui.columns_const(|columns: &mut [egui::Ui; 4]| {
                for (ui, (symbol, words)) in columns.iter_mut().zip(SHOWN) {
                    ui.horizontal_centered(|ui| figure(ui, doc, symbol, words));
                }
            });
        });
}

fn figure(ui: &mut egui::Ui, doc: &Document, symbol: &str, words: &str) {
    let t = theme::tokens(ui);
    let text = |current: &Current| {
        let parameter = parameter(symbol);
        parameter.text(parameter.value(&current.shown.measurement), Digits::Three)
    };
    if doc.other.is_some() {
        for (which, current) in Which::BOTH.into_iter().zip(doc.both()) {
            let color = match which {
                Which::A => t.a,
                Which::B => t.b,
            };
            let text = current.map_or_else(|| "–".to_owned(), text);
            let text = format!("{} {text}", which.name());
            ui.label(theme::figure(text).color(color));
        }
        ui.label(words);
    } else if let Some(current) = &doc.current {
        ui.label(theme::display(text(current)));
        ui.label(RichText::new(words).heading());
    }
}
