//! `bspscope probe`: prints everything that the rays of one pixel did.

use super::args::{ListFormat, ProbeArgs};
use super::outcome::Outcome;
use super::{output, resolve};
use crate::present::report::pixel::{PixelReport, write_json, write_text};
use crate::trace::record_pixel;
use anyhow::{Result, bail};

pub fn run(args: &ProbeArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let setups = args.settings.setups(&args.scene)?;
    let scene = resolve::scene_in_view(&setups[0])?;
    let render = &setups[0].render;
    let pixel = pixel_of(args.pixel, [render.width, render.height])?;
    let mut records = Vec::new();
    for setup in &setups {
        let tree = resolve::tree(&scene, setup)?;
        let record = record_pixel(&scene, &tree, render, pixel)?;
        records.push((setup.build.method, record));
    }
    let report = PixelReport {
        scene: &scene,
        render: *render,
        records,
    };
    output::write_to(args.output.as_deref(), |out| match args.format {
        ListFormat::Text => write_text(&report, out),
        ListFormat::Json => write_json(&report, out),
    })?;
    Ok(Outcome::Done)
}

/// Returns the pixel, if it is inside the picture.
fn pixel_of([x, y]: [i64; 2], [width, height]: [u32; 2]) -> Result<[u32; 2]> {
    let within = |v: i64, limit: u32| u32::try_from(v).ok().filter(|&v| v < limit);
    match (within(x, width), within(y, height)) {
        (Some(x), Some(y)) => Ok([x, y]),
        _ => bail!(
            "--pixel {x},{y}: a picture of {width} × {height} pixels has columns 0 to {} and rows \
             0 to {}",
            i64::from(width) - 1,
            i64::from(height) - 1
        ),
    }
}
