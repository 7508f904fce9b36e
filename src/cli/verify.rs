//! `bspscope verify`: checks that trees are valid and give the same hits as testing every object.

use super::args::VerifyArgs;
use super::outcome::Outcome;
use super::{bar, failures, output, resolve, verify_exact};
use crate::measure::judge::{Answer, Answerer, Case, Verdict};
use crate::measure::{Answers, RaySample, Verification, answer, compare, sample_rays, unsplit};
use crate::present::number::counted;
use crate::present::report::plain_table;
use crate::primitive::Precision;
use crate::scene::Scene;
use crate::scene::builtin::BUILTINS;
use crate::setup::Setup;
use crate::structure::tree_file::Faults;
use crate::structure::{BuildSettings, Invalid, Method, Tree, validate};
use crate::trace::{RayKind, thread_pool};
use anyhow::{Context, Result};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The result for one scene and method.
struct Finding {
    scene: String,
    method: Method,
    precision: Precision,
    tree: Result<(), Invalid>,
    /// What is wrong with the tree in its file.
    file: Faults,
    rays: Verification,
    /// What the tree of a file found for the first faults, which are not written to files.
    differences: Vec<String>,
    /// Files with the first faults.
    files: Vec<PathBuf>,
}

impl Finding {
    fn passed(&self) -> bool {
        self.is_valid() && self.rays.passed()
    }

    fn is_valid(&self) -> bool {
        self.tree.is_ok() && self.file.is_empty()
    }

    /// Returns whether the tree itself is wrong. Where it differs from testing every object, the tree may be
    /// right.
    fn tree_is_wrong(&self) -> bool {
        !self.is_valid() || self.rays.tree_wrong > 0
    }
}

pub fn run(args: &VerifyArgs) -> Result<Outcome> {
    if let Some(file) = &args.replay {
        return replay(file);
    }
    let scenes = if args.scenes.is_empty() {
        BUILTINS.iter().map(|b| b.name.to_owned()).collect()
    } else {
        args.scenes.clone()
    };
    if let Some(count) = args.exact {
        return verify_exact::run(&scenes, args, count);
    }
    let (mut findings, mut is_complete) = (Vec::new(), true);
    for scene in &scenes {
        let (of_scene, all_fit) = findings_of(scene, args)?;
        findings.extend(of_scene);
        is_complete &= all_fit;
    }
    output::write_to(None, |out| write(&findings, out))?;
    Ok(outcome(&findings, is_complete))
}

/// A check that left out a tree has not passed.
fn outcome(findings: &[Finding], is_complete: bool) -> Outcome {
    if is_complete && findings.iter().all(Finding::passed) {
        Outcome::Done
    } else {
        Outcome::CheckFailed
    }
}

/// Compares the tree of every method with testing every object. Also returns whether all trees could be built.
fn findings_of(text: &str, args: &VerifyArgs) -> Result<(Vec<Finding>, bool)> {
    let setups = args.settings.setups(text)?;
    let Setup {
        scene: request,
        render,
        ..
    } = &setups[0];
    let scene = resolve::scene(request)?;
    resolve::warn_of_precision(&scene, render);
    let pool = thread_pool(render.threads)?;
    let precision = render.precision_for(&scene).precision;
    let mut expected: Option<(RaySample, Answers)> = None;
    let mut findings = Vec::new();
    let mut failed = Vec::new();
    for setup in &setups {
        let tree = match resolve::tree_or_failure(&scene, setup)? {
            Ok(tree) => tree,
            Err(failure) => {
                failed.push(failure);
                continue;
            }
        };
        let method = setup.build.method;
        let stage = |what: &str| format!("{}, {}: {what}", scene.name(), method.name);
        let (sample, answers) = match &mut expected {
            Some(expected) => expected,
            none => {
                let sample = bar::with_bar(&stage("sampling rays"), |progress| {
                    sample_rays(&scene, &tree, render, args.rays as usize, &pool, progress)
                })?;
                let answers = reference_answers(&scene, precision, &sample, &pool)?;
                none.insert((sample, answers))
            }
        };
        let found = bar::with_bar(&stage("tracing rays"), |progress| {
            answer(&scene, &tree, precision, sample, &pool, progress)
        })?;
        findings.push(Finding {
            scene: scene.name().to_owned(),
            method,
            precision,
            tree: validate(&scene, &tree),
            file: tree.faults().clone(),
            rays: compare(&scene, sample, answers, &found, None),
            differences: Vec::new(),
            files: Vec::new(),
        });
        if let Some(finding) = findings.last_mut() {
            for case in cases(&scene, &setup.build, &finding.rays)? {
                if method.is_file() {
                    finding.differences.push(difference(&case));
                } else {
                    finding.files.push(write_fault(case)?);
                }
            }
        }
    }
    failures::check_any(&findings, &failed)?;
    Ok((findings, failed.is_empty()))
}

