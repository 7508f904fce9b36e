//! Batches of rays in the lanes of vectors, each lane its own ray: the kernels for speed. The rays go
//! through the tree each on its own ([`walk`]) or in packets ([`packet`]).
//!
//! They walk the same tree as the plain kernel, any method's, in a form made once a tree, and give the
//! same hits, ray for ray and bit for bit. For that, nothing of it needs to be exact but the tests
//! themselves, which are the plain kernel's. All before them only decides what is certain, in `f32` and
//! with room for what that rounds, in either precision: planes are as thick as rounding may move rays
//! and objects ([`prepare`]), and blocks of 16 objects are held against a ray at once, or an object
//! against a packet ([`block`]). What is left, one or two objects a ray, gets the exact test.
//!
//! Rays of one call keep each other company: of fewer than about 500 lanes stand idle, and thousands are
//! better still.

mod block;
mod crossings;
mod exact;
mod leaves;
mod packet;
mod pages;
mod prepare;
mod ray;
mod simd;
mod stacks;
mod supply;
mod tracer;
mod walk;

use super::{Hit, Scratch, any_hit, closest_hit};
use crate::geometry::Ray;
use crate::primitive::{PrimitiveKind, Shapes, UnitFrame, with_array};
use crate::scene::Scene;
use crate::structure::Tree;
use block::{Boxes, Spheres, Triangles};
use exact::{Any, Closest, InArray, InF32, InF64, InSpheres, InTriangles, Objects, RayPrecision};
use packet::{Aside, walk_packets};
use prepare::Prepared;
use ray::{LaneRays, PARTS, Root};
use simd::portable::Portable;
use stacks::Stacks;
use std::ops::Range;
use supply::{Supply, end_all};
pub use tracer::{KernelChoice, TimedKernel};
use walk::{Candidate, Tests, walk};

/// Three values by number. Unlike `array::map` it is never a call, which would pass arrays through
/// memory in pieces of other sizes than they are read in; processors wait then.
#[inline(always)]
fn three<T>(value: impl Fn(usize) -> T) -> [T; 3] {
    [value(0), value(1), value(2)]
}

/// What the kernel is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// Sixteen lanes.
    Avx512,
    /// Eight lanes.
    Avx2,
    /// Eight lanes in plain Rust.
    Portable,
}

impl InstructionSet {
    pub const ALL: [InstructionSet; 3] = [
        InstructionSet::Avx512,
        InstructionSet::Avx2,
        InstructionSet::Portable,
    ];

    /// As reports have it.
    pub const fn name(self) -> &'static str {
        ["AVX-512", "AVX2", "portable"][self as usize]
    }

    /// Rays that a vector holds.
    fn lanes(self) -> usize {
        [16, 8, 8][self as usize]
    }

    /// Whether this processor has it.
    pub fn is_available(self) -> bool {
        match self {
            InstructionSet::Portable => true,
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => {
                is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("bmi1")
                    && is_x86_feature_detected!("popcnt")
                    && is_x86_feature_detected!("fma")
            }
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => {
                is_x86_feature_detected!("avx2")
                    && is_x86_feature_detected!("bmi1")
                    && is_x86_feature_detected!("popcnt")
                    && is_x86_feature_detected!("fma")
            }
            #[cfg(not(target_arch = "x86_64"))]
            _ => false,
        }
    }

    /// The widest that this processor has.
    pub fn best() -> InstructionSet {
        let here = InstructionSet::ALL
            .into_iter()
            .find(|set| set.is_available());
        here.unwrap_or(InstructionSet::Portable)
    }
}

/// A tree made ready for lanes. It holds for one scene and either precision.
pub struct SimdTree {
    frame: UnitFrame,
    prepared: AnyPrepared,
}

enum AnyPrepared {
    Triangles(Prepared<Triangles>),
    Spheres(Prepared<Spheres>),
    Boxes(Prepared<Boxes>),
}

