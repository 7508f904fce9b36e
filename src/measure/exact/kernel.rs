//! The kernels that are checked.

use crate::geometry::Ray;
use crate::primitive::Precision;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{SimdTree, Tree};
use crate::trace::{
    Batch, CountingKernel, Hit, InstructionSet, RayKind, RayTracer, ScalarKernel, SimdKernel,
    SimdMode,
};

/// A kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExactKernel {
    Scalar,
    Counting,
    Simd(SimdMode, InstructionSet),
}

impl ExactKernel {
    /// Returns all kernels of this processor.
    pub fn all() -> Vec<ExactKernel> {
        let sets = InstructionSet::ALL
            .into_iter()
            .filter(|set| set.is_available());
        let simd = sets.flat_map(|set| {
            [SimdMode::Stream, SimdMode::Packets].map(|mode| ExactKernel::Simd(mode, set))
        });
        [ExactKernel::Scalar, ExactKernel::Counting]
            .into_iter()
            .chain(simd)
            .collect()
    }

    /// Returns the name, such as `stream, AVX2`.
    pub fn name(self) -> String {
        match self {
            ExactKernel::Scalar => "scalar".to_owned(),
            ExactKernel::Counting => "counting".to_owned(),
            ExactKernel::Simd(mode, set) => format!("{}, {}", mode.name(), set.name()),
        }
    }

    /// Returns the closest hit of every ray, and whether anything blocks it.
    pub fn answers(
        self,
        scene: &Scene,
        tree: &Tree,
        precision: Precision,
        rays: &[Ray],
        progress: &Progress,
    ) -> (Vec<Hit>, Vec<bool>) {
        let shapes = scene.shapes(precision);
        match self {
            ExactKernel::Scalar => ask(&mut ScalarKernel::new(tree, shapes, progress), rays),
            ExactKernel::Counting => ask(&mut CountingKernel::new(tree, shapes, progress, 1), rays),
            ExactKernel::Simd(mode, set) => {
                let simd_tree = SimdTree::of(scene, tree);
                let mut kernel = SimdKernel::new(tree, simd_tree, shapes, set, mode);
                let (mut hits, mut blocked) =
                    (vec![Hit::MISS; rays.len()], vec![false; rays.len()]);
                kernel.closest_hits(rays, &mut hits);
                kernel.any_hits(rays, &mut blocked);
                (hits, blocked)
            }
        }
    }
}

/// Asks a kernel both questions.
fn ask(kernel: &mut impl RayTracer, rays: &[Ray]) -> (Vec<Hit>, Vec<bool>) {
    let pixels = vec![0; rays.len()];
    let batch = |kind| Batch {
        kind,
        rays,
        pixels: &pixels,
    };
    let (mut hits, mut blocked) = (Vec::new(), Vec::new());
    kernel.closest_hits(batch(RayKind::Primary), &mut hits);
    kernel.any_hits(batch(RayKind::Shadow), &mut blocked);
    (hits, blocked)
}
