//! `bspscope generate`: a scene as a file.

use super::args::GenerateArgs;
use super::{Outcome, output, resolve};
use crate::scene::format;
use anyhow::Result;
use std::path::Path;

pub fn run(args: &GenerateArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let (_, scene) = resolve::scene(&args.scene.scene, &args.scene.cylinders)?;
    let format = format::for_path(args.output.as_deref().unwrap_or(Path::new("-")));
    output::write_to(args.output.as_deref(), |out| {
        (format.write)(scene.parts(), out)
    })?;
    Ok(Outcome::Done)
}
