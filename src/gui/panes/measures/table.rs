//! The measures as rows, the one that explains most first.

use crate::gui::theme::{HINT, ROW, named, strong, tokens};
use crate::measure::study::{Estimate, Score};
use crate::present::number::Digits;
use crate::present::report::study::estimate;
use egui::{Align, Layout, Rect, Sense, Stroke, pos2, vec2};
use egui_extras::{Column, TableBuilder};

/// The least width of the bars in points.
const BAR: f32 = 90.0;

/// The place of the bar among the columns.
const PLACE_OF_BAR: usize = 3;

/// Titles, widths in points and meanings of the columns; the bar takes what is left.
const COLUMNS: [(&str, f32, &str); 9] = [
    ("#", 24.0, "Rank"),
    (
        "measure",
        150.0,
        "What is known of a structure, or counted of rays in it",
    ),
    (
        "R²",
        128.0,
        "Share of the variance of times that the measure explains, with its 95 % confidence interval; of equation (1), \
         on structures left out of its fit",
    ),
    (
        "",
        BAR,
        "The figure of the ranking from 0 to 1, with a line over its 95 % confidence interval",
    ),
    (
        "rank correlation",
        150.0,
        "Spearman's rank correlation of measure and time, with its 95 % confidence interval",
    ),
    (
        "error",
        70.0,
        "Of predictions for structures left out of the fit: the median of the absolute errors, as a share of the \
         measured time",
    ),
    (
        "worst",
        70.0,
        "The largest error of a prediction for a structure left out of the fit",
    ),
    (
        "bias",
        80.0,
        "The median error of these predictions with its sign: above 0 if they are too high",
    ),
    (
        "structures",
        70.0,
        "Structures to which the measure applies",
    ),
];

/// The figure by which measures are ranked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum By {
    #[default]
    RSquared,
    Rank,
    Error,
}

impl By {
    pub const ALL: [By; 3] = [By::RSquared, By::Rank, By::Error];

    pub const fn name(self) -> &'static str {
        ["R²", "rank correlation", "error"][self as usize]
    }

    /// Returns the scores, the best first.
    pub fn ranking(self, scores: &[Score]) -> Vec<&Score> {
        let mut all: Vec<_> = scores.iter().collect();
        match self {
            By::RSquared => all.sort_by(|a, b| b.r_squared.value.total_cmp(&a.r_squared.value)),
            By::Rank => all.sort_by(|a, b| b.rank.value.abs().total_cmp(&a.rank.value.abs())),
            By::Error => all.sort_by(|a, b| a.left_out.median.total_cmp(&b.left_out.median)),
        }
        all
    }

    /// Returns what the bar shows: the rank correlation if that is ranked by, else R².
    fn estimate(self, score: &Score) -> Estimate {
        match self {
            By::RSquared | By::Error => score.r_squared,
            By::Rank => score.rank,
        }
    }
}

pub fn show(ui: &mut egui::Ui, scores: &[Score], by: By) {
    let ranking = by.ranking(scores);
    let gap = 6.0;
    let fixed: f32 = COLUMNS.iter().map(|(_, width, _)| width + gap).sum();
    // The scroll bar needs its room, too.
    let rest = (ui.available_width() - 14.0 - fixed).max(0.0);
    egui::ScrollArea::horizontal()
        .id_salt("measures")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.x = gap;
            ui.style_mut().override_text_style = Some(named(HINT));
            ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
            let mut builder = TableBuilder::new(ui)
                .striped(true)
                .auto_shrink(false)
                .cell_layout(Layout::left_to_right(Align::Center));
            for (place, (_, width, _)) in COLUMNS.iter().enumerate() {
                let more = if place == PLACE_OF_BAR { rest } else { 0.0 };
                builder = builder.column(Column::exact(width + more));
            }
            let header = builder.header(ROW, |mut header| {
                for (place, (title, _, about)) in COLUMNS.into_iter().enumerate() {
                    header.col(|ui| {
                        ui.with_layout(alignment(place), |ui| {
                            ui.label(strong(title)).on_hover_text(about);
                        });
                    });
                }
            });
            header.body(|body| {
                body.rows(ROW, ranking.len(), |mut row| {
                    let place = row.index();
                    let score = ranking[place];
                    for (column, text) in cells(place, score).into_iter().enumerate() {
                        row.col(|ui| {
                            if column == PLACE_OF_BAR {
                                bar(ui, score, by);
                            } else {
                                ui.with_layout(alignment(column), |ui| {
                                    let label = egui::Label::new(text).selectable(false);
                                    ui.add(label).on_hover_text(score.predictor.about());
                                });
                            }
                        });
                    }
                });
            });
        });
}

/// How a column is aligned: numbers to the right.
fn alignment(place: usize) -> Layout {
    if place < 5 {
        Layout::left_to_right(Align::Center)
    } else {
        Layout::right_to_left(Align::Center)
    }
}

/// The texts of a row; none in the place of the bar.
fn cells(place: usize, score: &Score) -> [String; 9] {
    let out = &score.left_out;
    let alpha = score.alpha.map(|alpha| format!(" (α {alpha:.2})"));
    [
        (place + 1).to_string(),
        score.predictor.name().to_owned() + &alpha.unwrap_or_default(),
        estimate(&score.r_squared),
        String::new(),
        estimate(&score.rank),
        Digits::Three.percent(out.median),
        Digits::Three.percent(out.worst),
        Digits::Three.signed_percent(out.bias),
        score.count.to_string(),
    ]
}

/// The figure of the ranking, with a line over its interval.
fn bar(ui: &mut egui::Ui, score: &Score, by: By) {
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), ROW - 8.0), Sense::hover());
    let figure = by.estimate(score);
    let text = format!("{}: {}", score.predictor.name(), estimate(&figure));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &text));
    let t = tokens(ui);
    let x = |share: f64| rect.left() + share.abs().min(1.0) as f32 * rect.width();
    let painter = ui.painter().with_clip_rect(rect);
    let filled = Rect::from_min_max(rect.min, pos2(x(figure.value), rect.bottom()));
    painter.rect_filled(
        filled.shrink2(vec2(0.0, 4.0)),
        2.0,
        t.accent.gamma_multiply(0.6),
    );
    let y = rect.center().y;
    let line = Stroke::new(1.5, t.text);
    let [low, high] = [figure.low, figure.high].map(x);
    painter.hline(low.min(high)..=low.max(high), y, line);
    for end in [low, high] {
        painter.vline(end, y - 4.0..=y + 4.0, line);
    }
    response.on_hover_text(text);
}
