//! Draws a parameter of a sweep over the maximum depth, one curve per method and leaf size, as PNG or
//! SVG. The font is part of the program.

use super::curves::{Curve, CurvePoint, curves, is_wide};
use crate::measure::Parameter;
use crate::measure::sweep::{OtherOrigin, Row, check_comparable, rule_depth};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::{FontStyle, register_font};
use std::io::Cursor;
use std::ops::Range;

/// The content of a chart.
#[derive(Clone, Copy)]
pub struct Chart<'a> {
    pub rows: &'a [Row],
    pub parameter: &'static Parameter,
    /// Width and height in pixels.
    pub size: (u32, u32),
}

/// Why a chart cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ChartError {
    #[error("there is no value of {0} to draw")]
    Nothing(&'static str),
    #[error(transparent)]
    OtherOrigin(#[from] OtherOrigin),
    #[error("the chart could not be drawn: {0}")]
    Drawing(String),
}

pub(super) const FONT: &str = "sans-serif";

/// One color per method, distinct for color-blind people (M. Okabe and K. Ito, 2008).
pub(super) const COLORS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
];

/// Returns the chart as a PNG file.
///
/// # Errors
/// There is nothing to draw, rows have times of different processors, or the drawing library fails.
pub fn png(chart: &Chart<'_>) -> Result<Vec<u8>, ChartError> {
    let (width, height) = chart.size;
    let mut pixels = vec![0; width as usize * height as usize * 3];
    {
        let backend = BitMapBackend::with_buffer(&mut pixels, chart.size);
        draw(chart, &backend.into_drawing_area())?;
    }
    let image = image::RgbImage::from_raw(width, height, pixels)
        .ok_or_else(|| ChartError::Drawing("the picture has another size".into()))?;
    let mut bytes = Cursor::new(Vec::new());
    image
        .write_to(&mut bytes, image::ImageFormat::Png)
        .map_err(drawing)?;
    Ok(bytes.into_inner())
}

/// Returns the chart as an SVG file.
///
/// # Errors
/// The same as those of [`png`].
pub fn svg(chart: &Chart<'_>) -> Result<String, ChartError> {
    let mut text = String::new();
    draw(
        chart,
        &SVGBackend::with_string(&mut text, chart.size).into_drawing_area(),
    )?;
    Ok(text)
}

pub(super) fn drawing(error: impl std::fmt::Display) -> ChartError {
    ChartError::Drawing(error.to_string())
}

/// Makes the font known to the drawing library.
pub(super) fn register() -> Result<(), ChartError> {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| ChartError::Drawing("the font of the program is not one".into()))
}

fn draw<B: DrawingBackend>(
    chart: &Chart<'_>,
    area: &DrawingArea<B, Shift>,
) -> Result<(), ChartError> {
    check_comparable(chart.rows, chart.parameter)?;
    register()?;
    let curves = curves(chart.rows, chart.parameter);
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let range = |axis: fn(&CurvePoint) -> f64| {
        let values = || points().map(axis);
        values().fold(f64::INFINITY, f64::min)..values().fold(f64::NEG_INFINITY, f64::max)
    };
    let (depths, values) = (range(|p| p.depth), range(|p| p.value));
    if depths.is_empty() && depths.start != depths.end {
        return Err(ChartError::Nothing(chart.parameter.symbol));
    }
    area.fill(&WHITE).map_err(drawing)?;
    let depths = depths.start - 0.5..depths.end + 0.5;
    if is_wide(values.start, values.end) {
        let wider = values.start / 1.2..values.end * 1.2;
        draw_on(chart, area, &curves, depths, wider.log_scale())
    } else {
        let room = 0.05 * (values.end - values.start).max(1e-3 * values.end.abs().max(1e-9));
        let wider = values.start - room..values.end + room;
        draw_on(chart, area, &curves, depths, wider)
    }
}

