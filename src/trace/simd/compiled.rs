//! The SIMD kernels compiled for each instruction set.

use super::arithmetic::portable::Portable;
#[cfg(target_arch = "x86_64")]
use super::arithmetic::{avx2::Avx2, avx512::Avx512};
use super::block::Block;
use super::candidate::{Candidate, ExactTests};
use super::instruction_set::InstructionSet;
use super::packet::{self, Coherence, PendingNode};
use super::pool::{self, Pool};
use super::queue::RayQueue;
use super::ray::RayBuffer;
use super::stream::{self, Stacks};
use crate::structure::simd_tree::{BoxTree, PlaneTree};
use std::ops::Range;

/// Defines the kernels for an instruction set, as functions that are compiled for it as a whole.
#[cfg(target_arch = "x86_64")]
macro_rules! compiled {
    ($features:literal, $refill:ident, $stream:ident, $packets:ident, $pool:ident, $simd:ty, $groups:literal) => {
        /// # Safety
        /// The processor must have the instruction set.
        #[target_feature(enable = $features)]
        unsafe fn $refill(
            queue: &mut RayQueue<'_>,
            rays: &mut RayBuffer,
            chunk: usize,
            tests: &mut dyn ExactTests,
        ) {
            // SAFETY: the caller's.
            unsafe { queue.refill::<$simd>(rays, chunk, tests) }
        }

        /// # Safety
        /// The processor must have the instruction set.
        #[target_feature(enable = $features)]
        unsafe fn $stream<B: Block>(
            tree: &PlaneTree<B>,
            rays: &mut RayBuffer,
            ahead: Range<usize>,
            queue: &mut RayQueue<'_>,
            stacks: &mut Stacks,
            candidates: &mut Vec<Candidate>,
            tests: &mut dyn ExactTests,
        ) {
            // SAFETY: the caller's.
            unsafe {
                stream::traverse::<$simd, B, $groups>(
                    tree, rays, ahead, queue, stacks, candidates, tests,
                )
            }
        }

        /// # Safety
        /// The processor must have the instruction set.
        #[target_feature(enable = $features)]
        unsafe fn $packets<B: Block>(
            tree: &PlaneTree<B>,
            rays: &RayBuffer,
            ahead: Range<usize>,
            queue: &mut RayQueue<'_>,
            stack: &mut Vec<PendingNode>,
            tests: &mut dyn ExactTests,
        ) -> Coherence {
            // SAFETY: the caller's.
            unsafe { packet::traverse::<$simd, B>(tree, rays, ahead, queue, stack, tests) }
        }

        /// # Safety
        /// The processor must have the instruction set.
        #[target_feature(enable = $features)]
        #[allow(clippy::too_many_arguments)]
        unsafe fn $pool<B: Block>(
            tree: &BoxTree<B>,
            rays: &mut RayBuffer,
            ahead: Range<usize>,
            queue: &mut RayQueue<'_>,
            pool: &mut Pool,
            candidates: &mut Vec<Candidate>,
            tests: &mut dyn ExactTests,
        ) {
            // SAFETY: the caller's.
            unsafe {
                pool::traverse::<$simd, Avx2, B>(tree, rays, ahead, queue, pool, candidates, tests)
            }
        }
    };
}
#[cfg(target_arch = "x86_64")]
compiled!(
    "avx2,avx512f,avx512dq,avx512vl,avx512bw,fma,bmi1,popcnt",
    refill_avx512,
    stream_avx512,
    packets_avx512,
    pool_avx512,
    Avx512,
    5
);
#[cfg(target_arch = "x86_64")]
compiled!(
    "avx2,fma,bmi1,popcnt",
    refill_avx2,
    stream_avx2,
    packets_avx2,
    pool_avx2,
    Avx2,
    4
);

/// Calls [`RayQueue::refill`].
///
/// # Safety
/// The processor must have the instruction set.
pub(super) unsafe fn refill(
    set: InstructionSet,
    queue: &mut RayQueue<'_>,
    rays: &mut RayBuffer,
    chunk: usize,
    tests: &mut dyn ExactTests,
) {
    // SAFETY: the caller's.
    unsafe {
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => refill_avx512(queue, rays, chunk, tests),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => refill_avx2(queue, rays, chunk, tests),
            _ => queue.refill::<Portable>(rays, chunk, tests),
        }
    }
}

/// Calls [`stream::traverse`].
///
/// # Safety
/// The processor must have the instruction set.
#[allow(clippy::too_many_arguments)]
pub(super) unsafe fn stream<B: Block>(
    set: InstructionSet,
    tree: &PlaneTree<B>,
    rays: &mut RayBuffer,
    ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    stacks: &mut Stacks,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    // SAFETY: the caller's.
    unsafe {
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => {
                stream_avx512(tree, rays, ahead, queue, stacks, candidates, tests);
            }
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => {
                stream_avx2(tree, rays, ahead, queue, stacks, candidates, tests);
            }
            _ => stream::traverse::<Portable, _, 2>(
                tree, rays, ahead, queue, stacks, candidates, tests,
            ),
        }
    }
}

/// Calls [`packet::traverse`].
///
/// # Safety
/// The processor must have the instruction set.
pub(super) unsafe fn packets<B: Block>(
    set: InstructionSet,
    tree: &PlaneTree<B>,
    rays: &RayBuffer,
    ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    stack: &mut Vec<PendingNode>,
    tests: &mut dyn ExactTests,
) -> Coherence {
    // SAFETY: the caller's.
    unsafe {
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => packets_avx512(tree, rays, ahead, queue, stack, tests),
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => packets_avx2(tree, rays, ahead, queue, stack, tests),
            _ => packet::traverse::<Portable, _>(tree, rays, ahead, queue, stack, tests),
        }
    }
}

/// Calls [`pool::traverse`].
///
/// # Safety
/// The processor must have the instruction set.
#[allow(clippy::too_many_arguments)]
pub(super) unsafe fn pool<B: Block>(
    set: InstructionSet,
    tree: &BoxTree<B>,
    rays: &mut RayBuffer,
    ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    pool: &mut Pool,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    // SAFETY: the caller's.
    unsafe {
        match set {
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => {
                pool_avx512(tree, rays, ahead, queue, pool, candidates, tests);
            }
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => {
                pool_avx2(tree, rays, ahead, queue, pool, candidates, tests);
            }
            _ => pool::traverse::<Portable, Portable, _>(
                tree, rays, ahead, queue, pool, candidates, tests,
            ),
        }
    }
}
