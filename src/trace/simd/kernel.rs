//! The SIMD kernel: traces the rays of a call as packets while they are coherent, then as a stream.
//!
//! ```text
//! while rays are left:
//!     prepare a chunk of rays (of packets: all chunks)
//!     mode not decided: directions of the first rays differ -> stream
//!                       else trace a sample as packets; their coherence decides
//!     packets: trace all prepared rays
//!     stream:  trace all prepared rays and those of the queue
//! trace the rays that the unit frame cannot represent with the scalar kernel
//! ```

use super::candidate::{Candidate, ExactTests};
use super::compiled;
use super::exact::{
    Any, Closest, InArray, InF32, InF64, InSpheres, InTriangles, InWideTriangles, TestObjects,
    TestPrecision,
};
use super::instruction_set::InstructionSet;
use super::mode::SimdMode;
use super::packet::PendingNode;
use super::pool::Pool;
use super::queue::{RayQueue, end_all};
use super::ray::{CHUNKS, RayBuffer, RaySetup};
use super::stream::Stacks;
use crate::geometry::Ray;
use crate::primitive::{Arrays, Shapes, with_array};
use crate::structure::Tree;
use crate::structure::simd_tree::{AnyTree, ByKind, SimdTree, with_tree};
use crate::trace::{Hit, Scratch, any_hit, closest_hit};
use std::ops::Range;

/// Evaluates `$body` with `$objects` bound to the objects of exact tests, monomorphized for each form and
/// precision.
macro_rules! with_objects {
    ($kernel:expr, $objects:ident => $body:expr) => {
        match &$kernel.simd_tree.tree {
            AnyTree::Planes(by_kind) => with_objects!($kernel, by_kind, $objects => $body),
            AnyTree::Boxes(by_kind) => with_objects!($kernel, by_kind, $objects => $body),
        }
    };
    ($kernel:expr, $by_kind:ident, $objects:ident => $body:expr) => {
        match ($by_kind, $kernel.shapes) {
            (
                ByKind::Triangles(tree),
                Shapes::F32 {
                    arrays: Arrays::Triangles(all),
                    ..
                },
            ) => {
                let $objects = InTriangles::new(&tree.blocks, all, $kernel.instructions);
                $body
            }
            (
                ByKind::Spheres(tree),
                Shapes::F32 {
                    arrays: Arrays::Spheres(all),
                    ..
                },
            ) => {
                let $objects = InSpheres::new(&tree.blocks, all);
                $body
            }
            (_, Shapes::F32 { arrays, .. }) => with_array!(arrays, all => {
                let $objects = InArray::<InF32, _>::new(all);
                $body
            }),
            (_, Shapes::F64(Arrays::Triangles(all))) => {
                let $objects = InWideTriangles::new(all, $kernel.instructions);
                $body
            }
            (_, Shapes::F64(arrays)) => with_array!(arrays, all => {
                let $objects = InArray::<InF64, _>::new(all);
                $body
            }),
        }
    };
}

/// Answers batches of rays. Every thread has its own.
pub struct SimdKernel<'a> {
    tree: &'a Tree,
    simd_tree: &'a SimdTree,
    shapes: &'a Shapes,
    instructions: InstructionSet,
    rays: Box<RayBuffer>,
    mode: SimdMode,
    /// Whether the rays of this call are traced in packets; `None` while that is not decided.
    in_packets: Option<bool>,
    stacks: Stacks,
    pool: Pool,
    packet_stack: Vec<PendingNode>,
    candidates: Vec<Candidate>,
    scratch: Scratch,
}

/// Rays of a call by which [`SimdMode::Auto`] decides about packets: neighboring rays are alike. A few
/// packets, which a stream would trace faster by half at most.
const SAMPLE: usize = 64;

impl<'a> SimdKernel<'a> {
    /// Creates a kernel for an instruction set. `simd_tree` must be that of `tree`, and `shapes` those of
    /// its scene.
    ///
    /// # Panics
    /// If the processor does not have the instruction set.
    pub fn new(
        tree: &'a Tree,
        simd_tree: &'a SimdTree,
        shapes: &'a Shapes,
        instructions: InstructionSet,
        mode: SimdMode,
    ) -> Self {
        assert!(
            instructions.is_available(),
            "this processor has no {}",
            instructions.name()
        );
        SimdKernel {
            tree,
            simd_tree,
            shapes,
            instructions,
            rays: RayBuffer::new(),
            mode: mode.of(tree.settings().method.structure),
            in_packets: None,
            stacks: Stacks::default(),
            pool: Pool::default(),
            packet_stack: Vec::new(),
            candidates: Vec::new(),
            scratch: Scratch::default(),
        }
    }

    /// Finds the closest hit of every ray; of equal distances the lower object index. Overwrites `hits`.
    ///
    /// # Panics
    /// If `hits` is not as long as `rays`.
    pub fn closest_hits(&mut self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        with_objects!(self, objects => self.closest_of(objects, rays, hits));
    }

    /// Finds whether anything lies on each ray before its end. Overwrites `blocked`.
    ///
    /// # Panics
    /// If `blocked` is not as long as `rays`.
    pub fn any_hits(&mut self, rays: &[Ray], blocked: &mut [bool]) {
        assert_eq!(rays.len(), blocked.len());
        with_objects!(self, objects => self.any_of(objects, rays, blocked));
    }