/// Draws the whole chart, with a linear or a logarithmic value axis.
fn draw_on<B: DrawingBackend, V>(
    chart: &Chart<'_>,
    area: &DrawingArea<B, Shift>,
    curves: &[Curve],
    depths: Range<f64>,
    values: V,
) -> Result<(), ChartError>
where
    V: AsRangedCoord<Value = f64>,
    V::CoordDescType: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let p = chart.parameter;
    let scene = chart.rows.first().map_or("", |row| &row.key.scene);
    let mut context = ChartBuilder::on(area)
        .caption(format!("{scene}: {} ({})", p.symbol, p.name), (FONT, 22))
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(76)
        .build_cartesian_2d(depths.clone(), values)
        .map_err(drawing)?;
    context
        .configure_mesh()
        .x_desc("D_MAX, maximum depth")
        .y_desc(format!("{}{}", p.symbol, p.unit.suffix()))
        .x_label_formatter(&|depth| format!("{depth:.0}"))
        .label_style((FONT, 15))
        .axis_desc_style((FONT, 16))
        .light_line_style(WHITE)
        .draw()
        .map_err(drawing)?;
    for curve in curves {
        add_curve(&mut context, curve)?;
    }
    let rule = chart.rows.first().and_then(rule_depth).map(f64::from);
    if let Some(depth) = rule.filter(|depth| depths.contains(depth)) {
        let ends = context.y_range();
        let style = BLACK.mix(0.6).stroke_width(1);
        context
            .draw_series(LineSeries::new(
                [(depth, ends.start), (depth, ends.end)],
                style,
            ))
            .map_err(drawing)?
            .label(format!("1.2 · log2 N + 2 = {depth}"))
            .legend(move |(x, y)| PathElement::new([(x + 9, y - 6), (x + 9, y + 6)], style));
    }
    context
        .configure_series_labels()
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .label_font((FONT, 15))
        .position(SeriesLabelPosition::UpperRight)
        .draw()
        .map_err(drawing)?;
    area.present().map_err(drawing)
}

type Context<'a, B, Y> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, Y>>;

/// Draws a line with a mark at every point, and its entry in the legend.
fn add_curve<'a, B: DrawingBackend + 'a, Y: Ranged<ValueType = f64>>(
    context: &mut Context<'a, B, Y>,
    curve: &Curve,
) -> Result<(), ChartError> {
    let (color, mark) = (COLORS[curve.method % COLORS.len()], curve.mark);
    let points = || curve.points.iter().map(|point| (point.depth, point.value));
    context
        .draw_series(LineSeries::new(points(), color.stroke_width(2)))
        .map_err(drawing)?
        .label(curve.name.clone())
        .legend(move |(x, y)| {
            EmptyElement::at((x, y))
                + PathElement::new([(0, 0), (18, 0)], color.stroke_width(2))
                + PathElement::new(outline(mark, 9), color.stroke_width(1))
        });
    context
        .draw_series(points().map(|at| {
            EmptyElement::at(at) + PathElement::new(outline(mark, 0), color.stroke_width(1))
        }))
        .map_err(drawing)?;
    Ok(())
}

/// Returns the outline of a mark relative to its center, in pixels, shifted to the right: a square,
/// a triangle, a diamond, a cross and so on.
fn outline(mark: usize, right: i32) -> Vec<(i32, i32)> {
    let shape: &[(i32, i32)] = match mark % 5 {
        0 => &[(-3, -3), (3, -3), (3, 3), (-3, 3), (-3, -3)],
        1 => &[(0, -4), (4, 3), (-4, 3), (0, -4)],
        2 => &[(0, -4), (4, 0), (0, 4), (-4, 0), (0, -4)],
        3 => &[(-3, -3), (3, 3), (0, 0), (-3, 3), (3, -3)],
        _ => &[(0, 4), (4, -3), (-4, -3), (0, 4)],
    };
    shape.iter().map(|&(x, y)| (x + right, y)).collect()
}
