//! A parameter over depth and leaf size in colors, one map per method.

use super::shown::Shown;
use crate::gui::widgets::common::short;
use crate::gui::widgets::scale_bar::{NUMBERS, TICK, color_bar, numbers};
use crate::measure::heat::HeatImage;
use crate::measure::sweep::Row;
use crate::measure::{Unit, parameter};
use crate::present::chart::is_wide;
use crate::present::overlay::{Colormap, HeatScale, Range, Scale, colormap};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, StrokeKind, pos2, vec2};

/// Height of a cell in points.
const CELL: f32 = 22.0;
/// Room for leaf sizes at the left.
const LEFT: f32 = 84.0;
/// Height of the color bar in points.
const BAR: f32 = 10.0;
/// A cell of this width in points has room for its number.
const ROOMY: f32 = 40.0;

fn colors() -> &'static Colormap {
    colormap("viridis").expect("it is a map")
}

/// Shows the maps; returns the row whose cell is clicked.
pub fn show(ui: &mut egui::Ui, shown: &Shown<'_>) -> Option<usize> {
    let values = shown.rows.iter().map(|row| value(shown, row));
    let values = values.map(|value| value.map_or(f32::NAN, |value| value as f32));
    let image = HeatImage {
        width: shown.rows.len() as u32,
        height: 1,
        values: values.collect(),
        // Colors by the logarithm are linear below this.
        grain: 0.0,
    };
    let Some(found) = image.statistics() else {
        ui.weak(format!(
            "No point has a value of {}.",
            shown.parameter.symbol
        ));
        return None;
    };
    let scale = if is_wide(found.lowest, found.highest) {
        Scale::Logarithmic
    } else {
        Scale::Linear
    };
    let image = HeatImage {
        grain: found.lowest.max(f64::MIN_POSITIVE),
        ..image
    };
    let scale = HeatScale::new(&image, scale, Range::Automatic, colors())?;
    let mut clicked = None;
    egui::ScrollArea::vertical()
        .id_salt("maps")
        .auto_shrink(false)
        .show(ui, |ui| {
            legend(ui, shown, &scale);
            let mut methods: Vec<&str> = Vec::new();
            for row in shown.rows {
                if !methods.contains(&row.key.method.as_str()) {
                    methods.push(&row.key.method);
                }
            }
            for method in methods {
                clicked = clicked.or(map(ui, shown, &scale, method));
            }
        });
    clicked
}

/// The value of a row as it is shown: shares in per cent.
fn value(shown: &Shown<'_>, row: &Row) -> Option<f64> {
    let factor = if shown.parameter.unit == Unit::Percent {
        100.0
    } else {
        1.0
    };
    Some(row.value(shown.parameter)? * factor)
}

fn depth_of(row: &Row) -> Option<u32> {
    row.value(parameter("D_MAX")).map(|depth| depth as u32)
}

/// The colors with their numbers and what they are.
fn legend(ui: &mut egui::Ui, shown: &Shown<'_>, scale: &HeatScale) {
    let p = shown.parameter;
    let mut text = format!(
        "{}{}, {} · diamond: least of the method · framed: loaded",
        p.symbol,
        p.unit.suffix(),
        p.name
    );
    let is_swept = |depth: &u32| shown.rows.iter().any(|row| depth_of(row) == Some(*depth));
    if let Some(rule) = shown.rule().filter(is_swept) {
        text += &format!(" · [{rule}]: the rule 1.2 log2 N + 2");
    }
    ui.add(egui::Label::new(egui::RichText::new(text).small()).wrap());
    let size = vec2(ui.available_width(), BAR + TICK + NUMBERS);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let name = format!("Legend from {} to {}", short(scale.lo), short(scale.hi));
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, &name));
    let bar = Rect::from_min_size(rect.min, vec2(rect.width(), BAR));
    let painter = ui.painter().with_clip_rect(rect);
    color_bar(&painter, colors(), bar);
    let ink = ui.visuals().text_color();
    numbers(&painter, scale, [0, 0], bar, rect, ink);
}

