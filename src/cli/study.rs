//! `bspscope study`: answers questions by measuring many structures.

use super::outcome::Outcome;
use super::study_args::{MeasuresArgs, StudyArgs, StudyCommand};
use super::{bar, output, resolve};
use crate::jobs::StudyMeasures;
use crate::measure::structures;
use crate::measure::study::{KERNELS, Plan, SCENES};
use crate::present::chart::measures_svg;
use crate::present::report::study::{STUDY_WRITERS, StudyReport};
use crate::present::report::{Machine, now};
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::{Path, absolute};
use std::sync::Arc;

pub fn run(args: &StudyArgs) -> Result<Outcome> {
    match &args.command {
        StudyCommand::Measures(args) => measures(args),
    }
}

fn measures(args: &MeasuresArgs) -> Result<Outcome> {
    output::check_place(args.output.as_deref())?;
    let given: Vec<&str> = args.scenes.iter().map(String::as_str).collect();
    let sources = if given.is_empty() {
        &SCENES[..]
    } else {
        &given
    };
    let mut scenes = Vec::new();
    for source in sources {
        let setup = args.settings.setup(source)?;
        let scene = Arc::new(resolve::scene_in_view(&setup)?);
        ensure!(!scene.objects().is_empty(), "{}: no objects", scene.name());
        scenes.push((scene, setup));
    }
    let mut outcomes = Vec::new();
    for (scene, setup) in scenes {
        let plan = Plan {
            render: setup.render,
            builds: structures(&scene),
            kernels: KERNELS.to_vec(),
            rays: args.rays as usize,
            rounds: args.rounds as usize,
        };
        outcomes.push(bar::follow(StudyMeasures { scene, plan }, |()| Ok(()))?);
    }
    if let Some(folder) = &args.figures {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        for outcome in &outcomes {
            let figure = measures_svg(outcome)?;
            let path = folder.join(StudyReport::figure(outcome));
            output::write_file(&path, |out| out.write_all(figure.as_bytes()))?;
        }
    }
    let words = std::iter::once("bspscope".to_owned()).chain(std::env::args().skip(1));
    let report = StudyReport {
        outcomes,
        machine: Machine::here(),
        date: now(),
        command: shell_words::join(words),
        figures: args
            .figures
            .as_deref()
            .map(|folder| seen_from(args.output.as_deref(), folder)),
    };
    let file = args.output.as_deref();
    let writer = resolve::writer(STUDY_WRITERS, args.format.as_deref(), file);
    output::write_to(file, |out| (writer.write)(&report, out))?;
    Ok(Outcome::Done)
}

/// Returns a folder as a document in a file refers to it: relative to the file's folder.
fn seen_from(file: Option<&Path>, folder: &Path) -> String {
    let relative = || {
        let file = absolute(file?).ok()?;
        pathdiff::diff_paths(absolute(folder).ok()?, file.parent()?)
    };
    let seen = relative().unwrap_or_else(|| folder.to_path_buf());
    seen.display().to_string().replace('\\', "/")
}
