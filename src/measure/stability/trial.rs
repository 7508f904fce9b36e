//! One run of a case with one method and one kernel, and the checks that cases share.

use crate::geometry::Ray;
use crate::measure::exact::{ExactKernel, Oracle};
use crate::measure::judge::Answer;
use crate::measure::unsplit;
use crate::primitive::Precision;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::split::Structure;
use crate::structure::{BuildSettings, MaxDepth, Method, Tree, build, validate};
use crate::trace::{Batch, RayKind, RayTracer, ScalarKernel, objects_fit_f32};
use serde::Serialize;

/// The result of a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "outcome")]
pub enum Outcome {
    /// Everything is correct. `rays` is the number of rays checked; 0 if the case uses none.
    Pass { rays: u64 },
    /// Something is wrong.
    Fail { reason: String },
    /// This precision cannot represent the objects or rays of the case.
    NotRepresentable { reason: String },
}

impl Outcome {
    pub fn fail(reason: impl Into<String>) -> Self {
        Outcome::Fail {
            reason: reason.into(),
        }
    }

    /// Returns a pass without rays if `right`, otherwise a failure with the reason.
    pub fn check(right: bool, reason: impl FnOnce() -> String) -> Self {
        if right {
            Outcome::Pass { rays: 0 }
        } else {
            Outcome::fail(reason())
        }
    }

    /// Returns the first outcome that is not a pass, or a pass with the sum of all rays.
    pub fn all(outcomes: impl IntoIterator<Item = Outcome>) -> Outcome {
        let mut sum = 0;
        for outcome in outcomes {
            match outcome {
                Outcome::Pass { rays } => sum += rays,
                other => return other,
            }
        }
        Outcome::Pass { rays: sum }
    }

    /// Returns a failure if there is one, otherwise a pass with the sum of all rays. If the precision can
    /// represent none of them, returns the first reason.
    pub fn all_representable(outcomes: impl IntoIterator<Item = Outcome>) -> Outcome {
        let (mut sum, mut not_representable, mut any_pass) = (0, None, false);
        for outcome in outcomes {
            match outcome {
                Outcome::Pass { rays } => {
                    any_pass = true;
                    sum += rays;
                }
                Outcome::NotRepresentable { .. } => {
                    not_representable = not_representable.or(Some(outcome));
                }
                Outcome::Fail { .. } => return outcome,
            }
        }
        not_representable
            .filter(|_| !any_pass)
            .unwrap_or(Outcome::Pass { rays: sum })
    }

    /// Prefixes the reason of an outcome with what was tested.
    pub fn of(self, what: &str) -> Outcome {
        match self {
            Outcome::Fail { reason } => Outcome::fail(format!("{what}: {reason}")),
            Outcome::NotRepresentable { reason } => Outcome::NotRepresentable {
                reason: format!("{what}: {reason}"),
            },
            pass => pass,
        }
    }
}

/// A kernel that answers questions about rays.
pub struct Kernel {
    pub precision: Precision,
    /// Returns the answers for rays of one kind.
    pub ask: fn(&Scene, &Tree, RayKind, &[Ray], &Progress) -> Vec<Answer>,
}

/// All kernels, one per precision.
pub static KERNELS: &[Kernel] = &[
    Kernel {
        precision: Precision::F64,
        ask: |scene, tree, kind, rays, progress| {
            timed(Precision::F64, scene, tree, kind, rays, progress)
        },
    },
    Kernel {
        precision: Precision::F32,
        ask: |scene, tree, kind, rays, progress| {
            timed(Precision::F32, scene, tree, kind, rays, progress)
        },
    },
];

/// Answers with the kernel that renders pictures.
fn timed(
    precision: Precision,
    scene: &Scene,
    tree: &Tree,
    kind: RayKind,
    rays: &[Ray],
    progress: &Progress,
) -> Vec<Answer> {
    let mut tracer = ScalarKernel::new(tree, scene.shapes(precision), progress);
    let batch = Batch {
        kind,
        rays,
        pixels: &[],
    };
    if kind == RayKind::Shadow {
        let mut blocked = Vec::new();
        tracer.any_hits(batch, &mut blocked);
        blocked.into_iter().map(Answer::Blocked).collect()
    } else {
        let mut hits = Vec::new();
        tracer.closest_hits(batch, &mut hits);
        hits.into_iter().map(Answer::Nearest).collect()
    }
}

/// One run of a case with one method and one kernel.
#[derive(Clone, Copy)]
pub struct Trial<'a> {
    /// The user's own scene; `None` for the built-in scenes.
    pub scene: Option<&'a Scene>,
    pub method: Method,
    pub kernel: &'a Kernel,
    /// Whether to use few rays and small pictures.
    pub quick: bool,
    pub progress: &'a Progress,
}

