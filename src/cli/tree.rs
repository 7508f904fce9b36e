//! `bspscope tree`: writes a tree to a file.

use super::args::TreeArgs;
use super::outcome::Outcome;
use super::{output, resolve};
use crate::files;
use crate::scene::SceneSource;
use crate::structure::tree_file::{Origin, write};
use anyhow::Result;

pub fn run(args: &TreeArgs) -> Result<Outcome> {
    output::check_place(Some(&args.output))?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = resolve::scene(&setup.scene)?;
    let tree = resolve::tree(&scene, &setup)?;
    let sha256 = match &setup.scene.source {
        SceneSource::File(path) => Some(files::sha256(path)?),
        SceneSource::Builtin { .. } => None,
    };
    let origin = Origin { sha256 };
    output::write_to(Some(&args.output), |out| write(&tree, &scene, &origin, out))?;
    Ok(Outcome::Done)
}
