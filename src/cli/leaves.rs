//! `bspscope leaves`: writes the leaf boxes of a tree for other programs.

use super::args::{LeavesArgs, LeavesShown};
use super::outcome::Outcome;
use super::{output, resolve};
use crate::present::export::{LEAF_WRITERS, LeafCells};
use crate::present::overlay::Filter;
use anyhow::Result;

pub fn run(args: &LeavesArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let setup = args.settings.setup(&args.scene)?;
    let scene = resolve::scene(&setup.scene)?;
    let tree = resolve::tree(&scene, &setup)?;
    let filter = Filter {
        full: args.only != Some(LeavesShown::Empty),
        empty: args.only != Some(LeavesShown::Full),
        ..Filter::default()
    };
    let of = format!("{}, {}", scene.name(), setup.build.method.name);
    let leaves = LeafCells::new(of, &tree, &filter, None);
    let file = args.output.as_deref();
    let writer = resolve::writer(LEAF_WRITERS, args.format.as_deref(), file);
    output::write_to(file, |out| (writer.write)(&leaves, out))?;
    Ok(Outcome::Done)
}
