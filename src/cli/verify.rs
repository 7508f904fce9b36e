//! `bspscope verify`: trees are valid, and give the same hits as testing every object.

use super::args::{PictureArgs, VerifyArgs};
use super::{Outcome, bar, output, resolve};
use crate::measure::{Answers, RaySample, Verification, answer, compare, judge, sample_rays};
use crate::report::plain_table;
use crate::scene::Scene;
use crate::scene::builtin::BUILTINS;
use crate::trace::{RayKind, thread_pool};
use crate::tree::{BuildSettings, Invalid, Method, Tree, build, validate};
use anyhow::Result;
use std::io::{self, Write};

/// What was found of one scene and method.
struct Finding {
    scene: String,
    method: Method,
    tree: Result<(), Invalid>,
    rays: Verification,
}

impl Finding {
    fn passed(&self) -> bool {
        self.tree.is_ok() && self.rays.passed()
    }
}

pub fn run(args: &VerifyArgs) -> Result<Outcome> {
    let methods = if args.method.is_empty() {
        Method::all().filter(|m| m.name != "none").collect()
    } else {
        args.method.clone()
    };
    let builds = resolve::builds(&methods, &args.build)?;
    let scenes = if args.scenes.is_empty() {
        BUILTINS.iter().map(|b| b.name.to_owned()).collect()
    } else {
        args.scenes.clone()
    };
    let mut findings = Vec::new();
    for scene in &scenes {
        findings.extend(findings_of(scene, &builds, args)?);
    }
    output::write_to(None, |out| write(&findings, out))?;
    Ok(if findings.iter().all(Finding::passed) {
        Outcome::Done
    } else {
        Outcome::CheckFailed
    })
}

/// Holds every method's tree of a scene against the judge.
fn findings_of(text: &str, builds: &[BuildSettings], args: &VerifyArgs) -> Result<Vec<Finding>> {
    let (_, scene) = resolve::scene(text, &args.cylinders)?;
    // The sample's own size takes the place of a resolution.
    let any_size = PictureArgs { resolution: [1, 1] };
    let render = resolve::render(*scene.camera(), &args.trace, &any_size);
    let pool = thread_pool(render.threads)?;
    let mut expected: Option<(RaySample, Answers)> = None;
    let mut findings = Vec::new();
    for settings in builds {
        let method = settings.method;
        let stage = |what: &str| format!("{}, {}: {what}", scene.name(), method.name);
        let tree = bar::with_bar(&stage("building the tree"), |progress| {
            build(&scene, settings, progress)
        })?;
        let (sample, answers) = match &mut expected {
            Some(expected) => expected,
            none => {
                let sample = bar::with_bar(&stage("taking rays"), |progress| {
                    sample_rays(&scene, &tree, &render, args.rays as usize, &pool, progress)
                })?;
                let answers = judged(&scene, &sample, &pool)?;
                none.insert((sample, answers))
            }
        };
        let found = bar::with_bar(&stage("asking the tree"), |progress| {
            answer(&scene, &tree, sample, &pool, progress)
        })?;
        findings.push(Finding {
            scene: scene.name().to_owned(),
            method,
            tree: validate(&scene, &tree),
            rays: compare(sample, answers, &found),
        });
    }
    Ok(findings)
}

/// What testing every object says.
fn judged(scene: &Scene, sample: &RaySample, pool: &rayon::ThreadPool) -> Result<Answers> {
    bar::with_bar(
        &format!("{}: testing every object", scene.name()),
        |progress| {
            let everything: Tree = judge(scene, progress)?;
            Ok(answer(scene, &everything, sample, pool, progress)?)
        },
    )
}

fn write(findings: &[Finding], out: &mut dyn Write) -> io::Result<()> {
    let titles = ["scene", "method", "tree", "kind of rays", "rays", "wrong"];
    let mut table = plain_table(titles.map(String::from).to_vec(), 4);
    for finding in findings {
        for kind in RayKind::ALL {
            let k = kind as usize;
            table.add_row([
                finding.scene.clone(),
                finding.method.name.into(),
                if finding.tree.is_ok() {
                    "valid".into()
                } else {
                    "wrong".into()
                },
                kind.name().to_owned(),
                finding.rays.rays[k].to_string(),
                finding.rays.wrong[k].to_string(),
            ]);
        }
    }
    writeln!(out, "{}", table.trim_fmt())?;
    for finding in findings.iter().filter(|f| !f.passed()) {
        let name = format!("{}, {}", finding.scene, finding.method.name);
        if let Err(wrong) = &finding.tree {
            writeln!(out, "{name}: {wrong}")?;
        }
        for (kind, ray) in &finding.rays.examples {
            writeln!(
                out,
                "{name}: another answer for the {} ray from {} along {}",
                kind.name(),
                ray.origin,
                ray.direction
            )?;
        }
    }
    let wrong = findings.iter().filter(|f| !f.passed()).count();
    if wrong == 0 {
        writeln!(
            out,
            "All {} trees are valid and every hit is right.",
            findings.len()
        )
    } else {
        writeln!(out, "{wrong} of {} trees are wrong.", findings.len())
    }
}
