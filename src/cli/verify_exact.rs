//! `bspscope verify --exact`: every structure and kernel against exact arithmetic.

use super::args::VerifyArgs;
use super::outcome::Outcome;
use super::{bar, failures, output, resolve};
use crate::measure::exact::{ExactCheck, ExactFault, ExactFaults, check_exactly};
use crate::present::number::counted;
use crate::present::report::plain_table;
use crate::trace::thread_pool;
use anyhow::Result;
use std::io::{self, Write};

/// The result for one scene.
struct Finding {
    scene: String,
    check: ExactCheck,
    /// Whether the trees of all methods could be built.
    all_fit: bool,
}

impl Finding {
    fn passed(&self) -> bool {
        self.all_fit && self.check.passed()
    }
}

/// Checks `count` rays per scene and precision.
pub fn run(scenes: &[String], args: &VerifyArgs, count: u32) -> Result<Outcome> {
    let mut findings = Vec::new();
    for scene in scenes {
        findings.push(finding(scene, args, count)?);
    }
    output::write_to(None, |out| write(&findings, out))?;
    Ok(if findings.iter().all(Finding::passed) {
        Outcome::Done
    } else {
        Outcome::CheckFailed
    })
}

fn finding(text: &str, args: &VerifyArgs, count: u32) -> Result<Finding> {
    let setups = args.settings.setups(text)?;
    let render = &setups[0].render;
    let scene = resolve::scene(&setups[0].scene)?;
    resolve::warn_of_precision(&scene, render);
    let pool = thread_pool(render.threads)?;
    let (mut trees, mut failed) = (Vec::new(), Vec::new());
    for setup in &setups {
        match resolve::tree_or_failure(&scene, setup)? {
            Ok(tree) => trees.push(tree),
            Err(failure) => failed.push(failure),
        }
    }
    failures::check_any(&trees, &failed)?;
    let stage = format!("{}: deciding rays exactly", scene.name());
    let check = bar::with_bar(&stage, |progress| {
        check_exactly(&scene, &trees, render, count as usize, &pool, progress)
    })?;
    Ok(Finding {
        scene: scene.name().to_owned(),
        check,
        all_fit: failed.is_empty(),
    })
}

fn write(findings: &[Finding], out: &mut dyn Write) -> io::Result<()> {
    for finding in findings {
        table(finding, out)?;
    }
    for Finding { scene, check, .. } in findings {
        let rays = check.rays.iter().filter(|(_, count)| *count > 0);
        let sources: Vec<_> = rays
            .map(|(source, count)| format!("{count} {}", source.name()))
            .collect();
        writeln!(
            out,
            "{scene}: {} in each precision, decided exactly: {}.",
            counted(check.ray_count() as usize, "ray"),
            sources.join(", ")
        )?;
        writeln!(
            out,
            "    {} in all; {:.1} s for exact arithmetic, {:.1} s for the kernels",
            counted(check.hits as usize, "hit"),
            check.deciding.as_secs_f64(),
            check.tracing.as_secs_f64()
        )?;
        first_faults(check, out)?;
    }
    summary(findings, out)
}

/// Writes the number of wrong answers for each structure, precision and kernel.
fn table(finding: &Finding, out: &mut dyn Write) -> io::Result<()> {
    let faults = &finding.check.faults;
    let mut rows = faults
        .chunk_by(|a, b| (a.method, a.precision) == (b.method, b.precision))
        .peekable();
    let kernels = rows.peek().map_or(Vec::new(), |row| row.to_vec());
    let titles = ["scene", "structure", "precision"].map(String::from);
    let kernels = kernels.iter().map(|faults| faults.kernel.name());
    let mut table = plain_table(titles.into_iter().chain(kernels).collect(), 3);
    for row in rows {
        let mut texts = vec![
            finding.scene.clone(),
            structure(&row[0]).to_owned(),
            row[0].precision.name().to_owned(),
        ];
        texts.extend(row.iter().map(|faults| faults.count().to_string()));
        table.add_row(texts);
    }
    writeln!(out, "Wrong answers:\n{}", table.trim_fmt())
}

