//! The ranking as a table with a bar for every time.

use super::sentence;
use super::uses::{copy, use_this};
use crate::gui::document::Document;
use crate::gui::document::tuning::Found;
use crate::gui::edits::Edits;
use crate::gui::icons;
use crate::gui::theme::{HINT, IconButton, ROW, named, strong, tokens};
use crate::measure::tune::{Rank, Row};
use crate::present::number::{Digits, NO_VALUE, grouped};
use egui::{Align, Layout, Rect, Sense, Stroke, pos2, vec2};
use egui_extras::{Column, TableBuilder};

/// The least width of the bars in points.
const BAR: f32 = 70.0;

/// The bars reach up to this multiple of the least time.
const MOST_TIMES: f64 = 4.0;

/// Titles, widths in points and meanings of the columns; the bar takes what is left.
const COLUMNS: [(&str, f32, &str); 10] = [
    (
        "#",
        34.0,
        "Rank; an equals sign marks candidates that share it",
    ),
    ("method", 110.0, "Build method"),
    (
        "settings",
        184.0,
        "Of kd-trees and octrees, the greatest depth of a leaf (D_MAX) and the most objects of a cell that is not \
         split (N_OILF); of others, what differs from the defaults of the method",
    ),
    (
        "time",
        66.0,
        "Median CPU time of the picture (T_TR), or of building once and tracing the rays that were asked for",
    ),
    (
        "",
        BAR,
        "Median time as a bar, with a line from the least to the greatest time",
    ),
    (
        "tests per ray",
        88.0,
        "Intersection tests per ray, over rays of all kinds; a dash for candidates that were timed only once",
    ),
    ("nodes", 74.0, "Nodes of the tree; of a grid, its voxels"),
    ("build time", 74.0, "CPU time of the build, T_CB"),
    ("memory", 74.0, "Memory of nodes and references, M_TREE"),
    (
        "",
        122.0,
        "Use the settings, or copy the command that measures them",
    ),
];

/// The height of a row in points, where the window is as high as [`TALL`].
const TALL_ROW: f32 = 36.0;

/// From this height of the window on, in points, rows are high.
const TALL: f32 = 900.0;

/// The place of the bar among the columns.
const PLACE_OF_BAR: usize = 4;

pub fn show(ui: &mut egui::Ui, doc: &Document, found: &Found, edits: &mut Edits) {
    let ranking = found.ranking();
    let most = scale(found);
    let gap = 6.0;
    let fixed: f32 = COLUMNS.iter().map(|(_, width, _)| width + gap).sum();
    let row = if ui.ctx().content_rect().height() < TALL {
        ROW
    } else {
        TALL_ROW
    };
    // The scroll bar needs its room, too.
    let rest = (ui.available_width() - 14.0 - fixed).max(0.0);
    egui::ScrollArea::horizontal()
        .id_salt("ranking")
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
                body.rows(row, ranking.len(), |mut table_row| {
                    let rank = &ranking[table_row.index()];
                    let row = &found.rows[rank.place];
                    table_row.set_selected(doc.uses(&row.setup));
                    for (place, text) in cells(found, rank, row).into_iter().enumerate() {
                        table_row.col(|ui| {
                            if place == PLACE_OF_BAR {
                                bar(ui, found, row, most);
                            } else {
                                ui.with_layout(alignment(place), |ui| {
                                    ui.add(egui::Label::new(text).selectable(false));
                                });
                            }
                        });
                    }
                    table_row.col(|ui| buttons(ui, doc, row, edits));
                });
            });
        });
}

/// The time that fills the width of the bars. The slowest candidates can be much slower than all that
/// matter: their bars are cut.
fn scale(found: &Found) -> f64 {
    let times = || found.rows.iter().map(|row| found.time(row));
    let greatest = times().map(|time| time.most).fold(0.0, f64::max);
    let best = times()
        .map(|time| time.median)
        .fold(f64::INFINITY, f64::min);
    greatest.min(MOST_TIMES * best)
}

/// How a column is aligned: numbers, so that digits of the same place stand below each other.
fn alignment(place: usize) -> Layout {
    let is_number = place == PLACE_OF_BAR - 1 || (PLACE_OF_BAR + 1..9).contains(&place);
    if is_number {
        Layout::right_to_left(Align::Center)
    } else {
        Layout::left_to_right(Align::Center)
    }
}

/// The texts of a row; none in the place of the bar.
fn cells(found: &Found, rank: &Rank, row: &Row) -> [String; 9] {
    let settings = match sentence::settings(row) {
        none if none.is_empty() => "defaults".to_owned(),
        settings => settings,
    };
    let tests = row.tests_per_ray();
    [
        format!("{}{}", rank.rank, if rank.is_tied { "=" } else { "" }),
        row.setup.build.method.name.to_owned(),
        settings,
        sentence::time(found, row),
        String::new(),
        tests.map_or(NO_VALUE.to_owned(), |tests| Digits::Four.number(tests)),
        grouped(row.nodes() as f64),
        Digits::Three.seconds(row.measurement.building.cpu.as_secs_f64()),
        Digits::Three.bytes(row.bytes() as f64),
    ]
}

/// The median time, with a line over all rounds.
fn bar(ui: &mut egui::Ui, found: &Found, row: &Row, most: f64) {
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), ROW - 8.0), Sense::hover());
    let range = sentence::range(found, row);
    let name = format!("Time of {}: {range}", sentence::name(row));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let t = tokens(ui);
    let x =
        |seconds: f64| rect.left() + (seconds / most.max(f64::MIN_POSITIVE)) as f32 * rect.width();
    let painter = ui.painter().with_clip_rect(rect);
    let spread = found.time(row);
    let bar = Rect::from_min_max(rect.min, pos2(x(spread.median), rect.bottom()));
    painter.rect_filled(
        bar.shrink2(vec2(0.0, 4.0)),
        2.0,
        t.accent.gamma_multiply(0.6),
    );
    let y = rect.center().y;
    let line = Stroke::new(1.5, t.text);
    painter.hline(x(spread.least)..=x(spread.most), y, line);
    for end in [spread.least, spread.most] {
        painter.vline(x(end), y - 4.0..=y + 4.0, line);
    }
    if spread.median > most {
        let end = egui::Align2::RIGHT_CENTER;
        let font = egui::TextStyle::Small.resolve(ui.style());
        painter.text(rect.right_center(), end, "longer → ", font, t.text);
    }
    response.on_hover_text(range);
}

fn buttons(ui: &mut egui::Ui, doc: &Document, row: &Row, edits: &mut Edits) {
    let name = sentence::name(row);
    let is_used = doc.uses(&row.setup);
    let text = if is_used { "In use" } else { "Use this" };
    let button = egui::Button::new(text).min_size(vec2(76.0, ROW));
    let button = ui
        .add_enabled(!is_used, button)
        .on_hover_text(format!("Build the tree on view with {name}."))
        .on_disabled_hover_text("The tree on view has these settings.")
        .accessible_name(format!("{text}: {name}"));
    if button.clicked() {
        use_this(row, edits);
    }
    let about = format!("Copy the command that measures {name}");
    if ui.add(IconButton::new(icons::COPY, &about)).clicked() {
        copy(row, edits);
    }
}
