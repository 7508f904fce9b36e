//! `bspscope generate`: writes a scene to a file.

use super::args::GenerateArgs;
use super::outcome::Outcome;
use super::{output, resolve};
use crate::scene::format;
use anyhow::{Result, bail};
use std::path::Path;

pub fn run(args: &GenerateArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let write = writer(args.output.as_deref())?;
    let scene = resolve::scene(&args.settings.setup(&args.scene)?.scene)?;
    output::write_to(args.output.as_deref(), |out| write(scene.parts(), out))?;
    Ok(Outcome::Done)
}

/// Returns the writer for the extension of a file; NFF if the extension is unknown.
fn writer(file: Option<&Path>) -> Result<format::WriteScene> {
    match file.and_then(format::for_path) {
        None => Ok(format::nff::write),
        Some(format) => match format.write {
            Some(write) => Ok(write),
            None => bail!(
                "{} files cannot represent every scene; write .nff instead",
                format.name.to_uppercase()
            ),
        },
    }
}
