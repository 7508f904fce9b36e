//! The outcomes as rows.

use crate::gui::theme::{HINT, named};
use crate::measure::accuracy::{AccuracyStudy, Outcome};
use crate::present::number::{Digits, significant};
use egui::{Align, Sense};
use egui_extras::{Column, TableBuilder};

const COLUMNS: [(&str, f32, &str); 11] = [
    (
        "choice",
        // At least.
        120.0,
        "What differs from the reference; everything else is the same",
    ),
    (
        "front",
        38.0,
        "Whether no other choice is both faster and closer to the reference; choices that change only \
         the time are not part of the front",
    ),
    (
        "time",
        44.0,
        "Median of the rounds, divided by that of the reference",
    ),
    (
        "wrong hits",
        70.0,
        "Share of the pixels whose primary ray hits a different object than that of the reference",
    ),
    (
        "RMSE",
        72.0,
        "Root of the mean squared difference on linear light, 0 to 1",
    ),
    (
        "max",
        54.0,
        "Largest difference of any pixel and color channel on linear light, 0 to 1",
    ),
    (
        "PSNR",
        58.0,
        "Peak signal-to-noise ratio, −20 log₁₀ RMSE, in decibels",
    ),
    (
        "SSIM",
        58.0,
        "Mean structural similarity of the luminance, at most 1 (Wang et al. 2004)",
    ),
    (
        "FLIP",
        54.0,
        "How different it looks when one flips between the pictures, 0 to 1 (Andersson et al. 2020)",
    ),
    (
        "spread",
        98.0,
        "Least and greatest time of the rounds, divided by the reference's median",
    ),
    (
        "objects",
        70.0,
        "Memory of the objects in the form that intersection tests read",
    ),
];

/// Shows the table, scrolled to a row if asked; returns the outcome that is clicked.
pub fn show(
    ui: &mut egui::Ui,
    trade: &AccuracyStudy,
    front: &[bool],
    chosen: Option<usize>,
    scroll: Option<usize>,
) -> Option<usize> {
    let height = ui.text_style_height(&egui::TextStyle::Body) + 2.0;
    let first = name_width(ui, trade);
    let mut clicked = None;
    egui::ScrollArea::horizontal()
        .id_salt("outcomes")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            ui.style_mut().override_text_style = Some(named(HINT));
            let mut builder = TableBuilder::new(ui)
                .striped(true)
                .sense(Sense::click())
                .auto_shrink(false)
                .cell_layout(egui::Layout::left_to_right(Align::Center))
                .animate_scrolling(false);
            builder = builder.column(Column::exact(first).clip(true));
            for (_, width, _) in &COLUMNS[1..] {
                builder = builder.column(Column::exact(*width).clip(true));
            }
            if let Some(row) = scroll {
                builder = builder.scroll_to_row(row, Some(Align::Center));
            }
            let header = builder.header(height, |mut header| {
                for (title, _, about) in COLUMNS {
                    header.col(|ui| {
                        ui.strong(title).on_hover_text(about);
                    });
                }
            });
            header.body(|body| {
                body.rows(height, trade.outcomes.len(), |mut row| {
                    let place = row.index();
                    let outcome = &trade.outcomes[place];
                    row.set_selected(chosen == Some(place));
                    let words = outcome.choice.words();
                    for (column, text) in
                        cells(trade, outcome, front[place]).into_iter().enumerate()
                    {
                        let (_, cell) = row.col(|ui| {
                            let label = egui::Label::new(text).selectable(false);
                            // A label that is cut off would take the hovering from its row.
                            ui.add(label.truncate().sense(Sense::hover()));
                        });
                        // The first cell stands for the row: the others may be out of sight.
                        if column == 0 {
                            cell.widget_info(|| {
                                let (name, is_chosen) =
                                    (format!("Load {words}"), chosen == Some(place));
                                egui::WidgetInfo::selected(
                                    egui::Role::Button,
                                    true,
                                    is_chosen,
                                    name,
                                )
                            });
                        }
                    }
                    let response = row.response();
                    if response
                        .on_hover_text(format!("{words}\nClick to load these settings."))
                        .clicked()
                    {
                        clicked = Some(place);
                    }
                });
            });
        });
    clicked
}

/// The width of the longest choice, as far as it leaves half of the room to the figures.
fn name_width(ui: &egui::Ui, trade: &AccuracyStudy) -> f32 {
    let font = named(HINT).resolve(ui.style());
    let color = ui.visuals().text_color();
    let widths = trade.outcomes.iter().map(|outcome| {
        let words = outcome.choice.words();
        let font = font.clone();
        ui.ctx()
            .fonts_mut(|fonts| fonts.layout_no_wrap(words, font, color).size().x)
    });
    let longest = widths.fold(0.0, f32::max).ceil();
    longest.min(0.5 * ui.available_width()).max(COLUMNS[0].1)
}

fn cells(trade: &AccuracyStudy, outcome: &Outcome, front: bool) -> [String; 11] {
    let [least, median, most] = trade.ratios(outcome);
    let error = &outcome.error;
    [
        outcome.choice.words(),
        if front { "front" } else { "" }.to_owned(),
        format!("{median:.3}"),
        Digits::Three.percent(outcome.wrong_hits),
        significant(error.rmse),
        significant(error.max),
        error
            .psnr
            .map_or("∞".to_owned(), |psnr| format!("{psnr:.1} dB")),
        format!("{:.5}", error.ssim),
        significant(error.flip),
        format!("{least:.3}–{most:.3}"),
        Digits::Four.bytes(outcome.object_bytes as f64),
    ]
}
