//! Error against time, both by the logarithm, with the Pareto front.

use super::words::words;
use crate::gui::widgets::log_axis::{marks, number};
use crate::measure::accuracy::{AccuracyStudy, ErrorMeasure, Outcome};
use crate::present::number::{Digits, significant};
use egui::{Color32, Pos2, Rect, Sense, vec2};
use egui_plot::{AxisHints, GridMark, Line, MarkerShape, Plot, PlotPoint, Points};

const FRONT: Color32 = Color32::from_rgb(20, 150, 220);
const CHOSEN: Color32 = Color32::from_rgb(230, 110, 40);

/// How far below the least error, in decades, no error at all is drawn: it has no logarithm.
const ZERO_BELOW: f64 = 1.0;

/// Shows the plot; returns the outcome that is clicked.
pub fn show(
    ui: &mut egui::Ui,
    trade: &AccuracyStudy,
    measure: &'static ErrorMeasure,
    front: &[bool],
    chosen: Option<usize>,
) -> Option<usize> {
    ui.label(
        egui::RichText::new(
            "filled diamonds: Pareto front · circles: change the picture · crosses: only its time",
        )
        .small(),
    )
    .on_hover_text(
        "On the front, no other choice is both faster and closer to the reference. A square marks the \
         choice loaded last. Click a point to load its settings; Ctrl and the wheel zoom, a double \
         click shows everything again.",
    );
    let zero = zero_place(trade, measure);
    let points: Vec<[f64; 2]> = trade
        .outcomes
        .iter()
        .map(|outcome| {
            let error = (measure.value)(outcome);
            let time = trade.ratios(outcome)[1].max(1e-6).log10();
            [time, if error > 0.0 { error.log10() } else { zero }]
        })
        .collect();
    let size = ui.available_size();
    let (ink, weak) = (ui.visuals().text_color(), ui.visuals().weak_text_color());
    let right = AxisHints::new_x()
        .label("time, as a ratio to the reference's")
        .label_spacing(24.0..=40.0)
        .formatter(|mark, _| number(mark.value));
    let up = AxisHints::new_y()
        .label(measure.name)
        .label_spacing(14.0..=24.0)
        .formatter(move |mark, _| {
            if mark.value <= zero + 0.5 * ZERO_BELOW {
                if mark.value == zero { "0" } else { "" }.to_owned()
            } else {
                number(mark.value)
            }
        });
    let of = |wanted: &dyn Fn(usize) -> bool| -> Vec<[f64; 2]> {
        let chosen = points
            .iter()
            .enumerate()
            .filter(|(place, _)| wanted(*place));
        chosen.map(|(_, point)| *point).collect()
    };
    let moves = |place: usize| {
        let choice = &trade.outcomes[place].choice;
        choice.moves_image || choice.turned.is_empty()
    };
    let mut line = of(&|place| front[place]);
    line.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
    let kinds = [
        (
            "time only",
            of(&|p| !moves(p)),
            MarkerShape::Cross,
            weak,
            3.5,
            false,
        ),
        (
            "changes the picture",
            of(&|p| moves(p) && !front[p]),
            MarkerShape::Circle,
            ink,
            3.5,
            false,
        ),
        (
            "Pareto front",
            line.clone(),
            MarkerShape::Diamond,
            FRONT,
            6.0,
            true,
        ),
        (
            "chosen",
            of(&|p| chosen == Some(p)),
            MarkerShape::Square,
            CHOSEN,
            8.0,
            false,
        ),
    ];
    let shown = Plot::new("trade")
        .width(size.x)
        .height(size.y)
        .allow_scroll(false)
        .show_x(false)
        .show_y(false)
        .y_axis_min_width(44.0)
        .set_margin_fraction(vec2(0.06, 0.08))
        .label_formatter(|_| None)
        .x_grid_spacer(marks)
        .y_grid_spacer(move |input| {
            let mut all = marks(input);
            all.retain(|mark| mark.value > zero + 0.5 * ZERO_BELOW);
            all.push(GridMark {
                value: zero,
                step_size: 1.0,
            });
            all
        })
        .custom_x_axes(vec![right])
        .custom_y_axes(vec![up])
        .show(ui, |plot| {
            plot.line(Line::new("front", line).color(FRONT).width(1.5));
            for (name, points, shape, color, radius, filled) in kinds {
                let points = Points::new(name, points).shape(shape).color(color);
                plot.points(points.radius(radius).filled(filled));
            }
        });
    let name = format!(
        "Plot of {} against time, {} choices",
        measure.name,
        points.len()
    );
    shown
        .response
        .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, &name));
    let places: Vec<Pos2> = points
        .iter()
        .map(|[x, y]| {
            let point = PlotPoint::new(*x, *y);
            shown.transform.position_from_point(&point)
        })
        .collect();
    let mut clicked = None;
    for (place, at) in places.iter().enumerate() {
        if !shown.transform.frame().contains(*at) {
            continue;
        }
        let about = words(trade, &trade.outcomes[place], measure);
        let rect = Rect::from_center_size(*at, vec2(13.0, 13.0));
        let point = ui.interact(rect, shown.response.id.with(place), Sense::click());
        point.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &about));
        // Where points crowd, the nearest is meant, not the one on top.
        let pointer = point.interact_pointer_pos().or(point.hover_pos());
        let meant = pointer.map_or(place, |pointer| nearest(&places, pointer));
        if point.clicked() {
            clicked = Some(meant);
        }
        point.on_hover_ui_at_pointer(|ui| details(ui, trade, &trade.outcomes[meant]));
    }
    clicked
}

/// The nearest of the places, of which there is one at least.
fn nearest(places: &[Pos2], to: Pos2) -> usize {
    let distance = |place: &usize| places[*place].distance_sq(to);
    let nearest = (0..places.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or(0)
}

/// All that is known of an outcome.
fn details(ui: &mut egui::Ui, trade: &AccuracyStudy, outcome: &Outcome) {
    let [least, median, most] = trade.ratios(outcome);
    let error = &outcome.error;
    ui.strong(outcome.choice.words());
    ui.label(format!(
        "{median:.3} of the reference's time ({least:.3} to {most:.3}), {} of CPU time",
        Digits::Four.seconds(outcome.median())
    ));
    let psnr = error
        .psnr
        .map_or("∞".to_owned(), |psnr| format!("{psnr:.1}"));
    ui.label(format!(
        "RMSE {} · max {} · PSNR {psnr} dB · SSIM {:.5} · FLIP {}",
        significant(error.rmse),
        significant(error.max),
        error.ssim,
        significant(error.flip)
    ));
    ui.label(format!(
        "{} of the pixels hit a different object",
        Digits::Four.percent(outcome.wrong_hits)
    ));
    ui.weak("Click to load these settings.");
}

/// Where no error is drawn: a whole number of decades, below the least error that there is.
fn zero_place(trade: &AccuracyStudy, measure: &ErrorMeasure) -> f64 {
    let errors = trade.outcomes.iter().map(measure.value);
    let least = errors.filter(|&error| error > 0.0).reduce(f64::min);
    least.unwrap_or(1e-3).log10().floor() - ZERO_BELOW
}