    fn closest_of<O: TestObjects>(&mut self, objects: O, rays: &[Ray], hits: &mut [Hit]) {
        self.trace::<O::Precision>(rays, &mut Closest::new(objects, rays, hits));
        for &i in &self.rays.scalar_rays {
            let (i, scratch) = (i as usize, &mut self.scratch);
            hits[i] = closest_hit(self.tree, self.shapes, &rays[i], scratch, &mut ());
        }
    }

    fn any_of<O: TestObjects>(&mut self, objects: O, rays: &[Ray], blocked: &mut [bool]) {
        self.trace::<O::Precision>(rays, &mut Any::new(objects, rays, blocked));
        for &i in &self.rays.scalar_rays {
            let (i, scratch) = (i as usize, &mut self.scratch);
            blocked[i] = any_hit(self.tree, self.shapes, &rays[i], scratch, &mut ());
        }
    }

    /// Traces all rays except [`RayBuffer::scalar_rays`].
    fn trace<P: TestPrecision>(&mut self, rays: &[Ray], tests: &mut dyn ExactTests) {
        let simd_tree = self.simd_tree;
        let setup = RaySetup {
            frame: &simd_tree.frame,
            half_thickness: simd_tree.half_thickness,
            corners: &simd_tree.corners,
            forward_only: P::FORWARD_ONLY,
        };
        let mut queue = RayQueue::new(setup, rays);
        self.rays.scalar_rays.clear();
        self.in_packets = self.mode.uses_packets();
        while !queue.is_empty() {
            let chunks = if self.in_packets == Some(true) {
                CHUNKS
            } else {
                1
            };
            self.rays.entering.count = 0;
            for chunk in 0..chunks {
                // SAFETY: kernels are only created for instruction sets that the processor has.
                unsafe {
                    compiled::refill(self.instructions, &mut queue, &mut self.rays, chunk, tests);
                }
            }
            let mut ahead = 0..self.rays.entering.count;
            if self.in_packets.is_none() && !self.directions_are_similar() {
                self.in_packets = Some(false);
            }
            if self.in_packets.is_none() {
                let first = ahead.end.min(SAMPLE);
                self.trace_packets(0..first, &mut queue, tests);
                ahead.start = first;
            }
            if self.in_packets == Some(true) {
                self.trace_packets(ahead, &mut queue, tests);
            } else {
                self.trace_stream(ahead, &mut queue, tests);
            }
            end_all(&mut self.rays, tests);
        }
    }

    /// Returns whether at least half of the first rays are within 30° of their predecessor. Otherwise
    /// packets are not worth a trial.
    fn directions_are_similar(&self) -> bool {
        let entering = &self.rays.entering;
        let first = &entering.ray[..entering.count.min(SAMPLE)];
        let direction = |ray: u32| glam::Vec3::from(self.rays.rays[ray as usize].direction);
        let similar = first.windows(2).filter(|pair| {
            let (a, b) = (direction(pair[0]), direction(pair[1]));
            let along = a.dot(b);
            along > 0.0 && along * along > 0.75 * a.length_squared() * b.length_squared()
        });
        2 * similar.count() >= first.len()
    }

    /// Traces the entering rays in `ahead` and all rays of the queue as a stream.
    fn trace_stream(
        &mut self,
        ahead: Range<usize>,
        queue: &mut RayQueue<'_>,
        tests: &mut dyn ExactTests,
    ) {
        let (set, rays, stacks) = (self.instructions, &mut *self.rays, &mut self.stacks);
        let candidates = &mut self.candidates;
        let pool = &mut self.pool;
        match &self.simd_tree.tree {
            // SAFETY: as above.
            AnyTree::Planes(by_kind) => with_tree!(by_kind, tree => unsafe {
                compiled::stream(set, tree, rays, ahead, queue, stacks, candidates, tests);
            }),
            // SAFETY: as above.
            AnyTree::Boxes(by_kind) => with_tree!(by_kind, tree => unsafe {
                compiled::pool(set, tree, rays, ahead, queue, pool, candidates, tests);
            }),
        }
    }

    /// Traces the entering rays in `ahead` as packets. [`SimdMode::Auto`] decides by their coherence how
    /// the next rays are traced.
    fn trace_packets(
        &mut self,
        ahead: Range<usize>,
        queue: &mut RayQueue<'_>,
        tests: &mut dyn ExactTests,
    ) {
        let (set, rays, stack) = (self.instructions, &*self.rays, &mut self.packet_stack);
        let AnyTree::Planes(by_kind) = &self.simd_tree.tree else {
            unreachable!("hierarchies are traced as streams");
        };
        let coherence = with_tree!(by_kind, tree => {
            // SAFETY: as above.
            unsafe { compiled::packets(set, tree, rays, ahead, queue, stack, tests) }
        });
        if self.mode == SimdMode::Auto {
            // In portable Rust, packets of similar rays are always faster (`benches/README.md`).
            let portable = set == InstructionSet::Portable;
            self.in_packets = Some(portable || coherence.favors_packets(set.lanes()));
        }
    }
}
