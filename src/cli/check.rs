//! `bspscope check`: classes the answers of another program about rays.

use super::args::CheckArgs;
use super::outcome::Outcome;
use super::verify::{both, write_fault};
use super::{bar, output, resolve};
use crate::measure::answers::{
    AnswerCheck, AnswerClass, AnswerFault, check_answers, read_answers, read_rays,
};
use crate::measure::judge::Case;
use crate::present::number::counted;
use crate::scene::Scene;
use crate::structure::{BuildSettings, Method};
use crate::trace::thread_pool;
use anyhow::{Result, bail};
use std::io::{self, Write};
use std::path::PathBuf;

/// Number of faults that are printed and written to files.
const EXAMPLES: usize = 5;

/// The method whose tree gives the exact answers.
const METHOD: &str = "bvh-binned";

pub fn run(args: &CheckArgs) -> Result<Outcome> {
    let (rays, answers) = (read_rays(&args.rays)?, read_answers(&args.answers)?);
    if rays.len() != answers.len() {
        bail!("{} rays, but {} answers", rays.len(), answers.len());
    }
    let mut setup = args.settings.setup(&args.scene)?;
    setup.build = BuildSettings::for_method(Method::named(METHOD)?);
    let scene = resolve::scene(&setup.scene)?;
    let tree = resolve::tree(&scene, &setup)?;
    let pool = thread_pool(setup.render.threads)?;
    let stage = format!("{}: checking answers", scene.name());
    let check = bar::with_bar(&stage, |progress| {
        let asked = (rays.as_slice(), answers.as_slice());
        check_answers(&scene, &tree, asked, args.precision, &pool, progress)
    })?;
    let files = files(&scene, args, &check.faults)?;
    output::write_to(None, |out| write(&check, &files, out))?;
    Ok(match check.faults.is_empty() {
        true => Outcome::Done,
        false => Outcome::CheckFailed,
    })
}

/// Writes the first faults to files, each with as few objects as needed.
fn files(scene: &Scene, args: &CheckArgs, faults: &[AnswerFault]) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for fault in faults.iter().take(EXAMPLES) {
        let case = Case::of_program(scene, args.precision, fault.ray, fault.found)?;
        files.extend(case.map(write_fault).transpose()?);
    }
    Ok(files)
}

fn write(check: &AnswerCheck, files: &[PathBuf], out: &mut dyn Write) -> io::Result<()> {
    let all: u64 = check.counts.iter().sum();
    writeln!(out, "{}:", counted(all as usize, "answer"))?;
    for class in AnswerClass::ALL {
        let (name, about) = (class.name(), class.about());
        let count = check.counts[class as usize];
        writeln!(out, "{name:>10} {count:>10}  {about}")?;
    }
    for (i, fault) in check.faults.iter().take(EXAMPLES).enumerate() {
        let AnswerFault { number, ray, .. } = fault;
        let answers = both("the program", fault.expected, fault.found);
        let (origin, direction) = (ray.origin, ray.direction);
        writeln!(
            out,
            "ray {number} from {origin} along {direction}: {answers}"
        )?;
        if let Some(file) = files.get(i) {
            let file = file.display();
            writeln!(out, "  to repeat it, run bspscope verify --replay {file}")?;
        }
    }
    let more = check.faults.len().saturating_sub(EXAMPLES);
    if more > 0 {
        writeln!(out, "and {} more", counted(more, "fault"))?;
    }
    Ok(())
}
