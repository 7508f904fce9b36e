//! Verification: checks that a tree returns the same hits as testing every object, for rays of
//! every kind. If they differ, exact arithmetic decides why.

use super::judge::{Answer, Tally, Tolerance, Verdict, scale_of, settle};
use crate::geometry::Ray;
use crate::primitive::Precision;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::{BuildError, BuildSettings, Method, Tree, build};
use crate::trace::{
    Batch, Hit, RayKind, RayTracer, RenderError, RenderSettings, ScalarKernel, Shading, tiles,
    trace_samples,
};
use rayon::prelude::*;

/// Rays of a picture of the scene, for each [`RayKind`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RaySample {
    pub rays: [Vec<Ray>; 4],
}

/// The answers to a [`RaySample`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// For each [`RayKind`]; empty for shadow rays.
    hits: [Vec<Hit>; 4],
    blocked: Vec<bool>,
}

impl Answers {
    /// Returns the answer for ray `i` of a kind.
    ///
    /// # Panics
    /// If there is no such ray.
    pub fn of(&self, kind: RayKind, i: usize) -> Answer {
        match kind {
            RayKind::Shadow => Answer::Blocked(self.blocked[i]),
            _ => Answer::Nearest(self.hits[kind as usize][i]),
        }
    }
}

/// The result of comparing a tree with testing every object, for each [`RayKind`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verification {
    /// Number of rays compared.
    pub rays: [u64; 4],
    /// Number of rays with different answers, per verdict.
    pub others: [Tally; 4],
    /// Number of faults in which testing every object is wrong.
    pub every_object_wrong: u64,
    /// Number of faults in which the tree is wrong. Both may be.
    pub tree_wrong: u64,
    /// The first few faults.
    pub faults: Vec<(RayKind, Ray)>,
}

impl Verification {
    /// Returns whether there is no fault.
    pub fn passed(&self) -> bool {
        self.others.iter().all(|tally| tally.faults == 0)
    }

    /// Returns whether all answers are identical, bit for bit.
    pub fn is_identical(&self) -> bool {
        self.others == [Tally::default(); 4]
    }
}

impl std::ops::AddAssign for Verification {
    /// Adds the counts and keeps the first few faults.
    fn add_assign(&mut self, other: Verification) {
        for k in 0..self.rays.len() {
            self.rays[k] += other.rays[k];
            self.others[k] += other.others[k];
        }
        self.every_object_wrong += other.every_object_wrong;
        self.tree_wrong += other.tree_wrong;
        self.faults.extend(other.faults);
        self.faults.truncate(EXAMPLES);
    }
}

/// Number of faults to keep.
const EXAMPLES: usize = 5;

/// Records the rays that the renderer traces.
struct Recorder<'a> {
    tracer: ScalarKernel<'a>,
    sample: RaySample,
}

impl RayTracer for Recorder<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        self.sample.rays[batch.kind as usize].extend_from_slice(batch.rays);
        self.tracer.closest_hits(batch, hits);
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        self.sample.rays[batch.kind as usize].extend_from_slice(batch.rays);
        self.tracer.any_hits(batch, blocked);
    }
}

