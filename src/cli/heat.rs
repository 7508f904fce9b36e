//! `bspscope render --show`: writes a heatmap to a file.

use super::args::HeatArgs;
use super::values::ByColormap;
use super::{bar, picture};
use crate::measure::heat::{Heatmap, PixelCounts, Source};
use crate::present::export::HeatSheet;
use crate::present::overlay::COLORMAPS;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderSettings, pixel_times, render_counted, thread_pool};
use anyhow::{Result, bail};
use image::ImageFormat;
use std::sync::{Mutex, PoisonError};

/// Rejects incompatible options before work is done for them.
pub fn check(args: &HeatArgs, format: ImageFormat) -> Result<()> {
    let Some(shown) = args.show else {
        return Ok(());
    };
    let (heatmap, rays) = (shown.0, args.rays);
    if !heatmap.filters().contains(&rays) {
        bail!(
            "--rays {}: {} is not counted per kind of ray",
            rays.name(),
            heatmap.symbol
        );
    }
    let looks = [
        ("--scale", args.scale.is_some()),
        ("--range", args.range.is_some()),
        ("--colors", args.colors.is_some()),
        ("--blend", args.blend.is_some()),
    ];
    match looks.into_iter().find(|(_, given)| *given) {
        Some((option, _)) if format == ImageFormat::OpenExr => {
            bail!("{option}: an .exr file contains raw values, not colors; write a .png instead")
        }
        _ => Ok(()),
    }
}

/// Returns the bytes of the file: colors with a legend, or raw values for OpenEXR.
pub fn encoded(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    heatmap: &Heatmap,
    args: &HeatArgs,
    format: ImageFormat,
) -> Result<Vec<u8>> {
    let counts = counts(scene, tree, settings, heatmap)?;
    let below = match args.blend {
        Some(opacity) if format != ImageFormat::OpenExr => {
            Some((picture::render(scene, tree, settings)?, opacity))
        }
        _ => None,
    };
    let sheet = HeatSheet {
        heatmap,
        image: &heatmap.image(&counts, args.rays),
        total: heatmap.total(&counts, args.rays),
        difference: false,
        rays: args.rays,
        scale: args.scale.unwrap_or_default(),
        range: args.range.unwrap_or_default(),
        colors: args.colors.map_or(&COLORMAPS[0], |ByColormap(map)| map),
        below: below.as_ref().map(|(picture, opacity)| (picture, *opacity)),
        of: format!("{}, {}", scene.name(), tree.settings().method.name),
    };
    Ok(if format == ImageFormat::OpenExr {
        sheet.exr()?
    } else {
        sheet.png()?
    })
}

/// Counts the values of a heatmap, or measures them for a heatmap of times.
fn counts(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    heatmap: &Heatmap,
) -> Result<PixelCounts> {
    let pool = thread_pool(settings.threads)?;
    let mut counts = PixelCounts::new(settings.width, settings.height);
    match heatmap.source {
        Source::Time => {
            let stage = format!("{}: timing every pixel", scene.name());
            counts.seconds = Some(bar::with_bar(&stage, |progress| {
                pixel_times(scene, tree, settings, &pool, progress)
            })?);
        }
        Source::Rays(_) | Source::DepthComplexity => {
            let stage = format!("{}: counting", scene.name());
            let all = Mutex::new(&mut counts);
            bar::with_bar(&stage, |progress| {
                render_counted(scene, tree, settings, &pool, progress, |part| {
                    all.lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .add(&part);
                })
            })?;
        }
    }
    Ok(counts)
}