impl SimdTree {
    /// The tree of this scene ready for lanes: made when first asked for, then kept with the tree.
    pub fn of<'a>(scene: &Scene, tree: &'a Tree) -> &'a SimdTree {
        tree.derived(|| SimdTree::new(scene, tree))
    }

    /// # Panics
    /// If the tree has more nodes than the form for lanes can hold, 2²⁸: 2 GiB of them.
    fn new(scene: &Scene, tree: &Tree) -> SimdTree {
        let objects = scene.objects();
        let frame = UnitFrame::around(&scene.bounds());
        let all = |kind| !objects.is_empty() && objects.iter().all(|o| o.kind() == kind);
        let prepared = if all(PrimitiveKind::Triangle) {
            AnyPrepared::Triangles(Prepared::new(tree, objects, &frame))
        } else if all(PrimitiveKind::Sphere) {
            AnyPrepared::Spheres(Prepared::new(tree, objects, &frame))
        } else {
            AnyPrepared::Boxes(Prepared::new(tree, objects, &frame))
        };
        SimdTree { frame, prepared }
    }
}

/// Runs `$body` with `$prepared` bound to the tree there is, compiled once for every kind of block.
macro_rules! with_prepared {
    ($tree:expr, $prepared:ident => $body:expr) => {
        match &$tree.prepared {
            AnyPrepared::Triangles($prepared) => $body,
            AnyPrepared::Spheres($prepared) => $body,
            AnyPrepared::Boxes($prepared) => $body,
        }
    };
}

/// Runs `$body` with `$objects` bound to where exact tests find the objects, compiled once for every
/// form and precision.
macro_rules! with_objects {
    ($kernel:expr, $objects:ident => $body:expr) => {
        match (&$kernel.lanes.prepared, $kernel.shapes) {
            (AnyPrepared::Triangles(p), Shapes::F32 { .. }) => {
                let $objects = InTriangles::new(&p.blocks, $kernel.instructions);
                $body
            }
            (AnyPrepared::Spheres(p), Shapes::F32 { .. }) => {
                let $objects = InSpheres(&p.blocks);
                $body
            }
            (_, Shapes::F32 { arrays, .. }) => with_array!(arrays, all => {
                let $objects = InArray::<InF32, _>::new(all);
                $body
            }),
            (_, Shapes::F64(arrays)) => with_array!(arrays, all => {
                let $objects = InArray::<InF64, _>::new(all);
                $body
            }),
        }
    };
}

/// Answers batches of rays; one a thread.
pub struct SimdKernel<'a> {
    tree: &'a Tree,
    lanes: &'a SimdTree,
    shapes: &'a Shapes,
    instructions: InstructionSet,
    rays: Box<LaneRays>,
    mode: SimdMode,
    /// Whether rays of this call go in packets; `None` until that was tried.
    in_packets: Option<bool>,
    stacks: Stacks,
    asides: Vec<Aside>,
    candidates: Vec<Candidate>,
    scratch: Scratch,
}

/// Rays of a call that tell whether packets are worth their while for the others: neighbours in it are
/// alike. A few packets, which in lanes would be faster by at most half.
const SAMPLE: usize = 64;

/// How the rays of a call traverse the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdMode {
    /// Every ray traverses the tree on its own, in a lane that takes the next ray when it is done.
    Stream,
    /// Neighboring rays, one per lane, traverse the tree together.
    Packets,
    /// Packets as long as the rays of a call are coherent, then a stream.
    Auto,
}

impl SimdMode {
    pub const ALL: [SimdMode; 3] = [SimdMode::Stream, SimdMode::Packets, SimdMode::Auto];

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        ["stream", "packets", "stream and packets"][self as usize]
    }

    /// Whether it is packets; `None` where that must be tried.
    fn in_packets(self) -> Option<bool> {
        match self {
            SimdMode::Stream => Some(false),
            SimdMode::Packets => Some(true),
            SimdMode::Auto => None,
        }
    }
}

impl<'a> SimdKernel<'a> {
    /// A kernel for this instruction set; `lanes` is of this tree and `shapes` of its scene.
    ///
    /// # Panics
    /// If the processor does not have the instructions.
    pub fn new(
        tree: &'a Tree,
        lanes: &'a SimdTree,
        shapes: &'a Shapes,
        instructions: InstructionSet,
        mode: SimdMode,
    ) -> Self {
        assert!(
            instructions.is_available(),
            "no {} here",
            instructions.name()
        );
        SimdKernel {
            tree,
            lanes,
            shapes,
            instructions,
            rays: LaneRays::new(),
            mode,
            in_packets: None,
            stacks: Stacks::default(),
            asides: Vec::new(),
            candidates: Vec::new(),
            scratch: Scratch::default(),
        }
    }

