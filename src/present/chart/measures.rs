//! Draws how well each measure predicts the times in a scene, as SVG: R² with its interval, one panel per set of rays,
//! one color per kernel.

use super::sweep::{COLORS, ChartError, FONT, drawing, register};
use crate::measure::study::{Judged, Outcome, Predictor, RayOrigin};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width of a panel, and of the names at its left, in pixels.
const WIDTH: i32 = 480;
const NAMES: i32 = 112;

/// Height of the legend, of a panel's title, of a measure's row and of the axis, in pixels.
const LEGEND: i32 = 34;
const TITLE: i32 = 28;
const ROW: i32 = 21;
const AXIS: i32 = 32;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Returns the figure of a scene as an SVG file.
///
/// # Errors
/// There is nothing to draw, or the drawing library fails.
pub fn measures_svg(outcome: &Outcome) -> Result<String, ChartError> {
    let has = |origin: &RayOrigin| outcome.judged.iter().any(|j| j.origin == *origin);
    let origins: Vec<_> = RayOrigin::ALL.into_iter().filter(has).collect();
    if origins.is_empty() {
        return Err(ChartError::Nothing("R²"));
    }
    let height = TITLE + ROW * Predictor::ALL.len() as i32 + AXIS;
    let rows = origins.len().div_ceil(2) as i32;
    let size = (2 * WIDTH as u32, (LEGEND + rows * height) as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        register()?;
        area.fill(&WHITE).map_err(drawing)?;
        legend(outcome, &area)?;
        for (i, origin) in origins.iter().enumerate() {
            let corner = (i as i32 % 2 * WIDTH, LEGEND + i as i32 / 2 * height);
            let of_panel: Vec<_> = outcome
                .judged
                .iter()
                .filter(|j| j.origin == *origin)
                .collect();
            panel(&of_panel, &area, corner)?;
        }
        area.present().map_err(drawing)?;
    }
    Ok(text)
}

fn color(place: usize) -> RGBColor {
    COLORS[place % COLORS.len()]
}

/// Writes a text at a place, aligned there as `h` says, and vertically in the middle.
fn write(
    area: &Area<'_>,
    text: &str,
    at: (i32, i32),
    size: i32,
    h: HPos,
) -> Result<(), ChartError> {
    let style = (FONT, size)
        .into_font()
        .color(&BLACK)
        .pos(Pos::new(h, VPos::Center));
    area.draw(&Text::new(text.to_owned(), at, style))
        .map_err(drawing)
}

fn line(area: &Area<'_>, ends: [(i32, i32); 2], style: ShapeStyle) -> Result<(), ChartError> {
    area.draw(&PathElement::new(ends, style)).map_err(drawing)
}

fn legend(outcome: &Outcome, area: &Area<'_>) -> Result<(), ChartError> {
    let y = LEGEND / 2;
    let title = format!("{}: R² of each measure", outcome.scene);
    write(area, &title, (14, y), 19, HPos::Left)?;
    for (place, kernel) in outcome.kernels.iter().enumerate() {
        let x = WIDTH + 100 * place as i32;
        let mark = Circle::new((x, y), 4, color(place).filled());
        area.draw(&mark).map_err(drawing)?;
        write(area, kernel.name(), (x + 10, y), 15, HPos::Left)?;
    }
    Ok(())
}

/// Draws the panel of a set of rays, judged with each kernel.
fn panel(judged: &[&Judged], area: &Area<'_>, corner: (i32, i32)) -> Result<(), ChartError> {
    let (left, right) = (corner.0 + NAMES + 8, corner.0 + WIDTH - 20);
    let top = corner.1 + TITLE;
    let bottom = top + ROW * Predictor::ALL.len() as i32;
    let x = |share: f64| left + (share * f64::from(right - left)).round() as i32;
    if let Some(first) = judged.first() {
        let title = format!("{} rays", first.origin.name());
        write(area, &title, (left, corner.1 + TITLE / 2), 16, HPos::Left)?;
    }
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let ends = [(x(share), top), (x(share), bottom)];
        line(area, ends, BLACK.mix(0.2).stroke_width(1))?;
        write(
            area,
            &share.to_string(),
            (x(share), bottom + 12),
            13,
            HPos::Center,
        )?;
    }
    for (row, predictor) in Predictor::ALL.into_iter().enumerate() {
        let middle = top + ROW * row as i32 + ROW / 2;
        write(area, predictor.name(), (left - 8, middle), 14, HPos::Right)?;
        let center = judged.len() as i32 / 2;
        for (place, judged) in judged.iter().enumerate() {
            let Some(score) = judged.score(predictor) else {
                continue;
            };
            let y = middle + 5 * (place as i32 - center);
            let found = score.r_squared;
            line(
                area,
                [(x(found.low), y), (x(found.high), y)],
                color(place).stroke_width(2),
            )?;
            let mark = Circle::new((x(found.value), y), 3, color(place).filled());
            area.draw(&mark).map_err(drawing)?;
        }
    }
    Ok(())
}
