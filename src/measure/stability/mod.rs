//! Stability: robustness at extreme inputs. Every case of [`CASES`] must yield correct hits, or a
//! clear error, with every method and precision. A case is one entry of a theme's file.
//!
//! Correct means three things. The tree is valid. The answers of all kernels equal those of testing every
//! object, bit for bit. A sample of the answers equals those of exact arithmetic, bit for bit
//! ([`super::exact::Oracle`]).

mod case;
mod geometry;
#[cfg(test)]
mod mutants;
mod rays;
mod scales;
mod scenes;
mod settings;
mod transforms;
mod trial;

pub use case::Case;
pub use trial::{KERNELS, Kernel, Outcome, Trial};

use crate::primitive::Precision;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::Method;
use rayon::prelude::*;
use serde::Serialize;

/// All cases by theme.
pub static CASES: &[(&str, &[Case])] = &[
    ("transforms", transforms::CASES),
    ("scales", scales::CASES),
    ("rays", rays::CASES),
    ("geometry", geometry::CASES),
    ("settings", settings::CASES),
];

/// The result of one case with one method in one precision.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    pub theme: &'static str,
    pub case: &'static str,
    pub rule: &'static str,
    pub method: &'static str,
    pub precision: Precision,
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Runs every applicable case with every method in every precision, in the order of the registries.
/// Without a scene, runs the built-in torture set. With a scene, runs the cases that apply to any
/// scene.
///
/// # Errors
/// Cancellation.
pub fn run(
    scene: Option<&Scene>,
    methods: &[Method],
    quick: bool,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<Vec<Cell>, Cancelled> {
    let mut work = Vec::new();
    for &(theme, cases) in CASES {
        for case in cases.iter().filter(|c| scene.is_none() || c.any_scene) {
            for &method in methods {
                work.extend(KERNELS.iter().map(|kernel| (theme, case, method, kernel)));
            }
        }
    }
    let done = std::sync::atomic::AtomicUsize::new(0);
    let cell = |&(theme, case, method, kernel): &(
        &'static str,
        &'static Case,
        Method,
        &'static Kernel,
    )| {
        let trial = Trial {
            scene,
            method,
            kernel,
            quick,
            progress,
        };
        let run = std::panic::AssertUnwindSafe(|| (case.run)(&trial));
        let outcome = std::panic::catch_unwind(run)
            .unwrap_or_else(|_| Outcome::fail("the program panics, as reported above"));
        let done = 1 + done.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        progress.set(done as f64 / work.len() as f64);
        Cell {
            theme,
            case: case.name,
            rule: case.rule,
            method: method.name,
            precision: kernel.precision,
            outcome,
        }
    };
    let cells = pool.install(|| work.par_iter().with_max_len(1).map(cell).collect());
    progress.check()?;
    Ok(cells)
}