fn structure(faults: &ExactFaults) -> &'static str {
    faults.method.unwrap_or("every object")
}

/// Writes the first wrong answer of every structure and precision, except those of an earlier one.
fn first_faults(check: &ExactCheck, out: &mut dyn Write) -> io::Result<()> {
    let mut written: Vec<ExactFault> = Vec::new();
    for faults in &check.faults {
        let Some(first) = faults.first.filter(|first| !written.contains(first)) else {
            continue;
        };
        written.push(first);
        writeln!(
            out,
            "    {}, {}, {}: {:?} instead of {:?}, ray {}: {:?}",
            structure(faults),
            faults.precision.name(),
            faults.kernel.name(),
            first.found,
            first.expected,
            first.source.name(),
            first.ray
        )?;
    }
    Ok(())
}

fn summary(findings: &[Finding], out: &mut dyn Write) -> io::Result<()> {
    let mut all = findings.iter().flat_map(|finding| &finding.check.faults);
    if all.all(|faults| faults.count() == 0) {
        return writeln!(
            out,
            "All answers are exactly right, of testing every object and of every structure."
        );
    }
    let wrong_scenes = |is_every_object: bool| {
        let is_wrong = |check: &ExactCheck| {
            let mut faults = check.faults.iter();
            faults.any(|f| f.method.is_none() == is_every_object && f.count() > 0)
        };
        let wrong = findings.iter().filter(|finding| is_wrong(&finding.check));
        wrong
            .map(|f| f.scene.as_str())
            .collect::<Vec<_>>()
            .join(", ")
    };
    for (what, is_every_object) in [("Testing every object is", true), ("Structures are", false)] {
        match wrong_scenes(is_every_object).as_str() {
            "" => writeln!(out, "{what} exactly right.")?,
            scenes => writeln!(out, "{what} wrong in: {scenes}.")?,
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Ray, Vec3};
    use crate::measure::exact::{ExactKernel, RaySource};
    use crate::measure::judge::Answer;
    use crate::primitive::Precision;
    use std::time::Duration;

    /// Returns the text for one scene, with so many wrong answers of testing every object and of a structure.
    fn text_of(every_object: u64, structure: u64) -> String {
        let faults = [(None, every_object), (Some("octree"), structure)];
        let faults = faults.map(|(method, any)| ExactFaults {
            method,
            precision: Precision::F64,
            kernel: ExactKernel::Counting,
            closest: 0,
            any,
            first: (any > 0).then_some(ExactFault {
                source: RaySource::Edges,
                ray: Ray::new(Vec3::ZERO, Vec3::Y),
                expected: Answer::Blocked(true),
                found: Answer::Blocked(false),
            }),
        });
        let check = ExactCheck {
            rays: vec![(RaySource::Edges, 7), (RaySource::Planes, 0)],
            hits: 3,
            faults: faults.into(),
            deciding: Duration::ZERO,
            tracing: Duration::ZERO,
        };
        assert_eq!(check.passed(), every_object + structure == 0);
        let scene = "teaching:1".to_owned();
        let mut text = Vec::new();
        write(
            &[Finding {
                scene,
                check,
                all_fit: true,
            }],
            &mut text,
        )
        .unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn the_summary_says_whether_testing_every_object_is_right() {
        let right = text_of(0, 0);
        assert!(right.contains("All answers are exactly right"), "{right}");
        assert!(right.contains("7 rays in each precision"), "{right}");
        assert!(right.contains("7 at edges.") && !right.contains("in planes"));
        let only_tree = text_of(0, 2);
        assert!(only_tree.contains("Testing every object is exactly right."));
        assert!(only_tree.contains("Structures are wrong in: teaching:1."));
        assert!(only_tree.contains("octree, f64, counting: Blocked(false)"));
        let both = text_of(2, 2);
        assert!(both.contains("Testing every object is wrong in: teaching:1."));
        // The same fault is written once.
        assert_eq!(both.matches("Blocked(false)").count(), 1, "{both}");
    }
}
