//! A parameter against the depth, one curve per method and leaf size.

use super::shown::{Shown, in_words};
use crate::gui::widgets::linear_axis::Marks;
use crate::gui::widgets::log_axis;
use crate::present::chart::{Curve, curves, is_wide};
use egui::{Color32, Rect, Sense, vec2};
use egui_plot::{
    AxisHints, GridInput, GridMark, Line, LineStyle, MarkerShape, Plot, PlotPoint, Points, Text,
    VLine,
};

/// Colors that color-blind people can tell apart on light and dark, one per method; marks tell curves
/// apart, too.
const COLORS: [Color32; 6] = [
    Color32::from_rgb(20, 130, 200),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
];

/// Marks of the leaf sizes of a method.
const MARKS: [MarkerShape; 6] = [
    MarkerShape::Square,
    MarkerShape::Up,
    MarkerShape::Diamond,
    MarkerShape::Circle,
    MarkerShape::Down,
    MarkerShape::Cross,
];

fn color(curve: &Curve) -> Color32 {
    COLORS[curve.method % COLORS.len()]
}

/// Methods differ by their lines, too.
fn style(curve: &Curve) -> LineStyle {
    match curve.method % 3 {
        0 => LineStyle::Solid,
        1 => LineStyle::dashed_dense(),
        _ => LineStyle::dotted_dense(),
    }
}

/// Shows the plot; returns the row whose point is clicked.
pub fn show(ui: &mut egui::Ui, shown: &Shown<'_>) -> Option<usize> {
    let parameter = shown.parameter;
    let curves = curves(shown.rows, parameter);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for curve in &curves {
            sign(ui, curve);
            ui.label(egui::RichText::new(in_words(&curve.name)).small());
        }
        ui.label(egui::RichText::new("ring: least of a method").small());
    });
    let values = || curves.iter().flat_map(|c| &c.points).map(|p| p.value);
    let (least, most) = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), value| {
        (lo.min(value), hi.max(value))
    });
    if least > most {
        ui.weak(format!("No point has a value of {}.", parameter.symbol));
        return None;
    }
    let logarithmic = is_wide(least, most);
    let up = move |value: f64| if logarithmic { value.log10() } else { value };
    let places: Vec<(usize, PlotPoint)> = curves
        .iter()
        .flat_map(|curve| &curve.points)
        .map(|p| (p.row, PlotPoint::new(p.depth, up(p.value))))
        .collect();
    let title = format!("{}{}", parameter.symbol, parameter.unit.suffix());
    let mut axis = AxisHints::new_y().label(title).label_spacing(14.0..=24.0);
    if logarithmic {
        axis = axis.formatter(|mark, _| log_axis::number(mark.value));
    }
    // Depths have two digits at most: numbers need less room than is usual.
    let depth_axis = AxisHints::new_x().label("depth");
    let depth_axis = depth_axis.label_spacing(16.0..=24.0);
    let ink = ui.visuals().text_color();
    let rule = shown.rule().map(f64::from);
    let mut plot = Plot::new(("sweep", parameter.symbol))
        .width(ui.available_width())
        .height(ui.available_height())
        .allow_scroll(false)
        .show_x(false)
        .show_y(false)
        .y_axis_min_width(52.0)
        .set_margin_fraction(vec2(0.05, 0.1))
        .label_formatter(|_| None)
        .x_grid_spacer(depths)
        .custom_x_axes(vec![depth_axis])
        .custom_y_axes(vec![axis]);
    plot = if logarithmic {
        plot.y_grid_spacer(log_axis::marks)
    } else {
        // A number for every 32 points of the height.
        let most = ui.available_height() / 32.0;
        plot.y_grid_spacer(move |input| Marks::new(input.bounds.into(), most).all())
    };
    let drawn = plot.show(ui, |plot| {
        if let Some(depth) = rule {
            plot.vline(VLine::new("rule", depth).color(ink).width(1.0));
            let text = egui::RichText::new(format!("1.2 log2 N + 2 = {depth}")).small();
            let at = PlotPoint::new(depth, up(most));
            plot.text(
                Text::new("rule", at, text)
                    .anchor(egui::Align2::LEFT_TOP)
                    .color(ink),
            );
        }
        for curve in &curves {
            let points: Vec<[f64; 2]> = curve
                .points
                .iter()
                .map(|p| [p.depth, up(p.value)])
                .collect();
            let line = Line::new(curve.name.clone(), points.clone()).style(style(curve));
            plot.line(line.color(color(curve)).width(1.5));
            let shape = MARKS[curve.mark % MARKS.len()];
            let marks = Points::new(curve.name.clone(), points)
                .shape(shape)
                .filled(true);
            plot.points(marks.color(color(curve)).radius(3.5));
        }
        let of = |wanted: &dyn Fn(usize) -> bool| -> Vec<[f64; 2]> {
            let wanted = places.iter().filter(|(row, _)| wanted(*row));
            wanted.map(|(_, at)| [at.x, at.y]).collect()
        };
        let best = of(&|row| shown.is_best(&shown.rows[row]));
        plot.points(
            Points::new("least", best)
                .filled(false)
                .color(ink)
                .radius(8.0),
        );
        let chosen = of(&|row| shown.chosen == Some(row));
        let chosen = Points::new("loaded", chosen).shape(MarkerShape::Square);
        plot.points(chosen.filled(false).color(ink).radius(11.0));
    });
    let name = format!(
        "Plot of {} against depth, {} points",
        parameter.symbol,
        places.len()
    );
    drawn
        .response
        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, &name));
    let places: Vec<(usize, egui::Pos2)> = places
        .iter()
        .map(|(row, at)| (*row, drawn.transform.position_from_point(at)))
        .filter(|(_, at)| drawn.transform.frame().contains(*at))
        .collect();
    let mut clicked = None;
    for &(row, at) in &places {
        let rect = Rect::from_center_size(at, vec2(11.0, 11.0));
        let point = ui.interact(rect, drawn.response.id.with(row), Sense::click());
        let name = format!("Load {}", shown.words(&shown.rows[row]));
        point.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        // Where points crowd, the nearest is meant, not the one on top.
        let pointer = point.interact_pointer_pos().or(point.hover_pos());
        let meant = pointer.map_or(row, |pointer| nearest(&places, pointer).unwrap_or(row));
        if point.clicked() {
            clicked = Some(meant);
        }
        let words = shown.words(&shown.rows[meant]);
        point.on_hover_text(format!("{words}\nClick to load these settings."));
    }
    clicked
}

