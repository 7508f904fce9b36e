//! The stacked bar of terms, and the table that is its legend.

use crate::measure::model::Part;
use crate::present::number::{Digits, grouped};
use egui::{Color32, FontId, Rect, Sense, Stroke, StrokeKind, pos2, vec2};

/// Colors that color-blind people can tell apart (M. Okabe and K. Ito, 2008); numbers tell the same.
const COLORS: [Color32; 8] = [
    Color32::from_rgb(0, 114, 178),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(150, 150, 150),
];

/// Height of a bar in points.
const HEIGHT: f32 = 26.0;

/// What a letter in a bar takes in points, at most.
const LETTER: f32 = 8.0;

/// Shows the bar, that of the measured time below it, and the table.
pub fn show(ui: &mut egui::Ui, parts: &[Part], measured: Option<f64>) {
    let sum: f64 = parts.iter().map(Part::seconds).sum();
    let most = measured.unwrap_or(0.0).max(sum);
    if most > 0.0 {
        stacked(ui, parts, sum, most);
        if let Some(measured) = measured {
            single(ui, measured, most);
        }
    }
    table(ui, parts, sum);
}

/// A place's number in the bar and in the table, from 1.
fn number(place: usize) -> String {
    (place + 1).to_string()
}

fn share(part: &Part, sum: f64) -> f64 {
    if sum > 0.0 { part.seconds() / sum } else { 0.0 }
}

/// The terms beside each other, as long as they take.
fn stacked(ui: &mut egui::Ui, parts: &[Part], sum: f64, most: f64) {
    let size = vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let words = parts.iter().map(|part| words(part, sum));
    let name = format!("Time by term: {}", words.collect::<Vec<_>>().join(", "));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let painter = ui.painter().with_clip_rect(rect);
    let mut left = rect.left();
    for (place, part) in parts.iter().enumerate() {
        let width = (part.seconds() / most) as f32 * rect.width();
        let piece = Rect::from_min_size(pos2(left, rect.top()), vec2(width, HEIGHT));
        left += width;
        painter.rect_filled(piece, 0.0, COLORS[place % COLORS.len()]);
        let edge = Stroke::new(1.0, ui.visuals().panel_fill);
        painter.rect_stroke(piece, 0.0, edge, StrokeKind::Inside);
        let long = format!("{} {}", number(place), part.term.name());
        let texts = [long, number(place)];
        let fits = |text: &&String| text.chars().count() as f32 * LETTER <= width;
        if let Some(text) = texts.iter().find(fits) {
            let (font, middle) = (FontId::proportional(13.0), egui::Align2::CENTER_CENTER);
            painter.text(piece.center(), middle, text, font, Color32::BLACK);
        }
        let id = response.id.with(place);
        ui.interact(piece, id, Sense::hover())
            .on_hover_text(format!(
                "{}\n{}",
                self::words(part, sum),
                part.term.meaning()
            ));
    }
}

/// The measured time to the same scale.
fn single(ui: &mut egui::Ui, seconds: f64, most: f64) {
    let size = vec2(ui.available_width(), HEIGHT * 0.7);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let text = format!("measured T_TR: {}", Digits::Four.seconds(seconds));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &text));
    let ink = ui.visuals().text_color();
    let width = (seconds / most) as f32 * rect.width();
    let bar = Rect::from_min_size(rect.min, vec2(width, rect.height()));
    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_stroke(bar, 0.0, Stroke::new(1.5, ink), StrokeKind::Inside);
    let (font, left) = (FontId::proportional(12.0), egui::Align2::LEFT_CENTER);
    painter.text(rect.left_center() + vec2(6.0, 0.0), left, &text, font, ink);
    response.on_hover_text(
        "CPU time of the picture, summed over all threads, on the scale of the bar above. It is longer \
         than predicted while other work keeps the machine busy.",
    );
}

/// A term's part in a line.
fn words(part: &Part, sum: f64) -> String {
    format!(
        "{}: {}, {}",
        part.term.name(),
        Digits::Four.seconds(part.seconds()),
        Digits::Three.percent(share(part, sum))
    )
}

fn table(ui: &mut egui::Ui, parts: &[Part], sum: f64) {
    egui::Grid::new("time by term")
        .num_columns(6)
        .striped(true)
        .spacing(vec2(14.0, 3.0))
        .show(ui, |ui| {
            for (title, about) in [
                ("", "The number and the color in the bar"),
                ("term", "The paper's symbol, and the kind of primitive"),
                ("each", "Time of one"),
                (
                    "count",
                    "How often: nodes traversed, tests, or rays (const)",
                ),
                ("time", "Count times the time of one: CPU time"),
                ("share", "Share of the predicted time"),
            ] {
                ui.strong(title).on_hover_text(about);
            }
            ui.end_row();
            for (place, part) in parts.iter().enumerate() {
                let about = part.term.meaning();
                swatch(ui, place);
                ui.label(part.term.name()).on_hover_text(&about);
                for text in [
                    Digits::Four.seconds(part.each),
                    grouped(part.count as f64),
                    Digits::Four.seconds(part.seconds()),
                    Digits::Three.percent(share(part, sum)),
                ] {
                    ui.label(egui::RichText::new(text).monospace());
                }
                ui.end_row();
            }
            for text in ["", "sum", "", ""] {
                ui.label(text);
            }
            ui.label(egui::RichText::new(Digits::Four.seconds(sum)).monospace());
            ui.end_row();
        });
}

/// A term's number on its color.
fn swatch(ui: &mut egui::Ui, place: usize) {
    let (rect, _) = ui.allocate_exact_size(vec2(18.0, 16.0), Sense::hover());
    let painter = ui.painter();
    painter.rect_filled(rect, 2.0, COLORS[place % COLORS.len()]);
    let (font, middle) = (FontId::proportional(12.0), egui::Align2::CENTER_CENTER);
    painter.text(rect.center(), middle, number(place), font, Color32::BLACK);
}