/// Shows one method's map; returns the row whose cell is clicked.
fn map(ui: &mut egui::Ui, shown: &Shown<'_>, scale: &HeatScale, method: &str) -> Option<usize> {
    let mine = || {
        let rows = shown.rows.iter().enumerate();
        rows.filter(|(_, row)| row.key.method == method)
    };
    let mut depths: Vec<u32> = mine().filter_map(|(_, row)| depth_of(row)).collect();
    let mut sizes: Vec<u32> = mine().map(|(_, row)| row.key.n_oilf).collect();
    for list in [&mut depths, &mut sizes] {
        list.sort_unstable();
        list.dedup();
    }
    ui.strong(method);
    let width = ((ui.available_width() - LEFT) / depths.len().max(1) as f32).min(64.0);
    let size = vec2(
        LEFT + width * depths.len() as f32,
        CELL * (sizes.len() + 1) as f32,
    );
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let painter = ui.painter().with_clip_rect(rect.expand(1.0));
    let (ink, font) = (ui.visuals().text_color(), FontId::proportional(12.0));
    let cell = |column: usize, line: usize| {
        let at = pos2(
            rect.left() + LEFT + column as f32 * width,
            rect.top() + (line + 1) as f32 * CELL,
        );
        Rect::from_min_size(at, vec2(width, CELL))
    };
    let rule = shown.rule();
    for (column, depth) in depths.iter().enumerate() {
        let at = cell(column, 0).center() - vec2(0.0, CELL);
        if Some(*depth) == rule {
            let text = format!("[{depth}]");
            painter.text(at, Align2::CENTER_CENTER, text, font.clone(), ink);
        } else if width >= 16.0 || column % 2 == 0 {
            painter.text(at, Align2::CENTER_CENTER, depth, font.clone(), ink);
        }
    }
    let corner = rect.left_top() + vec2(2.0, CELL / 2.0);
    painter.text(corner, Align2::LEFT_CENTER, "depth", font.clone(), ink);
    for (line, size) in sizes.iter().enumerate() {
        let at = pos2(rect.left() + 2.0, cell(0, line).center().y);
        let text = format!("leaf size {size}");
        painter.text(at, Align2::LEFT_CENTER, text, font.clone(), ink);
    }
    let mut clicked = None;
    for (place, row) in mine() {
        let column = depth_of(row).and_then(|depth| depths.binary_search(&depth).ok());
        let (Some(column), Ok(line)) = (column, sizes.binary_search(&row.key.n_oilf)) else {
            continue;
        };
        let square = cell(column, line).shrink(0.5);
        let part = value(shown, row).and_then(|value| scale.place(value));
        let [r, g, b] = part.map_or(colors().no_value(), |part| colors().color(part));
        painter.rect_filled(square, 0.0, Color32::from_rgb(r, g, b));
        // Viridis is dark at its lower end.
        let dark = part.is_none_or(|part| part < 0.6);
        let over = if dark { Color32::WHITE } else { Color32::BLACK };
        if shown.is_best(row) {
            diamond(&painter, square, over);
        } else if let Some(value) = value(shown, row).filter(|_| width >= ROOMY) {
            let font = FontId::proportional(12.0);
            painter.text(
                square.center(),
                Align2::CENTER_CENTER,
                short(value),
                font,
                over,
            );
        }
        if shown.chosen == Some(place) {
            painter.rect_stroke(square, 0.0, Stroke::new(2.0, over), StrokeKind::Inside);
        }
        let button = ui.interact(square, response.id.with(place), Sense::click());
        let name = format!("Load {}", shown.words(row));
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if button.clicked() {
            clicked = Some(place);
        }
        button.on_hover_text(format!(
            "{}\nClick to load these settings.",
            shown.words(row)
        ));
    }
    clicked
}

/// The mark of the best cell.
fn diamond(painter: &egui::Painter, square: Rect, color: Color32) {
    let (middle, arm) = (square.center(), 0.36 * square.width().min(square.height()));
    let corners = [
        vec2(0.0, -arm),
        vec2(arm, 0.0),
        vec2(0.0, arm),
        vec2(-arm, 0.0),
    ];
    let corners = corners.map(|corner| middle + corner).to_vec();
    painter.add(egui::Shape::closed_line(corners, Stroke::new(2.0, color)));
}
