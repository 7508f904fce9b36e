//! Our own kernels.

use super::kernels::{Found, Kernel, Rays};
use bspscope::primitive::{Precision, Shapes};
use bspscope::progress::Progress;
use bspscope::scene::Scene;
use bspscope::trace::{Batch, Hit, RayKind, RayTracer, Timed};
use bspscope::tree::{BuildSettings, MaxDepth, Method, Tree, build as build_tree};

/// The tree that all our kernels walk.
pub fn build(scene: &Scene) -> Tree {
    let settings = BuildSettings {
        d_max: MaxDepth::Fixed(MaxDepth::LIMIT),
        ..BuildSettings::for_method(Method::named("sah").expect("a method"))
    };
    build_tree(scene, &settings, &Progress::new()).expect("a tree")
}

/// All kernels; the first is the plain one in `f64`.
pub fn kernels<'a>(scene: &'a Scene, tree: &'a Tree) -> Vec<(String, Box<dyn Kernel + 'a>)> {
    let plain = Plain {
        tree,
        shapes: scene.shapes(Precision::F64),
        progress: Progress::new(),
    };
    vec![("plain f64".into(), Box::new(plain))]
}

struct Plain<'a> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    progress: Progress,
}

fn found(hits: &[Hit]) -> impl Iterator<Item = Found> {
    hits.iter()
        .map(|hit| hit.is_hit().then_some((hit.t, hit.object)))
}

impl Kernel for Plain<'_> {
    fn closest(&self, rays: Rays<'_>, answers: &mut Vec<Found>) {
        let mut hits = Vec::new();
        let batch = Batch {
            kind: RayKind::Primary,
            rays: rays.wide,
            pixels: &[],
        };
        Timed::new(self.tree, self.shapes, &self.progress).closest_hits(batch, &mut hits);
        answers.extend(found(&hits));
    }

    fn any(&self, rays: Rays<'_>, blocked: &mut Vec<bool>) {
        let batch = Batch {
            kind: RayKind::Shadow,
            rays: rays.wide,
            pixels: &[],
        };
        Timed::new(self.tree, self.shapes, &self.progress).any_hits(batch, blocked);
    }
}
