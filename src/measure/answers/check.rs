//! Classes answers as right, tie, rounding or fault.

use crate::geometry::Ray;
use crate::measure::judge::{Answer, Standing, Tolerance, examine_with, scale_of};
use crate::primitive::Precision;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{Batch, Hit, RayKind, RayTracer, ScalarKernel};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What an answer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnswerClass {
    /// The object is that of exact arithmetic, and the distance up to rounding.
    Right,
    /// Another object, or another answer, that is exactly right, too: equal distances, or the ray meets an
    /// edge.
    Tie,
    /// Right if coordinates are first rounded to the precision of the program.
    Rounding,
    /// Wrong.
    Fault,
}

impl AnswerClass {
    pub const ALL: [AnswerClass; 4] = [
        AnswerClass::Right,
        AnswerClass::Tie,
        AnswerClass::Rounding,
        AnswerClass::Fault,
    ];

    /// Returns the name in reports.
    pub const fn name(self) -> &'static str {
        ["right", "tie", "rounding", "fault"][self as usize]
    }

    /// Returns what it means in a few words.
    pub const fn about(self) -> &'static str {
        match self {
            AnswerClass::Right => "the exact object, at its distance up to rounding",
            AnswerClass::Tie => "another answer that is exactly right, too",
            AnswerClass::Rounding => "right for coordinates that are rounded first",
            AnswerClass::Fault => "wrong",
        }
    }
}

/// A wrong answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnswerFault {
    /// Number of the ray, from 0.
    pub number: usize,
    pub ray: Ray,
    /// The exact answer.
    pub expected: Answer,
    pub found: Answer,
}

/// The result for all answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnswerCheck {
    /// Number of answers per [`AnswerClass`].
    pub counts: [u64; 4],
    /// All faults, in the order of the rays.
    pub faults: Vec<AnswerFault>,
}

/// Rays of one call of the kernel.
const CHUNK: usize = 2048;

/// Checks one answer per ray. `precision` is that in which the program computes. The tree must be one of the
/// scene. Answers that are those of the tree in `f64`, whose hits are exact, are right; exact arithmetic decides
/// about all others.
///
/// # Errors
/// Cancellation.
///
/// # Panics
/// If there are not as many answers as rays.
pub fn check_answers(
    scene: &Scene,
    tree: &Tree,
    (rays, answers): (&[Ray], &[Answer]),
    precision: Precision,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<AnswerCheck, Cancelled> {
    assert_eq!(rays.len(), answers.len());
    let done = AtomicUsize::new(0);
    let chunks = rays.par_chunks(CHUNK).zip(answers.par_chunks(CHUNK));
    let chunks = chunks.enumerate().map(|(chunk, (rays, answers))| {
        progress.check()?;
        let mut result = AnswerCheck::default();
        let exact = exact_answers(scene, tree, rays, answers, progress);
        for (i, (&ray, &found)) in rays.iter().zip(answers).enumerate() {
            let expected = exact[i];
            let class = class_of(scene, tree, &ray, [expected, found], precision);
            result.counts[class as usize] += 1;
            if class == AnswerClass::Fault {
                result.faults.push(AnswerFault {
                    number: CHUNK * chunk + i,
                    ray,
                    expected,
                    found,
                });
            }
        }
        let done = done.fetch_add(rays.len(), Ordering::Relaxed);
        progress.set(done as f64 / answers.len().max(1) as f64);
        Ok(result)
    });
    let parts: Result<Vec<AnswerCheck>, Cancelled> = pool.install(|| chunks.collect());
    let mut all = AnswerCheck::default();
    for part in parts? {
        for (all, count) in all.counts.iter_mut().zip(part.counts) {
            *all += count;
        }
        all.faults.extend(part.faults);
    }
    Ok(all)
}

/// Returns the exact answers to the questions that were answered.
fn exact_answers(
    scene: &Scene,
    tree: &Tree,
    rays: &[Ray],
    answers: &[Answer],
    progress: &Progress,
) -> Vec<Answer> {
    let mut kernel = ScalarKernel::new(tree, scene.shapes(Precision::F64), progress);
    let batch = |kind| Batch {
        kind,
        rays,
        pixels: &[],
    };
    if matches!(answers.first(), Some(Answer::Blocked(_))) {
        let mut blocked = Vec::new();
        kernel.any_hits(batch(RayKind::Shadow), &mut blocked);
        blocked.into_iter().map(Answer::Blocked).collect()
    } else {
        let mut hits = Vec::new();
        kernel.closest_hits(batch(RayKind::Primary), &mut hits);
        hits.into_iter().map(Answer::Nearest).collect()
    }
}

fn class_of(
    scene: &Scene,
    tree: &Tree,
    ray: &Ray,
    [expected, found]: [Answer; 2],
    precision: Precision,
) -> AnswerClass {
    let tolerance = Tolerance::of(precision, scale_of(scene, ray));
    let is_same = match (expected, found) {
        (Answer::Nearest(a), Answer::Nearest(b)) => {
            let is_near = (a.t - b.t).abs() <= tolerance.relative * a.t.abs();
            a.object == b.object && (!a.is_hit() || is_near)
        }
        _ => expected == found,
    };
    if is_same {
        return AnswerClass::Right;
    }
    match examine_with(tree, scene, ray, found, tolerance) {
        Standing::Right if is_same_object(expected, found) => AnswerClass::Right,
        Standing::Right => AnswerClass::Tie,
        Standing::Rounded => AnswerClass::Rounding,
        Standing::Wrong => AnswerClass::Fault,
    }
}

fn is_same_object(a: Answer, b: Answer) -> bool {
    let object = |answer| match answer {
        Answer::Nearest(Hit { object, .. }) => Some(object),
        Answer::Blocked(_) => None,
    };
    object(a).is_some() && object(a) == object(b)
}