impl Trial<'_> {
    /// Returns how many rays to trace in a scene. Large scenes get fewer rays because testing every
    /// object is slow.
    pub fn rays(&self, scene: &Scene) -> usize {
        let most = if self.quick { 100 } else { 4000 };
        let affordable = 100_000_000 / scene.objects().len().max(1);
        affordable.clamp(50, most)
    }

    /// Returns the method's default settings.
    pub fn settings(&self) -> BuildSettings {
        BuildSettings::for_method(self.method)
    }

    /// Builds a tree and validates it.
    pub fn tree(&self, scene: &Scene, settings: &BuildSettings) -> Result<Tree, Outcome> {
        let tree = build(scene, settings, self.progress)
            .map_err(|error| Outcome::fail(error.to_string()))?;
        validate(scene, &tree).map_err(|error| Outcome::fail(error.to_string()))?;
        Ok(tree)
    }

    /// Returns a tree's answers for rays of one kind.
    pub fn ask(&self, scene: &Scene, tree: &Tree, kind: RayKind, rays: &[Ray]) -> Vec<Answer> {
        (self.kernel.ask)(scene, tree, kind, rays, self.progress)
    }

    /// Checks the method's tree with rays, as [`super`] defines correct.
    pub fn check(&self, scene: &Scene, settings: &BuildSettings, rays: &[Ray]) -> Outcome {
        match self.tree(scene, settings) {
            Ok(tree) => self.check_tree(scene, &tree, rays),
            Err(outcome) => outcome,
        }
    }

    /// Does the same for a scene whose tree may need too much memory. Above 256 MiB, the build must
    /// fail with a memory error. Then a tree of at most 8 levels, or a grid of few voxels, must be
    /// correct.
    pub fn check_bounded(&self, scene: &Scene, rays: &[Ray]) -> Outcome {
        let settings = BuildSettings {
            memory_limit: 256 << 20,
            ..self.settings()
        };
        match build(scene, &settings, self.progress) {
            Ok(tree) => self.check_tree(scene, &tree, rays),
            Err(error) if error.is_too_large() => {
                let mut small = settings;
                match self.method.structure {
                    Structure::Bintree | Structure::Octree | Structure::Bvh => {
                        small.d_max = MaxDepth::Fixed(8);
                    }
                    Structure::Grid => {
                        let lowest = self
                            .method
                            .constants
                            .iter()
                            .map(|c| (c.name.into(), c.lowest));
                        small.constants.extend(lowest);
                    }
                }
                self.check(scene, &small, rays)
            }
            Err(error) => Outcome::fail(error.to_string()),
        }
    }

    /// Does the same for an existing tree.
    pub fn check_tree(&self, scene: &Scene, tree: &Tree, rays: &[Ray]) -> Outcome {
        if self.kernel.precision == Precision::F32
            && let Err(reason) = objects_fit_f32(scene)
        {
            return Outcome::NotRepresentable {
                reason: reason.to_string(),
            };
        }
        let everything = match unsplit(scene, self.progress) {
            Ok(tree) => tree,
            Err(error) => return Outcome::fail(error.to_string()),
        };
        // Shadow rays end before, at, or beyond the nearest hit.
        let nearest = self.ask(scene, &everything, RayKind::Primary, rays);
        let ends = [0.5, 1.0, 2.0];
        let shadows: Vec<Ray> = rays
            .iter()
            .zip(&nearest)
            .enumerate()
            .map(|(i, (ray, answer))| {
                let t_max = match answer {
                    Answer::Nearest(hit) => hit.t * ends[i % ends.len()],
                    Answer::Blocked(_) => f64::INFINITY,
                };
                Ray { t_max, ..*ray }
            })
            .collect();
        let oracle = Oracle::new(scene, self.kernel.precision);
        Outcome::all(
            [(RayKind::Primary, rays), (RayKind::Shadow, &shadows)].map(|(kind, rays)| {
                let expected = self.ask(scene, &everything, kind, rays);
                let found = self.ask(scene, tree, kind, rays);
                self.compare_kernels(scene, tree, rays, &expected)
                    .unwrap_or_else(|| self.compare(&oracle, scene, rays, &expected, &found))
            }),
        )
    }

    /// Compares answers with those of testing every object, and some of them with exact arithmetic.
    fn compare(
        &self,
        oracle: &Oracle,
        scene: &Scene,
        rays: &[Ray],
        expected: &[Answer],
        found: &[Answer],
    ) -> Outcome {
        // Exact arithmetic is slow, so scenes with many objects check fewer rays.
        let most = if self.quick { 20 } else { 500 };
        let examined = (500_000 / scene.objects().len().max(1)).clamp(20, most);
        let every = rays.len().div_ceil(examined).max(1);
        for (i, ray) in rays.iter().enumerate() {
            let (expected, found) = (expected[i], found[i]);
            if expected != found {
                return Outcome::fail(format!(
                    "testing every object says {expected:?}, the tree {found:?} of {ray:?}"
                ));
            }
            if i % every == 0 {
                let right = found.of_kind(oracle.closest(ray));
                if found != right {
                    return Outcome::fail(format!(
                        "exact arithmetic says {right:?}, the tree {found:?} of {ray:?}"
                    ));
                }
            }
        }
        Outcome::Pass {
            rays: rays.len() as u64,
        }
    }

    /// Compares answers of all kernels with those of testing every object; returns the first that differs.
    fn compare_kernels(
        &self,
        scene: &Scene,
        tree: &Tree,
        rays: &[Ray],
        expected: &[Answer],
    ) -> Option<Outcome> {
        // Rays at the limits of rounding take exact arithmetic, in each of these kernels.
        if self.quick {
            return None;
        }
        let every = rays
            .len()
            .div_ceil(if self.quick { 16 } else { 256 })
            .max(1);
        let some: Vec<Ray> = rays.iter().step_by(every).copied().collect();
        let expected: Vec<Answer> = expected.iter().step_by(every).copied().collect();
        let precision = self.kernel.precision;
        ExactKernel::all().into_iter().find_map(|kernel| {
            let (hits, blocked) = kernel.answers(scene, tree, precision, &some, self.progress);
            let wrong = (0..some.len()).find(|&i| {
                let found = expected[i].of_kind(hits[i]);
                found != expected[i] || blocked[i] != expected[i].is_hit()
            })?;
            let (kernel, ray, expected) = (kernel.name(), some[wrong], expected[wrong]);
            let found = (hits[wrong], blocked[wrong]);
            Some(Outcome::fail(format!(
                "testing every object says {expected:?}, the kernel {kernel} {found:?} of {ray:?}"
            )))
        })
    }
}
