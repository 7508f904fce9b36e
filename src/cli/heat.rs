//! `bspscope render --show`: a heatmap in a file.

use super::args::{ByColormap, HeatArgs};
use super::{bar, render};
use crate::measure::heat::{
    HeatImage, HeatStatistics, Heatmap, PixelCounts, RayFilter, Source, Whole,
};
use crate::measure::{grouped, parameter, significant};
use crate::overlay::{
    COLORMAPS, Captions, Colormap, HeatPicture, HeatScale, blend, heat_colors, with_legend,
};
use crate::scene::Scene;
use crate::trace::{RenderSettings, counted_pass, pixel_times, thread_pool};
use crate::tree::Tree;
use anyhow::{Result, bail};
use exr::prelude::{SpecificChannels, WritableImage};
use image::ImageFormat;
use std::io::Cursor;
use std::sync::{Mutex, PoisonError};

/// Refuses options that do not go together, before work is done for them.
pub fn check(args: &HeatArgs, format: ImageFormat) -> Result<()> {
    let Some(shown) = args.show else {
        return Ok(());
    };
    let (heatmap, rays) = (shown.0, args.rays);
    if !heatmap.filters().contains(&rays) {
        bail!(
            "--rays {}: {} is not told apart by kinds of rays",
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
            bail!("{option}: an .exr file holds raw values, not colours; write a .png")
        }
        _ => Ok(()),
    }
}

/// The bytes of a heatmap's file: colours with their legend, or raw values for OpenEXR.
pub fn encoded(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    heatmap: &Heatmap,
    args: &HeatArgs,
    format: ImageFormat,
) -> Result<Vec<u8>> {
    let counts = counts(scene, tree, settings, heatmap)?;
    let image = heatmap.image(&counts, args.rays);
    if format == ImageFormat::OpenExr {
        return raw(&image, heatmap.symbol);
    }
    let colors = args.colors.map_or(&COLORMAPS[0], |ByColormap(map)| map);
    let scale = HeatScale::new(
        &image,
        args.scale.unwrap_or_default(),
        args.range.unwrap_or_default(),
        colors,
    );
    let mut pixels = heat_colors(&image, scale.as_ref(), colors);
    if let Some(opacity) = args.blend {
        let below = render::picture(scene, tree, settings)?.to_srgb8();
        pixels = blend(&pixels, &below, opacity);
    }
    let captions = Captions {
        title: format!("{} · {}", heatmap.symbol, heatmap.name),
        subtitle: subtitle(scene, tree, heatmap, args),
        unit: format!(
            "{}, {} scale; above, how many pixels (square root)",
            heatmap.unit,
            args.scale.unwrap_or_default().name()
        ),
        figures: figures(heatmap, &counts, &image, args.rays, colors),
    };
    let picture = HeatPicture {
        image: &image,
        pixels,
        scale,
        colors,
    };
    let mut bytes = Cursor::new(Vec::new());
    with_legend(&picture, &captions).write_to(&mut bytes, format)?;
    Ok(bytes.into_inner())
}

/// Counts, or for a heatmap of times takes, what it shows.
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
                counted_pass(scene, tree, settings, &pool, progress, |part| {
                    all.lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .add(&part);
                })
            })?;
        }
    }
    Ok(counts)
}

/// What is shown of what.
fn subtitle(scene: &Scene, tree: &Tree, heatmap: &Heatmap, args: &HeatArgs) -> String {
    let mut words = format!("{}, {}", scene.name(), tree.settings().method.name);
    if heatmap.filters().len() > 1 {
        words += &format!(", {} rays", args.rays.name());
    }
    if let Some(opacity) = args.blend {
        words += &format!("; {:.0} % over the picture", opacity * 100.0);
    }
    words
}

/// The figures of the whole picture.
fn figures(
    heatmap: &Heatmap,
    counts: &PixelCounts,
    image: &HeatImage,
    rays: RayFilter,
    colors: &Colormap,
) -> String {
    let mut words = Vec::new();
    if let Some(total) = heatmap.total(counts, rays) {
        let parameters = heatmap.parameters(rays);
        words.push(match (parameters, heatmap.whole) {
            ([first, ..], _) => {
                let number = parameter(first).number(total);
                format!("{} {number}", parameters.join(" + "))
            }
            ([], Whole::Sum) => {
                // A sum over pixels is not per pixel any more.
                let unit = heatmap.unit.trim_end_matches(" per pixel");
                format!("total {} {unit}", number(total))
            }
            ([], Whole::Mean | Whole::RatioTo(_)) => {
                format!("whole picture {} {}", number(total), heatmap.unit)
            }
        });
    }
    if let Some(HeatStatistics {
        lowest,
        highest,
        mean,
        pixels,
    }) = image.statistics()
    {
        let [lowest, mean, highest] = [lowest, mean, highest].map(number);
        words.push(format!(
            "a pixel: lowest {lowest}, mean {mean}, highest {highest}"
        ));
        let without = image.values.len() - pixels;
        if without > 0 {
            let color = if colors.diverging { "grey" } else { "white" };
            words.push(format!("no value in {without} pixels, {color}"));
        }
    }
    words.join("; ")
}

/// A whole number in full, any other to four digits.
fn number(value: f64) -> String {
    if value.fract() == 0.0 {
        grouped(value)
    } else {
        significant(value)
    }
}

/// The values as 32-bit floats in one channel of this name; NaN where there is none.
fn raw(image: &HeatImage, channel: &str) -> Result<Vec<u8>> {
    let (width, height) = (image.width as usize, image.height as usize);
    let channels = SpecificChannels::build()
        .with_channel::<f32>(channel)
        .with_pixel_fn(|at| (image.values[at.y() * width + at.x()],));
    let mut bytes = Cursor::new(Vec::new());
    exr::prelude::Image::from_channels((width, height), channels)
        .write()
        .to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}
