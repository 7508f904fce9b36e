//! The report as a page: the pictures of each run, and the commands that repeat it.

use super::{HeatSheet, encoded};
use crate::measure::Measurement;
use crate::measure::heat::{PixelCounts, RayFilter, heatmap};
use crate::present::overlay::{COLORMAPS, Range, Scale};
use crate::present::report::{Figure, Machine, Page, Report, now};
use crate::setup::{Setup, measure_command};
use crate::trace::Picture;
use image::{ImageError, ImageFormat};
use std::io::{Error, Result, Write};

/// The symbols of the heatmaps that the page shows for every run.
const HEATMAPS: [&str; 2] = ["N_NODES", "N_IT"];

/// Writes a report as one HTML file. It shows one picture, which is the same for every run, and the
/// heatmaps of every run. `None` in the pixel counts, which are in the order of the runs, leaves
/// out the heatmaps of that run.
///
/// # Errors
/// Those of `out`, and of encoding the pictures.
pub fn write_page(
    report: &Report,
    picture: &Picture,
    counts: &[Option<&PixelCounts>],
    notes: &str,
    out: &mut dyn Write,
) -> Result<()> {
    let mut figures = vec![Figure {
        caption: format!("{}, traced", report.scene.name),
        png: encoded(picture, ImageFormat::Png).map_err(Error::other)?,
    }];
    for (i, (run, counts)) in report.runs.iter().zip(counts).enumerate() {
        let of = match report.runs.len() {
            1 => run.build.method.name.to_owned(),
            _ => format!("{}: {}", i + 1, run.build.method.name),
        };
        if let Some(counts) = counts {
            figures.extend(heatmaps(report, &of, counts).map_err(Error::other)?);
        }
    }
    let page = Page {
        report,
        figures,
        machine: Machine::here(),
        date: now(),
        notes: notes.to_owned(),
        commands: report.runs.iter().map(|run| command(report, run)).collect(),
    };
    page.write(out)
}

fn heatmaps(
    report: &Report,
    of: &str,
    counts: &PixelCounts,
) -> std::result::Result<Vec<Figure>, ImageError> {
    let rays = RayFilter::All;
    let figure = |symbol: &str| {
        let heatmap = heatmap(symbol).expect("a heatmap of the registry");
        let sheet = HeatSheet {
            heatmap,
            image: &heatmap.image(counts, rays),
            total: heatmap.total(counts, rays),
            difference: false,
            rays,
            scale: Scale::default(),
            range: Range::default(),
            colors: &COLORMAPS[0],
            below: None,
            of: format!("{}, {of}", report.scene.name),
        };
        Ok(Figure {
            caption: format!("{of}: {}, {}", heatmap.symbol, heatmap.meaning),
            png: sheet.png()?,
        })
    };
    HEATMAPS.into_iter().map(figure).collect()
}

/// Returns the command that repeats a run.
fn command(report: &Report, run: &Measurement) -> String {
    measure_command(&Setup {
        scene: report.scene.request.clone(),
        build: run.build.clone(),
        render: run.render,
    })
}