    /// The nearest hit of every ray; of equal distances the lower object number. `hits` has a place
    /// for every ray, which is overwritten.
    ///
    /// # Panics
    /// If it has not.
    pub fn closest_hits(&mut self, rays: &[Ray], hits: &mut [Hit]) {
        assert_eq!(rays.len(), hits.len());
        with_objects!(self, objects => self.closest_of(objects, rays, hits));
    }

    /// Whether anything lies on every ray before its end. `blocked` likewise.
    ///
    /// # Panics
    /// Likewise.
    pub fn any_hits(&mut self, rays: &[Ray], blocked: &mut [bool]) {
        assert_eq!(rays.len(), blocked.len());
        with_objects!(self, objects => self.any_of(objects, rays, blocked));
    }

    fn closest_of<O: Objects>(&mut self, objects: O, rays: &[Ray], hits: &mut [Hit]) {
        self.walk::<O::RayPrecision>(rays, &mut Closest::new(objects, rays, hits));
        for &i in &self.rays.others {
            let (i, scratch) = (i as usize, &mut self.scratch);
            hits[i] = closest_hit(self.tree, self.shapes, &rays[i], scratch, &mut ());
        }
    }

    fn any_of<O: Objects>(&mut self, objects: O, rays: &[Ray], blocked: &mut [bool]) {
        self.walk::<O::RayPrecision>(rays, &mut Any::new(objects, rays, blocked));
        for &i in &self.rays.others {
            let (i, scratch) = (i as usize, &mut self.scratch);
            blocked[i] = any_hit(self.tree, self.shapes, &rays[i], scratch, &mut ());
        }
    }

    /// Answers all rays but [`LaneRays::others`], in packets as long as those are chosen and then in lanes.
    fn walk<N: RayPrecision>(&mut self, rays: &[Ray], tests: &mut dyn Tests) {
        let lanes = self.lanes;
        let (thick, corners) = with_prepared!(lanes, tree => (tree.thick, &tree.corners));
        let root = Root {
            frame: &lanes.frame,
            thick,
            corners,
            forward_only: N::FORWARD_ONLY,
        };
        let mut supply = Supply::new(root, rays);
        self.rays.others.clear();
        self.in_packets = self.mode.in_packets();
        while !supply.is_empty() {
            let parts = if self.in_packets == Some(true) {
                PARTS
            } else {
                1
            };
            self.rays.starts.count = 0;
            for part in 0..parts {
                self.refill(&mut supply, part, tests);
            }
            let mut ahead = 0..self.rays.starts.count;
            if self.in_packets.is_none() && !self.are_alike() {
                self.in_packets = Some(false);
            }
            if self.in_packets.is_none() {
                let first = ahead.end.min(SAMPLE);
                self.walk_packets(0..first, &mut supply, tests);
                ahead.start = first;
            }
            if self.in_packets == Some(true) {
                self.walk_packets(ahead, &mut supply, tests);
            } else {
                self.walk_lanes(ahead, &mut supply, tests);
            }
            end_all(&mut self.rays, tests);
        }
    }

    /// Makes rays ready in a part.
    fn refill(&mut self, supply: &mut Supply<'_>, part: usize, tests: &mut dyn Tests) {
        let rays = &mut self.rays;
        // SAFETY: a kernel is only made for instructions that the processor has.
        unsafe {
            match self.instructions {
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx512 => refill_avx512(supply, rays, part, tests),
                #[cfg(target_arch = "x86_64")]
                InstructionSet::Avx2 => refill_avx2(supply, rays, part, tests),
                _ => supply.refill::<Portable>(rays, part, tests),
            }
        }
    }

    /// Whether most neighbours among the first rays go much the same way, within 30°: packets of
    /// others are not worth trying.
    fn are_alike(&self) -> bool {
        let starts = &self.rays.starts;
        let first = &starts.ray[..starts.count.min(SAMPLE)];
        let direction = |ray: u32| glam::Vec3::from(self.rays.rays[ray as usize].direction);
        let alike = first.windows(2).filter(|pair| {
            let (a, b) = (direction(pair[0]), direction(pair[1]));
            let along = a.dot(b);
            along > 0.0 && along * along > 0.75 * a.length_squared() * b.length_squared()
        });
        2 * alike.count() >= first.len()
    }