/// A curve's mark, for the legend.
fn sign(ui: &mut egui::Ui, curve: &Curve) {
    const SIDES: [&[(f32, f32)]; 6] = [
        &[(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
        &[(0.0, -1.0), (1.0, 1.0), (-1.0, 1.0)],
        &[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)],
        &[],
        &[(0.0, 1.0), (1.0, -1.0), (-1.0, -1.0)],
        &[
            (-1.0, -1.0),
            (1.0, 1.0),
            (0.0, 0.0),
            (1.0, -1.0),
            (-1.0, 1.0),
            (0.0, 0.0),
        ],
    ];
    let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
    let (middle, color) = (rect.center(), color(curve));
    let corners: Vec<egui::Pos2> = (SIDES[curve.mark % SIDES.len()].iter())
        .map(|&(x, y)| middle + 4.0 * vec2(x, y))
        .collect();
    if corners.is_empty() {
        ui.painter().circle_filled(middle, 4.0, color);
    } else {
        let edge = egui::Stroke::new(1.5, color);
        ui.painter()
            .add(egui::Shape::convex_polygon(corners, color, edge));
    }
}

/// The row whose place is nearest.
fn nearest(places: &[(usize, egui::Pos2)], to: egui::Pos2) -> Option<usize> {
    let nearest = places
        .iter()
        .min_by(|a, b| a.1.distance_sq(to).total_cmp(&b.1.distance_sq(to)));
    nearest.map(|(row, _)| *row)
}

/// Depths are whole numbers.
fn depths(input: GridInput) -> Vec<GridMark> {
    let (lo, hi) = input.bounds;
    let every = ((hi - lo) / 14.0).ceil().max(1.0);
    let first = (lo / every).ceil();
    (0..40)
        .map(|i| (first + f64::from(i)) * every)
        .take_while(|&value| value <= hi)
        .map(|value| GridMark {
            value,
            step_size: every,
        })
        .collect()
}
