//! Comparison of every structure and kernel with the oracle.

use super::kernel::ExactKernel;
use super::oracle::Oracle;
use super::rays::{ExactRays, RaySource};
use crate::geometry::Ray;
use crate::measure::judge::Answer;
use crate::measure::unsplit;
use crate::measure::verify::sample_rays;
use crate::primitive::Precision;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::{BuildError, Tree};
use crate::trace::{Hit, RenderError, RenderSettings};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Rays of one call of a kernel. SIMD kernels need many to fill their lanes.
const CHUNK: usize = 2048;

/// The result for one scene.
#[derive(Clone, Debug)]
pub struct ExactCheck {
    /// Number of rays per source and precision.
    pub rays: Vec<(RaySource, u64)>,
    /// Number of rays with a hit, in both precisions together.
    pub hits: u64,
    /// For each structure, precision and kernel, in this order. Testing every object is the first structure.
    pub faults: Vec<ExactFaults>,
    /// Time of the oracle.
    pub deciding: Duration,
    /// Time of all kernels.
    pub tracing: Duration,
}

/// The wrong answers of one kernel with one structure.
#[derive(Clone, Debug)]
pub struct ExactFaults {
    /// Name of the structure's method; `None` for testing every object.
    pub method: Option<&'static str>,
    pub precision: Precision,
    pub kernel: ExactKernel,
    /// Number of wrong closest hits.
    pub closest: u64,
    /// Number of wrong answers whether a ray is blocked.
    pub any: u64,
    /// The first wrong answer.
    pub first: Option<ExactFault>,
}

impl ExactFaults {
    pub fn count(&self) -> u64 {
        self.closest + self.any
    }
}

/// A wrong answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactFault {
    pub source: RaySource,
    pub ray: Ray,
    pub expected: Answer,
    pub found: Answer,
}

impl ExactCheck {
    /// Returns the number of rays in one precision.
    pub fn ray_count(&self) -> u64 {
        self.rays.iter().map(|(_, count)| count).sum()
    }

    /// Returns whether every answer is right.
    pub fn passed(&self) -> bool {
        self.faults.iter().all(|faults| faults.count() == 0)
    }
}

/// Why a check could not be completed.
#[derive(Clone, Debug, thiserror::Error)]
pub enum ExactError {
    #[error(transparent)]
    Build(#[from] BuildError),
    #[error(transparent)]
    Render(#[from] RenderError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The rays of one precision, with the right answers.
struct Decided {
    precision: Precision,
    rays: ExactRays,
    expected: Vec<Hit>,
}

/// Decides about `count` rays per precision, and compares the answers of all kernels with them: for testing
/// every object, and for `trees`, which must be those of the scene.
///
/// # Errors
/// A camera without a view, or cancellation.
pub fn check_exactly(
    scene: &Scene,
    trees: &[Tree],
    render: &RenderSettings,
    count: usize,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<ExactCheck, ExactError> {
    /// Fractions of the whole task at which the two oracles and the kernels are done.
    const STAGES: [f64; 4] = [0.0, 0.3, 0.6, 1.0];
    let everything = unsplit(scene, progress)?;
    let of_picture = count.div_ceil(RaySource::ALL.len()).div_ceil(4);
    let first = trees.first().unwrap_or(&everything);
    let sample = sample_rays(scene, first, render, of_picture, pool, progress)?;
    let start = Instant::now();
    let mut decided = Vec::new();
    for (i, precision) in [Precision::F64, Precision::F32].into_iter().enumerate() {
        let progress = progress.part(STAGES[i], STAGES[i + 1]);
        let oracle = Oracle::new(scene, precision);
        let rays = ExactRays::new(
            scene,
            &sample,
            count,
            &oracle,
            pool,
            &progress.part(0.0, 0.3),
        )?;
        let expected = oracle.closest_of_all(rays.rays(), pool, &progress.part(0.3, 1.0))?;
        decided.push(Decided {
            precision,
            rays,
            expected,
        });
    }
    let deciding = start.elapsed();
    let start = Instant::now();
    let progress = progress.part(STAGES[2], STAGES[3]);
    let (structures, kernels) = (1 + trees.len(), ExactKernel::all());
    let total = structures * decided.len() * kernels.len();
    let mut faults = Vec::new();
    for (s, tree) in std::iter::once(&everything).chain(trees).enumerate() {
        for part in &decided {
            for &kernel in &kernels {
                let examples = part.faults_of(scene, tree, kernel, pool, &progress);
                progress.check()?;
                let count = |is_any: bool| {
                    let is_any_hit = |f: &&ExactFault| matches!(f.found, Answer::Blocked(_));
                    examples.iter().filter(|f| is_any_hit(f) == is_any).count() as u64
                };
                faults.push(ExactFaults {
                    method: (s > 0).then(|| tree.settings().method.name),
                    precision: part.precision,
                    kernel,
                    closest: count(false),
                    any: count(true),
                    first: examples.first().copied(),
                });
                progress.set(faults.len() as f64 / total as f64);
            }
        }
    }
    Ok(ExactCheck {
        rays: decided[0].rays.counts(),
        hits: decided
            .iter()
            .flat_map(|part| &part.expected)
            .filter(|hit| hit.is_hit())
            .count() as u64,
        faults,
        deciding,
        tracing: start.elapsed(),
    })
}

impl Decided {
    /// Returns all wrong answers of a kernel.
    fn faults_of(
        &self,
        scene: &Scene,
        tree: &Tree,
        kernel: ExactKernel,
        pool: &rayon::ThreadPool,
        progress: &Progress,
    ) -> Vec<ExactFault> {
        let work = self.rays.rays().par_chunks(CHUNK).enumerate();
        let faults_of_chunk = |(chunk, rays): (usize, &[Ray])| {
            let (hits, blocked) = kernel.answers(scene, tree, self.precision, rays, progress);
            let mut faults = Vec::new();
            for (i, ray) in rays.iter().enumerate() {
                let expected = self.expected[chunk * CHUNK + i];
                let pairs = [
                    (Answer::Nearest(expected), Answer::Nearest(hits[i])),
                    (
                        Answer::Blocked(expected.is_hit()),
                        Answer::Blocked(blocked[i]),
                    ),
                ];
                let wrong = pairs
                    .into_iter()
                    .filter(|(expected, found)| expected != found);
                faults.extend(wrong.map(|(expected, found)| ExactFault {
                    source: self.rays.source(chunk * CHUNK + i),
                    ray: *ray,
                    expected,
                    found,
                }));
            }
            faults
        };
        let chunks: Vec<Vec<ExactFault>> = pool.install(|| work.map(faults_of_chunk).collect());
        chunks.concat()
    }
}