/// Returns the faults that occur again.
fn cases(scene: &Scene, settings: &BuildSettings, rays: &Verification) -> Result<Vec<Case>> {
    let mut cases = Vec::new();
    for &(kind, ray) in &rays.faults {
        cases.extend(Case::of(scene, settings, kind, ray)?);
    }
    Ok(cases)
}

/// Writes a fault to a file of its own.
pub fn write_fault(case: Case) -> Result<PathBuf> {
    let (path, mut file) = output::create_free("fault", "json")?;
    writeln!(file, "{}", case.shrunk().to_json()).with_context(|| path.display().to_string())?;
    Ok(path)
}

fn difference(case: &Case) -> String {
    let (kind, origin, direction) = (case.kind.name(), case.ray.origin, case.ray.direction);
    let answers = both(name_of(&case.by), case.expected, case.found);
    format!("for the {kind} ray from {origin} along {direction}, {answers}")
}

/// Repeats the case of a file.
fn replay(file: &Path) -> Result<Outcome> {
    let name = file.display();
    let text = std::fs::read_to_string(file).with_context(|| name.to_string())?;
    let case = Case::from_json(&text).with_context(|| name.to_string())?;
    let (ray, who) = (&case.ray, name_of(&case.by));
    let by = match &case.by {
        Answerer::Tree(settings) => settings.method.name,
        Answerer::Program(_) => "another program",
    };
    let again = case.replay().with_context(|| name.to_string())?;
    let mut lines = vec![
        format!(
            "{}, {by}: the {} ray from {} along {}",
            counted(case.scene.objects().len(), "object"),
            case.kind.name(),
            ray.origin,
            ray.direction
        ),
        format!("  in the file: {}", both(who, case.expected, case.found)),
    ];
    let outcome = match &again {
        None => {
            lines.push("  now: both agree.".to_owned());
            Outcome::Done
        }
        Some(again) => {
            lines.push(format!("  now: {}", both(who, again.expected, again.found)));
            let verdict = again.verdict();
            lines.push(format!("  {}", in_words(who, verdict)));
            if matches!(verdict, Verdict::Fault { .. }) {
                Outcome::CheckFailed
            } else {
                Outcome::Done
            }
        }
    };
    output::write_to(None, |out| {
        lines.iter().try_for_each(|line| writeln!(out, "{line}"))
    })?;
    Ok(outcome)
}

/// Returns what the one who gave an answer is called.
fn name_of(by: &Answerer) -> &'static str {
    match by {
        Answerer::Tree(_) => "the tree",
        Answerer::Program(_) => "the program",
    }
}

/// Returns what testing every object finds and what another one does.
pub fn both(who: &str, expected: Answer, found: Answer) -> String {
    let said = |answer| match answer {
        Answer::Nearest(hit) if hit.is_hit() => format!("object {} at {:?}", hit.object, hit.t),
        Answer::Nearest(_) => "nothing".to_owned(),
        Answer::Blocked(true) => "blocked".to_owned(),
        Answer::Blocked(false) => "not blocked".to_owned(),
    };
    format!(
        "testing every object finds {}, {who} finds {}",
        said(expected),
        said(found)
    )
}

fn in_words(who: &str, verdict: Verdict) -> String {
    match verdict {
        Verdict::Tie => "A tie: both are exactly right.".into(),
        Verdict::Rounding => "Rounding: both are right up to rounding.".into(),
        Verdict::Fault {
            a_is_wrong: false, ..
        } => format!("A fault: {who} is wrong."),
        Verdict::Fault {
            b_is_wrong: false, ..
        } => "A fault: testing every object is wrong.".into(),
        Verdict::Fault { .. } => "A fault: both are wrong.".into(),
    }
}

/// Returns the answers of testing every object.
fn reference_answers(
    scene: &Scene,
    precision: Precision,
    sample: &RaySample,
    pool: &rayon::ThreadPool,
) -> Result<Answers> {
    bar::with_bar(
        &format!("{}: testing every object", scene.name()),
        |progress| {
            let everything: Tree = unsplit(scene, progress)?;
            Ok(answer(
                scene,
                &everything,
                precision,
                sample,
                pool,
                progress,
            )?)
        },
    )
}

