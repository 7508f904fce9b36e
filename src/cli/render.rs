//! `bspscope render`: writes the picture to a file.

use super::args::RenderArgs;
use super::outcome::Outcome;
use super::{heat, output, picture, resolve};
use crate::present::export;
use anyhow::{Result, bail};
use image::ImageFormat;
use std::path::Path;

pub fn run(args: &RenderArgs) -> Result<Outcome> {
    let format = format_of(&args.output)?;
    heat::check(&args.heat, format)?;
    output::check_place(Some(&args.output))?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = resolve::scene_in_view(&setup)?;
    resolve::warn_of_precision(&scene, &setup.render);
    let tree = resolve::tree(&scene, &setup)?;
    let render = setup.render;
    let bytes = match args.heat.show {
        Some(shown) => heat::encoded(&scene, &tree, &render, shown.0, &args.heat, format)?,
        None => export::encoded(&picture::render(&scene, &tree, &render)?, format)?,
    };
    output::write_file(&args.output, |out| out.write_all(&bytes))?;
    Ok(Outcome::Done)
}

/// Returns the format of a picture file, by its extension.
fn format_of(path: &Path) -> Result<ImageFormat> {
    match path
        .extension()
        .map(|e| e.to_ascii_lowercase())
        .as_deref()
        .and_then(|e| e.to_str())
    {
        Some("png") => Ok(ImageFormat::Png),
        Some("exr") => Ok(ImageFormat::OpenExr),
        _ => bail!("{}: expected the extension .png or .exr", path.display()),
    }
}
