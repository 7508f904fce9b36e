//! Our own kernels.

use super::kernels::{Found, Kernel, Rays};
use bspscope::primitive::{Precision, Shapes};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::structure::SimdTree;
use bspscope::structure::{BuildSettings, MaxDepth, Method, Nodes, Tree, build as build_tree};
use bspscope::trace::{
    Batch, Hit, InstructionSet, RayKind, RayTracer, ScalarKernel, SimdKernel, SimdMode,
};

/// A tree that some of our kernels are fast with: its name, its method, and settings of the method.
pub struct Choice {
    pub name: &'static str,
    method: &'static str,
    constants: &'static [(&'static str, f64)],
    /// Whether SIMD kernels trace it; otherwise the scalar one does.
    pub is_simd: bool,
}

/// The trees of all our kernels. The first is that of the scalar kernel which the answers of all are compared
/// with.
pub const CHOICES: [Choice; 4] = [
    Choice {
        name: "kd",
        method: "sah-auto",
        constants: &[],
        is_simd: false,
    },
    Choice {
        name: "bvh",
        method: "bvh-binned",
        constants: &[("max-leaf", 4.0)],
        is_simd: false,
    },
    Choice {
        name: "kd",
        method: "sah",
        constants: &[],
        is_simd: true,
    },
    Choice {
        name: "bvh",
        method: "bvh-binned",
        constants: &[("width", 8.0), ("block", 8.0)],
        is_simd: true,
    },
];

impl Choice {
    /// Describes the tree.
    pub fn describe(&self) -> String {
        let kernel = if self.is_simd { "SIMD" } else { "scalar" };
        let constants = self.constants.iter();
        let constants: String = constants.map(|(name, x)| format!(" {name}={x}")).collect();
        format!(
            "{} for {kernel} kernels: {}{constants}",
            self.name, self.method
        )
    }
}

/// Builds a tree on one thread, as the others do.
pub fn build(scene: &Scene, choice: &Choice) -> Tree {
    let constants = choice.constants.iter();
    let settings = BuildSettings {
        d_max: if choice.is_simd {
            MaxDepth::Fixed(MaxDepth::LIMIT)
        } else {
            MaxDepth::Automatic
        },
        constants: constants
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect(),
        ..BuildSettings::for_method(Method::named(choice.method).expect("a method"))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let build = || build_tree(scene, &settings, &Progress::new());
    pool.expect("a thread").install(build).expect("a tree")
}

/// Returns all kernels on a tree; of scalar ones the first is that in `f64`.
pub fn kernels<'a>(
    choice: &Choice,
    scene: &'a Scene,
    tree: &'a Tree,
) -> Vec<(String, Box<dyn Kernel + 'a>)> {
    let mut kernels: Vec<(String, Box<dyn Kernel + 'a>)> = Vec::new();
    for precision in [Precision::F64, Precision::F32] {
        let shapes = scene.shapes(precision);
        if !choice.is_simd {
            let progress = Progress::new();
            let name = format!("{} scalar {}", choice.name, precision.name());
            let scalar = Scalar {
                tree,
                shapes,
                progress,
            };
            kernels.push((name, Box::new(scalar)));
            continue;
        }
        for instructions in InstructionSet::ALL
            .into_iter()
            .filter(|set| set.is_available())
        {
            let modes = match tree.nodes() {
                Nodes::Planes(_) => &SimdMode::ALL[..],
                Nodes::Boxes(_) => &[SimdMode::Stream],
            };
            for &mode in modes {
                let kernel = Simd {
                    tree,
                    simd_tree: SimdTree::of(scene, tree),
                    shapes,
                    instructions,
                    mode,
                };
                let [mode, set] = [mode.name(), instructions.name()];
                let name = format!("{} {mode} {set} {}", choice.name, precision.name());
                kernels.push((name, Box::new(kernel)));
            }
        }
    }
    kernels
}

struct Simd<'a> {
    tree: &'a Tree,
    simd_tree: &'a SimdTree,
    shapes: &'a Shapes,
    instructions: InstructionSet,
    mode: SimdMode,
}

impl Simd<'_> {
    fn kernel(&self) -> SimdKernel<'_> {
        SimdKernel::new(
            self.tree,
            self.simd_tree,
            self.shapes,
            self.instructions,
            self.mode,
        )
    }
}

/// Rays per call: a few tiles of an image.
const CALL: usize = 8192;

impl Kernel for Simd<'_> {
    fn closest(&self, rays: Rays<'_>, answers: &mut Vec<Found>) {
        let (mut kernel, mut hits) = (self.kernel(), Vec::new());
        for rays in rays.wide.chunks(CALL) {
            hits.resize(rays.len(), Hit::MISS);
            kernel.closest_hits(rays, &mut hits);
            answers.extend(found(&hits));
        }
    }

    fn any(&self, rays: Rays<'_>, answers: &mut Vec<bool>) {
        let (mut kernel, mut blocked) = (self.kernel(), Vec::new());
        for rays in rays.wide.chunks(CALL) {
            blocked.resize(rays.len(), false);
            kernel.any_hits(rays, &mut blocked);
            answers.extend(&blocked);
        }
    }
}

struct Scalar<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: Progress,
}

fn found(hits: &[Hit]) -> impl Iterator<Item = Found> {
    hits.iter()
        .map(|hit| hit.is_hit().then_some((hit.t, hit.object)))
}

impl Kernel for Scalar<'_> {
    fn closest(&self, rays: Rays<'_>, answers: &mut Vec<Found>) {
        let mut hits = Vec::new();
        let batch = Batch {
            kind: RayKind::Primary,
            rays: rays.wide,
            pixels: &[],
        };
        ScalarKernel::new(self.tree, self.shapes, &self.progress).closest_hits(batch, &mut hits);
        answers.extend(found(&hits));
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        let batch = Batch {
            kind: RayKind::Shadow,
            rays: rays.wide,
            pixels: &[],
        };
        ScalarKernel::new(self.tree, self.shapes, &self.progress).any_hits(batch, blocked);
    }
}