fn write(findings: &[Finding], out: &mut dyn Write) -> io::Result<()> {
    let titles = [
        "scene",
        "method",
        "precision",
        "tree",
        "kind of rays",
        "rays",
        "ties",
        "faults",
    ];
    let mut table = plain_table(titles.map(String::from).to_vec(), 5);
    for finding in findings {
        for kind in RayKind::ALL {
            let k = kind as usize;
            table.add_row([
                finding.scene.clone(),
                finding.method.name.into(),
                finding.precision.name().into(),
                if finding.is_valid() {
                    "valid".into()
                } else {
                    "invalid".into()
                },
                kind.name().to_owned(),
                finding.rays.rays[k].to_string(),
                finding.rays.others[k].ties.to_string(),
                finding.rays.others[k].faults.to_string(),
            ]);
        }
    }
    writeln!(out, "{}", table.trim_fmt())?;
    for finding in findings.iter().filter(|f| !f.passed()) {
        let name = format!("{}, {}", finding.scene, finding.method.name);
        match &finding.tree {
            Err(wrong) if finding.file.is_empty() => writeln!(out, "{name}: {wrong}")?,
            _ => {}
        }
        for fault in finding.file.list() {
            writeln!(out, "{name}: {fault}")?;
        }
        for difference in &finding.differences {
            writeln!(out, "{name}: {difference}")?;
        }
        let without_details = finding.rays.faults.iter().skip(finding.differences.len());
        for (kind, ray) in without_details {
            writeln!(
                out,
                "{name}: wrong hit for the {} ray from {} along {}",
                kind.name(),
                ray.origin,
                ray.direction
            )?;
        }
        for file in &finding.files {
            let file = file.display();
            writeln!(
                out,
                "{name}: to repeat it, run bspscope verify --replay {file}"
            )?;
        }
    }
    if findings.iter().all(Finding::passed) {
        return writeln!(
            out,
            "All {} trees are valid and all hits are right.",
            findings.len()
        );
    }
    let wrong = findings.iter().filter(|f| f.tree_is_wrong()).count();
    let mut scenes: Vec<&str> = findings
        .iter()
        .filter(|f| f.rays.every_object_wrong > 0)
        .map(|f| f.scene.as_str())
        .collect();
    scenes.dedup();
    if !scenes.is_empty() {
        let scenes = scenes.join(", ");
        writeln!(out, "Testing every object is wrong in: {scenes}.")?;
    }
    writeln!(out, "{wrong} of {} trees are wrong.", findings.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Ray, Vec3};

    #[test]
    fn a_wrong_tree_and_a_wrong_hit_fail_the_check_and_are_named() {
        let right = || Finding {
            scene: "teaching:1".into(),
            method: Method::of_the_paper()[0],
            precision: Precision::F64,
            tree: Ok(()),
            file: Faults::default(),
            rays: Verification {
                rays: [10; 4],
                ..Verification::default()
            },
            differences: Vec::new(),
            files: Vec::new(),
        };
        let wrong_tree = Finding {
            tree: Err(Invalid::Plane(7)),
            ..right()
        };
        let mut wrong_hit = right();
        wrong_hit.rays.others[RayKind::Shadow as usize].faults = 3;
        wrong_hit.rays.tree_wrong = 3;
        wrong_hit.rays.faults = vec![(RayKind::Shadow, Ray::new(Vec3::ZERO, Vec3::Y))];

        assert_eq!(outcome(&[right(), right()], true), Outcome::Done);
        assert_eq!(outcome(&[right()], false), Outcome::CheckFailed);
        for (wrong, said) in [
            (wrong_tree, "teaching:1, midpoint: node 7"),
            (wrong_hit, "the shadow ray from [0, 0, 0] along [0, 1, 0]"),
        ] {
            let findings = [right(), wrong];
            assert_eq!(outcome(&findings, true), Outcome::CheckFailed);
            let mut text = Vec::new();
            write(&findings, &mut text).unwrap();
            let text = String::from_utf8(text).unwrap();
            assert!(text.contains(said), "{text}");
            assert!(text.contains("1 of 2 trees are wrong"), "{text}");
        }
    }

    #[test]
    fn the_summary_says_when_testing_every_object_is_wrong() {
        let mut finding = Finding {
            scene: "teaching:1".into(),
            method: Method::of_the_paper()[0],
            precision: Precision::F64,
            tree: Ok(()),
            file: Faults::default(),
            rays: Verification::default(),
            differences: Vec::new(),
            files: Vec::new(),
        };
        finding.rays.others[0].faults = 1;
        finding.rays.every_object_wrong = 1;
        assert_eq!(
            outcome(std::slice::from_ref(&finding), true),
            Outcome::CheckFailed
        );
        let mut text = Vec::new();
        write(&[finding], &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(
            text.contains("Testing every object is wrong in: teaching:1."),
            "{text}"
        );
        assert!(text.contains("0 of 1 trees are wrong."), "{text}");
    }
}
