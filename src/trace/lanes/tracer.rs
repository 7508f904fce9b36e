//! The kernel that a pass is timed with, and its choice.

use super::{InstructionSet, LaneKernel, LaneTree, RayCompany};
use crate::geometry::Ray;
use crate::primitive::Shapes;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{Batch, Hit, RayTracer, Timed};
use serde::{Deserialize, Serialize};

/// The timed kernel asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KernelChoice {
    /// One ray after the other, through exactly the nodes that are counted: the paper's method.
    #[default]
    Plain,
    /// Batches of rays in the lanes of vectors, in the widest instructions that the processor has.
    Lanes,
    /// The same instructions for packets: rays that lie side by side in a batch walk together.
    Packets,
    /// Packets where rays keep together, else lanes; plain on processors without a path of their own.
    Auto,
}

impl KernelChoice {
    pub const ALL: [KernelChoice; 4] = [
        KernelChoice::Plain,
        KernelChoice::Lanes,
        KernelChoice::Packets,
        KernelChoice::Auto,
    ];

    /// `plain`, `lanes`, `packets` or `auto`.
    pub const fn name(self) -> &'static str {
        ["plain", "lanes", "packets", "auto"][self as usize]
    }

    /// The choice of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|choice| choice.name() == name)
    }

    /// How rays go in vectors on this processor, and in which instructions; `None` for the plain kernel.
    pub fn in_vectors(self) -> Option<(RayCompany, InstructionSet)> {
        let best = InstructionSet::best();
        match self {
            KernelChoice::Plain => None,
            KernelChoice::Lanes => Some((RayCompany::Lanes, best)),
            KernelChoice::Packets => Some((RayCompany::Packets, best)),
            KernelChoice::Auto => {
                Some((RayCompany::Auto, best)).filter(|_| best != InstructionSet::Portable)
            }
        }
    }

    /// The kernel that times are of, as reports have it.
    pub fn used(self) -> String {
        match self.in_vectors() {
            None => "plain".into(),
            Some((company, set)) => format!("{}, {}", company.name(), set.name()),
        }
    }
}

/// Below this, lanes stand idle too long (`cargo bench --bench peers`): the plain kernel is as fast.
const FEWEST_RAYS: usize = 64;

/// Rays that are traced between two looks at whether the task was cancelled: about a millisecond.
const RAYS_PER_LOOK: usize = 4096;

/// The kernel whose time counts.
pub struct TimedKernel<'a> {
    plain: Timed<'a>,
    lanes: Option<LaneKernel<'a>>,
    progress: &'a Progress,
}

impl<'a> TimedKernel<'a> {
    /// The kernel of this choice; `shapes` are the scene's, and the tree is of it. The first that uses
    /// lanes makes the tree ready for them.
    pub fn new(
        choice: KernelChoice,
        scene: &Scene,
        tree: &'a Tree,
        shapes: &'a Shapes,
        progress: &'a Progress,
    ) -> Self {
        let lanes = choice.in_vectors().map(|(company, instructions)| {
            let lanes = LaneTree::of(scene, tree);
            LaneKernel::new(tree, lanes, shapes, instructions, company)
        });
        TimedKernel {
            plain: Timed::new(tree, shapes, progress),
            lanes,
            progress,
        }
    }

    /// Asks the lanes about a batch, a stretch after the other; `false` where the plain kernel is to.
    fn in_lanes<A: Copy>(
        &mut self,
        rays: &[Ray],
        miss: A,
        answers: &mut Vec<A>,
        ask: impl Fn(&mut LaneKernel<'a>, &[Ray], &mut [A]),
    ) -> bool {
        let Some(kernel) = self.lanes.as_mut().filter(|_| rays.len() >= FEWEST_RAYS) else {
            return false;
        };
        answers.clear();
        answers.resize(rays.len(), miss);
        let stretches = rays
            .chunks(RAYS_PER_LOOK)
            .zip(answers.chunks_mut(RAYS_PER_LOOK));
        for (rays, answers) in stretches {
            if self.progress.is_cancelled() {
                break;
            }
            ask(kernel, rays, answers);
        }
        true
    }
}

impl RayTracer for TimedKernel<'_> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        if !self.in_lanes(batch.rays, Hit::MISS, hits, LaneKernel::closest_hits) {
            self.plain.closest_hits(batch, hits);
        }
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        if !self.in_lanes(batch.rays, false, blocked, LaneKernel::any_hits) {
            self.plain.any_hits(batch, blocked);
        }
    }
}
