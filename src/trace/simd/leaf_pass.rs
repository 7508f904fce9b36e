//! The tests of the leaves that rays have reached.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::Simd;
use super::block::Block;
use super::candidate::{Candidate, ExactTests};
use super::leaves::{Leaf, Leaves};
use super::prefetch::prefetch;
use super::ray::RayBuffer;
use std::hint::select_unpredictable;

/// The objects of a block that the ray in a lane may hit.
#[derive(Clone, Copy, Default)]
struct Match {
    /// Index of the ray's limit.
    lane: u32,
    /// The ray's slot.
    ray: u32,
    block: u32,
    /// Mask of the objects.
    possible: u32,
}

/// Tests the leaves of a queue until it is empty: one block of every leaf, then the next block of those that
/// have more. Hits lower the limits of their rays.
///
/// `slot` returns the slot of the ray in a lane.
///
/// # Safety
/// As [`Simd`]; leaves and lanes exist, and `candidates` has room for a block's objects per leaf.
#[inline(always)]
pub(super) unsafe fn test_leaves<S: Simd, B: Block, const N: usize>(
    leaves: &mut Leaves<N>,
    blocks: &[B],
    rays: &RayBuffer,
    slot: impl Fn(usize) -> u32,
    limits: &mut [f32],
    candidates: &mut [Candidate],
    tests: &mut dyn ExactTests,
) {
    let any_hit = tests.any_hit_suffices();
    let mut matches = [Match::default(); N];
    let mut certain = [0_u32; N];
    while leaves.len() > 0 {
        let (mut matched, mut certain_count, mut remaining) = (0, 0, 0);
        for k in 0..leaves.len() {
            let leaf = leaves.get(k);
            let ray = slot(leaf.lane as usize);
            let block = blocks.get_unchecked(leaf.block as usize);
            let limit = limits.get_unchecked_mut(leaf.lane as usize);
            // Branchless: whether the leaf has another block is unpredictable.
            let next = leaf.block as usize + usize::from(leaf.left > 1);
            prefetch(blocks.as_ptr().add(next));
            let masks = block.candidates::<S>(rays, ray as usize, *limit, any_hit);
            let is_certain = masks.certain != 0;
            // Branchless, by storing always and counting where it holds: a branch depends on the
            // test of the block, and mispredicted it discards the work on all blocks behind it.
            *certain.get_unchecked_mut(certain_count) = ray;
            *limit = select_unpredictable(is_certain, -1.0, *limit);
            certain_count += usize::from(is_certain);
            *matches.get_unchecked_mut(matched) = Match {
                lane: leaf.lane,
                ray,
                block: leaf.block,
                possible: masks.possible,
            };
            matched += usize::from((masks.possible != 0) & !is_certain);
            let rest = Leaf {
                block: leaf.block + 1,
                left: leaf.left - 1,
                ..leaf
            };
            leaves.set(remaining, rest);
            remaining += usize::from((rest.left > 0) & !is_certain);
        }
        if certain_count > 0 {
            tests.mark_hit(rays, &certain[..certain_count]);
        }
        let found = list_candidates(&matches[..matched], blocks, candidates);
        if found > 0 {
            tests.test(rays, &candidates[..found], limits);
        }
        leaves.truncate(remaining);
    }
}

/// Lists the candidates of matches and returns their number.
///
/// # Safety
/// There is room for them, and every match has one.
#[inline(always)]
unsafe fn list_candidates<B: Block>(
    matches: &[Match],
    blocks: &[B],
    candidates: &mut [Candidate],
) -> usize {
    let mut found = 0;
    for &Match {
        lane,
        ray,
        block,
        mut possible,
    } in matches
    {
        let objects = blocks.get_unchecked(block as usize).objects();
        loop {
            let place = possible.trailing_zeros() % B::PLACES as u32;
            *candidates.get_unchecked_mut(found) = Candidate {
                lane,
                ray,
                block,
                place,
                object: *objects.get_unchecked(place as usize),
            };
            found += 1;
            possible &= possible.wrapping_sub(1);
            if possible == 0 {
                break;
            }
        }
    }
    found
}
