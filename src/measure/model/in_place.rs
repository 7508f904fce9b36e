//! Direct measurement of the same times. Recorded tests are repeated, separately by kind and
//! result. Rays traverse the tree without any tests.

use super::equation::Term;
use super::observe::each_ray;
use crate::geometry::Ray;
use crate::measure::MeasureError;
use crate::primitive::{PrimitiveKind, Shape};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{BuildSettings, build};
use crate::trace::{RayKind, RenderSettings, render_counted, thread_pool};
use cpu_time::ThreadTime;
use std::hint::black_box;

/// Times in seconds, measured in place. Arrays are indexed by [`PrimitiveKind`]. `None` if nothing
/// of the kind occurred.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InPlace {
    /// Time per traversed node, `T_T + T_P`: `T_TT / N_NODES`.
    pub node: Option<f64>,
    /// Time per test that hits, `T_I`.
    pub hit: [Option<f64>; PrimitiveKind::ALL.len()],
    /// Time per test that misses, `T_IUN`.
    pub miss: [Option<f64>; PrimitiveKind::ALL.len()],
}

impl InPlace {
    /// Returns the time of a term. `None` if the term did not occur, and for box tests and the
    /// constant, which are not measured.
    pub fn seconds(&self, term: Term) -> Option<f64> {
        match term {
            Term::Node => self.node,
            Term::Hit(kind) => self.hit[kind as usize],
            Term::Miss(kind) => self.miss[kind as usize],
            Term::Box | Term::Constant => None,
        }
    }
}

/// A recorded test, to be repeated.
struct Test {
    ray: Ray,
    object: u32,
    t_max: f64,
}

/// Number of tests kept per kind and result. They fit into the processor's caches, as the tests of
/// a leaf do.
const KEPT: usize = 4096;
/// One test in this many is kept, so that the kept tests come from the whole picture.
const EVERY: usize = 17;
/// Number of repetitions of the kept tests. The minimum time counts.
const ROUNDS: u32 = 30;

/// Measures the times of a scene with one tree.
///
/// # Errors
/// The same as those of [`crate::measure::measure`].
pub fn time_in_place(
    scene: &Scene,
    settings: &BuildSettings,
    render: &RenderSettings,
    progress: &Progress,
) -> Result<InPlace, MeasureError> {
    let tree = build(scene, settings, progress)?;
    let pool = thread_pool(render.threads)?;
    let counted = render_counted(scene, &tree, render, &pool, progress, |_| ())?;
    let nodes: u64 = counted
        .tallies
        .iter()
        .map(|t| t.inner_nodes + t.leaves)
        .sum();
    let mut times = InPlace {
        node: (nodes > 0).then(|| counted.traversal.as_secs_f64() / nodes as f64),
        ..InPlace::default()
    };
    let kinds = PrimitiveKind::ALL.len();
    let mut kept: Vec<Vec<Test>> = (0..2 * kinds).map(|_| Vec::new()).collect();
    let mut seen = vec![0usize; 2 * kinds];
    each_ray(scene, &tree, render, progress, |traced, watcher| {
        let mut t_max = traced.ray.t_max;
        for &(object, hit) in &watcher.tests {
            let kind = scene.objects()[object as usize].kind() as usize;
            let place = 2 * kind + usize::from(hit.is_some());
            seen[place] += 1;
            if seen[place].is_multiple_of(EVERY) && kept[place].len() < KEPT {
                kept[place].push(Test {
                    ray: *traced.ray,
                    object,
                    t_max,
                });
            }
            if let Some(t) = hit.filter(|_| traced.kind != RayKind::Shadow) {
                t_max = t_max.min(t);
            }
        }
    })?;
    for kind in 0..kinds {
        times.miss[kind] = time(scene, &kept[2 * kind]);
        times.hit[kind] = time(scene, &kept[2 * kind + 1]);
        progress.check().map_err(crate::trace::RenderError::from)?;
    }
    Ok(times)
}

/// Returns the time per test in seconds; `None` without tests.
fn time(scene: &Scene, tests: &[Test]) -> Option<f64> {
    let round = || {
        let start = ThreadTime::now();
        for test in tests {
            let object = &scene.objects()[test.object as usize];
            black_box(object.intersect(black_box(&test.ray), test.t_max));
        }
        start.elapsed().as_secs_f64()
    };
    let least = (0..ROUNDS).map(|_| round()).fold(f64::INFINITY, f64::min);
    (!tests.is_empty()).then(|| least / tests.len() as f64)
}