/// Returns a sample of the rays of a picture, evenly distributed over it: `per_kind` rays of each
/// kind that occurs, or fewer if there are not enough. Traces up to 64 samples per pixel.
///
/// # Errors
/// A camera without a view, or cancellation.
pub fn sample_rays(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    per_kind: usize,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<RaySample, RenderError> {
    let side = (per_kind as f64).sqrt().ceil().max(1.0) as u32;
    let settings = RenderSettings {
        width: side,
        height: side,
        ..*settings
    };
    let shading = Shading::new(scene, &settings)?;
    let mut found = RaySample::default();
    for sample in 0..64 {
        let parts: Vec<RaySample> = pool.install(|| {
            tiles(side, side)
                .par_iter()
                .map(|tile| {
                    let pixels: Vec<_> = (0..tile.len() as u32).map(|i| tile.pixel(i)).collect();
                    let mut recorder = Recorder {
                        tracer: ScalarKernel::new(tree, shading.shapes, progress),
                        sample: RaySample::default(),
                    };
                    trace_samples(&shading, &pixels, sample, &mut recorder, &mut Vec::new());
                    recorder.sample
                })
                .collect()
        });
        progress.check()?;
        for part in parts {
            for (all, rays) in found.rays.iter_mut().zip(part.rays) {
                if all.len() < per_kind || sample == 0 {
                    all.extend(rays);
                }
            }
        }
        if found
            .rays
            .iter()
            .all(|rays| rays.is_empty() || rays.len() >= per_kind)
        {
            break;
        }
    }
    for rays in &mut found.rays {
        if rays.len() > per_kind {
            let total = rays.len();
            *rays = (0..per_kind).map(|i| rays[i * total / per_kind]).collect();
        }
    }
    Ok(found)
}

/// Traces every ray of a sample in the given precision.
///
/// # Errors
/// Cancellation.
pub fn answer(
    scene: &Scene,
    tree: &Tree,
    precision: Precision,
    sample: &RaySample,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<Answers, Cancelled> {
    const CHUNK: usize = 256;
    let shapes = scene.shapes(precision);
    let mut answers = Answers::default();
    let total: usize = sample.rays.iter().map(Vec::len).sum();
    let done = std::sync::atomic::AtomicUsize::new(0);
    pool.install(|| {
        for kind in RayKind::ALL {
            let chunks = sample.rays[kind as usize].par_chunks(CHUNK).map(|rays| {
                let mut tracer = ScalarKernel::new(tree, shapes, progress);
                let batch = Batch {
                    kind,
                    rays,
                    pixels: &[],
                };
                let (mut hits, mut blocked) = (Vec::new(), Vec::new());
                if kind == RayKind::Shadow {
                    tracer.any_hits(batch, &mut blocked);
                } else {
                    tracer.closest_hits(batch, &mut hits);
                }
                let done = done.fetch_add(rays.len(), std::sync::atomic::Ordering::Relaxed);
                progress.set(done as f64 / total as f64);
                (hits, blocked)
            });
            let chunks: Vec<_> = chunks.collect();
            for (hits, blocked) in chunks {
                answers.hits[kind as usize].extend(hits);
                answers.blocked.extend(blocked);
            }
        }
    });
    progress.check()?;
    Ok(answers)
}

/// Builds a tree without splits. Its traversal tests every object.
///
/// # Errors
/// Too many objects, or cancellation.
pub fn unsplit(scene: &Scene, progress: &Progress) -> Result<Tree, BuildError> {
    let settings = BuildSettings::for_method(Method::named("none")?);
    build(scene, &settings, progress)
}

/// Traces one ray in `f64`.
pub fn ask(scene: &Scene, tree: &Tree, kind: RayKind, ray: &Ray) -> Answer {
    let (shapes, progress) = (scene.shapes(Precision::F64), Progress::new());
    let mut tracer = ScalarKernel::new(tree, shapes, &progress);
    let batch = Batch {
        kind,
        rays: std::slice::from_ref(ray),
        pixels: &[],
    };
    if kind == RayKind::Shadow {
        let mut blocked = Vec::new();
        tracer.any_hits(batch, &mut blocked);
        Answer::Blocked(blocked[0])
    } else {
        let mut hits = Vec::new();
        tracer.closest_hits(batch, &mut hits);
        Answer::Nearest(hits[0])
    }
}

/// Samples rays as [`sample_rays`] does, and compares the tree's answers with those of testing
/// every object. Calls `so_far` with the intermediate result after every few rays.
///
/// # Errors
/// The same as those of [`sample_rays`].
pub fn verify_sample(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    per_kind: usize,
    pool: &rayon::ThreadPool,
    progress: &Progress,
    mut so_far: impl FnMut(&Verification),
) -> Result<Verification, RenderError> {
    const AT_ONCE: usize = 64;
    let sample = sample_rays(scene, tree, settings, per_kind, pool, progress)?;
    let precision = settings.precision_for(scene).precision;
    // A scene that has a tree also has a tree without splits. Only cancellation prevents building
    // it.
    let everything = unsplit(scene, progress).map_err(|_| Cancelled)?;
    let mut result = Verification::default();
    let most = sample.rays.iter().map(Vec::len).max().unwrap_or(0);
    for from in (0..most).step_by(AT_ONCE) {
        let part = RaySample {
            rays: sample.rays.each_ref().map(|rays| {
                let to = rays.len().min(from + AT_ONCE);
                rays[from.min(to)..to].to_vec()
            }),
        };
        let expected = answer(scene, &everything, precision, &part, pool, progress)?;
        let found = answer(scene, tree, precision, &part, pool, progress)?;
        result += compare(scene, &part, &expected, &found, None);
        progress.set((from + AT_ONCE) as f64 / most as f64);
        so_far(&result);
    }
    Ok(result)
}

/// Compares answers with those of testing every object, bit for bit: distance and object of every
/// hit. Exact arithmetic decides why they differ. `rounding` is the precision to which coordinates
/// may have been rounded; `None` as in [`settle`].
pub fn compare(
    scene: &Scene,
    sample: &RaySample,
    expected: &Answers,
    found: &Answers,
    rounding: Option<Precision>,
) -> Verification {
    let mut result = Verification::default();
    for kind in RayKind::ALL {
        let k = kind as usize;
        for (i, ray) in sample.rays[k].iter().enumerate() {
            result.rays[k] += 1;
            let answers = [expected, found].map(|answers| answers.of(kind, i));
            if answers[0] == answers[1] {
                continue;
            }
            let tolerance = rounding.map(|p| Tolerance::of(p, scale_of(scene, ray)));
            let verdict = settle(scene, ray, answers, tolerance);
            result.others[k].add(verdict);
            let Verdict::Fault {
                a_is_wrong,
                b_is_wrong,
            } = verdict
            else {
                continue;
            };
            result.every_object_wrong += u64::from(a_is_wrong);
            result.tree_wrong += u64::from(b_is_wrong);
            if result.faults.len() < EXAMPLES {
                result.faults.push((kind, *ray));
            }
        }
    }
    result
}