    /// Walks rays in lanes, first those made ready.
    fn walk_lanes(&mut self, ahead: Range<usize>, supply: &mut Supply<'_>, tests: &mut dyn Tests) {
        let (rays, stacks) = (&mut *self.rays, &mut self.stacks);
        let found = &mut self.candidates;
        with_prepared!(self.lanes, tree => {
            // SAFETY: a kernel is only made for instructions that the processor has.
            unsafe {
                match self.instructions {
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => walk_avx512(tree, rays, ahead, supply, stacks, found, tests),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => walk_avx2(tree, rays, ahead, supply, stacks, found, tests),
                    _ => walk::<Portable, _, 2>(tree, rays, ahead, supply, stacks, found, tests),
                }
            }
        });
    }

    /// Walks rays in packets, and chooses how those after them go where that is to be chosen.
    fn walk_packets(
        &mut self,
        ahead: Range<usize>,
        supply: &mut Supply<'_>,
        tests: &mut dyn Tests,
    ) {
        let (rays, stack) = (&*self.rays, &mut self.asides);
        let together = with_prepared!(self.lanes, tree => {
            // SAFETY: as above.
            unsafe {
                match self.instructions {
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx512 => packets_avx512(tree, rays, ahead, supply, stack, tests),
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => packets_avx2(tree, rays, ahead, supply, stack, tests),
                    _ => walk_packets::<Portable, _>(tree, rays, ahead, supply, stack, tests),
                }
            }
        });
        if self.mode == SimdMode::Auto {
            // In plain Rust packets of rays that are alike are always the faster (`benches/README.md`).
            let portable = self.instructions == InstructionSet::Portable;
            self.in_packets = Some(portable || together.is_close(self.instructions.lanes()));
        }
    }
}

impl SimdTree {
    /// Bytes that nodes and blocks take.
    pub fn bytes(&self) -> usize {
        with_prepared!(self, prepared => prepared.bytes())
    }
}

/// The kernel compiled for an instruction set, all of it in functions of that set.
#[cfg(target_arch = "x86_64")]
macro_rules! compiled {
    ($features:literal, $refill:ident, $walk:ident, $packets:ident, $simd:ty, $groups:literal) => {
        /// # Safety
        /// The processor has these instructions.
        #[target_feature(enable = $features)]
        unsafe fn $refill(
            supply: &mut Supply<'_>,
            rays: &mut LaneRays,
            part: usize,
            tests: &mut dyn Tests,
        ) {
            // SAFETY: the caller's.
            unsafe { supply.refill::<$simd>(rays, part, tests) }
        }

        /// # Safety
        /// The processor has these instructions.
        #[target_feature(enable = $features)]
        unsafe fn $walk<B: block::Block>(
            tree: &Prepared<B>,
            rays: &mut LaneRays,
            ahead: Range<usize>,
            supply: &mut Supply<'_>,
            stacks: &mut Stacks,
            candidates: &mut Vec<Candidate>,
            tests: &mut dyn Tests,
        ) {
            // SAFETY: the caller's.
            unsafe {
                walk::<$simd, B, $groups>(tree, rays, ahead, supply, stacks, candidates, tests)
            }
        }

        /// # Safety
        /// The processor has these instructions.
        #[target_feature(enable = $features)]
        unsafe fn $packets<B: block::Block>(
            tree: &Prepared<B>,
            rays: &LaneRays,
            ahead: Range<usize>,
            supply: &mut Supply<'_>,
            stack: &mut Vec<Aside>,
            tests: &mut dyn Tests,
        ) -> packet::Company {
            // SAFETY: the caller's.
            unsafe { walk_packets::<$simd, B>(tree, rays, ahead, supply, stack, tests) }
        }
    };
}
#[cfg(target_arch = "x86_64")]
compiled!(
    "avx512f,avx512dq,avx512vl,avx512bw,fma,bmi1,popcnt",
    refill_avx512,
    walk_avx512,
    packets_avx512,
    simd::avx512::Avx512,
    5
);
#[cfg(target_arch = "x86_64")]
compiled!(
    "avx2,fma,bmi1,popcnt",
    refill_avx2,
    walk_avx2,
    packets_avx2,
    simd::avx2::Avx2,
    4
);
