//! One case by one method with one kernel, and what cases have in common.

use crate::geometry::Ray;
use crate::measure::judge::{Answer, Standing, Tolerance, Verdict, examine, scale_of, settle};
use crate::measure::unsplit;
use crate::primitive::Precision;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::split::Structure;
use crate::structure::{BuildError, BuildSettings, MaxDepth, Method, Tree, build, validate};
use crate::trace::{Batch, RayKind, RayTracer, ScalarKernel, objects_fit_f32};
use serde::Serialize;

/// What came of a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "outcome")]
pub enum Outcome {
    /// All is right; so many rays were asked about. 0 where the case asks about none.
    Pass { rays: u64 },
    /// Something is wrong.
    Fail { reason: String },
    /// The numbers of this precision cannot hold what the case is about.
    NotRepresentable { reason: String },
}

impl Outcome {
    pub fn fail(reason: impl Into<String>) -> Self {
        Outcome::Fail {
            reason: reason.into(),
        }
    }

    /// Passes without a ray if `right`, else fails with the reason.
    pub fn check(right: bool, reason: impl FnOnce() -> String) -> Self {
        if right {
            Outcome::Pass { rays: 0 }
        } else {
            Outcome::fail(reason())
        }
    }

    /// The first that did not pass, or all rays together.
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

    /// The same, with what was tried before the reason.
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

/// What answers questions about rays.
pub struct Kernel {
    pub precision: Precision,
    /// The answers for rays of one kind.
    pub ask: fn(&Scene, &Tree, RayKind, &[Ray], &Progress) -> Vec<Answer>,
}

/// All kernels, one a precision.
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

/// The kernel that pictures are traced with.
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

/// One case by one method with one kernel.
#[derive(Clone, Copy)]
pub struct Trial<'a> {
    /// The user's own scene; `None` for the built-in ones.
    pub scene: Option<&'a Scene>,
    pub method: Method,
    pub kernel: &'a Kernel,
    /// Few rays and small pictures.
    pub quick: bool,
    pub progress: &'a Progress,
}

impl Trial<'_> {
    /// How many rays to try on a scene: fewer where testing every object takes long.
    pub fn rays(&self, scene: &Scene) -> usize {
        let most = if self.quick { 100 } else { 4000 };
        let affordable = 100_000_000 / scene.objects().len().max(1);
        affordable.clamp(50, most)
    }

    /// The method's default settings.
    pub fn settings(&self) -> BuildSettings {
        BuildSettings::for_method(self.method)
    }

    /// Builds a tree and sees whether it is valid.
    pub fn tree(&self, scene: &Scene, settings: &BuildSettings) -> Result<Tree, Outcome> {
        let tree = build(scene, settings, self.progress)
            .map_err(|error| Outcome::fail(error.to_string()))?;
        validate(scene, &tree).map_err(|error| Outcome::fail(error.to_string()))?;
        Ok(tree)
    }

    /// What a tree says of rays.
    pub fn ask(&self, scene: &Scene, tree: &Tree, kind: RayKind, rays: &[Ray]) -> Vec<Answer> {
        (self.kernel.ask)(scene, tree, kind, rays, self.progress)
    }

    /// How far off the numbers of a ray in a scene may be.
    fn tolerance(&self, scene: &Scene, ray: &Ray) -> Tolerance {
        Tolerance::of(self.kernel.precision, scale_of(scene, ray))
    }

    /// Whether the method's tree is right about rays; see [`super`].
    pub fn check(&self, scene: &Scene, settings: &BuildSettings, rays: &[Ray]) -> Outcome {
        match self.tree(scene, settings) {
            Ok(tree) => self.check_tree(scene, &tree, rays),
            Err(outcome) => outcome,
        }
    }

    /// The same for a scene that may take too much memory: where the tree would pass 256 MiB, the
    /// error must say so, and a tree of at most 8 levels, or a grid of few voxels, be right.
    pub fn check_bounded(&self, scene: &Scene, rays: &[Ray]) -> Outcome {
        let settings = BuildSettings {
            memory_limit: 256 << 20,
            ..self.settings()
        };
        match build(scene, &settings, self.progress) {
            Ok(tree) => self.check_tree(scene, &tree, rays),
            Err(BuildError::MemoryLimit { .. }) => {
                let mut small = settings;
                match self.method.structure {
                    Structure::Bintree | Structure::Octree => small.d_max = MaxDepth::Fixed(8),
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

    /// The same for a tree that is there.
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
        // Shadow rays end: before, on or beyond what they meet.
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
        Outcome::all(
            [(RayKind::Primary, rays), (RayKind::Shadow, &shadows)].map(|(kind, rays)| {
                let expected = self.ask(scene, &everything, kind, rays);
                let found = self.ask(scene, tree, kind, rays);
                self.hold(scene, rays, &expected, &found)
            }),
        )
    }

    /// Holds answers against each other, and some of them against exact arithmetic.
    fn hold(&self, scene: &Scene, rays: &[Ray], expected: &[Answer], found: &[Answer]) -> Outcome {
        // Fractions are slow: fewer rays where there are many objects.
        let examined = (500_000 / scene.objects().len().max(1)).clamp(20, 500);
        let every = rays.len().div_ceil(examined).max(1);
        for (i, ray) in rays.iter().enumerate() {
            let tolerance = self.tolerance(scene, ray);
            let (expected, found) = (expected[i], found[i]);
            if expected != found {
                let verdict = settle(scene, ray, [expected, found], None);
                if matches!(verdict, Verdict::Fault { .. }) {
                    return Outcome::fail(format!(
                        "testing every object says {expected:?}, the tree {found:?} of {ray:?}"
                    ));
                }
            }
            if i % every == 0 && examine(scene, ray, found, tolerance) == Standing::Wrong {
                return Outcome::fail(format!("{found:?} is wrong of {ray:?}"));
            }
        }
        Outcome::Pass {
            rays: rays.len() as u64,
        }
    }
}
