//! Whether a tree gives the same hits as testing every object, on rays of every kind.

use crate::geometry::Ray;
use crate::primitive::Precision;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::trace::{
    Batch, Hit, RayKind, RayTracer, RenderError, RenderSettings, Shading, Timed, tiles,
    trace_samples,
};
use crate::tree::{BuildError, BuildSettings, Method, Tree, build};
use rayon::prelude::*;

/// Rays that a picture of the scene takes, by [`RayKind`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RaySample {
    pub rays: [Vec<Ray>; 4],
}

/// What testing every object says of a [`RaySample`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answers {
    /// By [`RayKind`]; empty for shadow rays.
    hits: [Vec<Hit>; 4],
    blocked: Vec<bool>,
}

/// What a comparison of a tree with the judge found, by [`RayKind`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verification {
    /// Rays compared.
    pub rays: [u64; 4],
    /// Rays with another answer.
    pub wrong: [u64; 4],
    /// The first few of these.
    pub examples: Vec<(RayKind, Ray)>,
}

impl Verification {
    pub fn passed(&self) -> bool {
        self.wrong.iter().all(|&wrong| wrong == 0)
    }
}

/// Keeps the rays that the renderer asks about.
struct Recorder<'a> {
    tracer: Timed<'a>,
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

/// At least `per_kind` rays of every kind that a picture of the scene takes, evenly from all over
/// it; pictures are traced with more and more samples until there are enough, 64 at most. A kind
/// that the scene does not take stays empty.
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
                        tracer: Timed::new(tree, shading.shapes, progress),
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

/// Asks a tree about every ray of a sample, in a precision.
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
                let mut tracer = Timed::new(tree, shapes, progress);
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

/// The tree without a split: testing every object.
///
/// # Errors
/// Too many objects, or cancellation.
pub fn judge(scene: &Scene, progress: &Progress) -> Result<Tree, BuildError> {
    let settings = BuildSettings::for_method(Method::named("none")?);
    build(scene, &settings, progress)
}

/// Holds answers against the judge's, bit by bit: distance and object of every hit.
pub fn compare(sample: &RaySample, expected: &Answers, found: &Answers) -> Verification {
    const EXAMPLES: usize = 5;
    let mut result = Verification::default();
    for kind in RayKind::ALL {
        let k = kind as usize;
        for (i, ray) in sample.rays[k].iter().enumerate() {
            let same = if kind == RayKind::Shadow {
                expected.blocked.get(i) == found.blocked.get(i)
            } else {
                expected.hits[k].get(i) == found.hits[k].get(i)
            };
            result.rays[k] += 1;
            if !same {
                result.wrong[k] += 1;
                if result.examples.len() < EXAMPLES {
                    result.examples.push((kind, *ray));
                }
            }
        }
    }
    result
}
