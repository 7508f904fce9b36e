//! The traversal of bounding volume hierarchies: a pool of rays, each with its own stack.
//!
//! The rays of the pool take one step each in turn, so that the nodes of all others are loaded while one
//! computes. A step tests the boxes of all children of a node at once.
//!
//! ```text
//! loop:
//!     start rays until the pool is full
//!     until enough rays are at a leaf:
//!         for each ray at an inner node:
//!             push the children whose boxes it meets, the nearest on top        (SIMD over children)
//!             pop a child that begins before the limit
//!     test the leaves reached; hits lower the limits of their rays
//!     each of these rays pops a child that begins before its limit, or is done
//! ```
//!
//! A box is tested as wide as rounding may move rays and objects: the near side of each pair of faces is nearer
//! by half the thickness, and the far side farther. With `c` = −(origin ± half thickness) / direction, a distance
//! is `face / direction + c`, computed with one fused multiply–add. It has an error of at most 8 ε along the
//! axis, which the thickness ([`crate::structure::SimdTree`]) covers.
//!
//! Where any hit suffices, a limit only falls to −1, so children are not sorted, and no child begins too late.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::{Eight, Simd};
use super::block::Block;
use super::candidate::{Candidate, ExactTests};
use super::leaf_pass::test_leaves;
use super::leaves::{Leaf, Leaves};
use super::prefetch::prefetch;
use super::queue::RayQueue;
use super::ray::{CHUNK, CHUNKS, RayBuffer};
use crate::structure::MAX_WIDTH;
use crate::structure::simd_tree::{BoxTree, Child, WideNode};
use std::hint::select_unpredictable;
use std::ops::Range;

/// Rays in the pool.
const RAYS: usize = 32;

/// Leaves are tested once this many rays are at one.
const ENOUGH: usize = 12;

/// The bits of a distance that hold a child's place while children are sorted.
const PLACE: u32 = MAX_WIDTH as u32 - 1;

/// Bytes of the lower or upper faces of one axis in a [`WideNode`].
const FACES: u32 = size_of::<[f32; MAX_WIDTH]>() as u32;

/// A ray of the pool.
#[derive(Clone, Copy, Default)]
#[repr(C, align(64))]
struct PoolRay {
    inverse: [f32; 3],
    t_enter: f32,
    /// Added to a distance from the frame's origin: for the near and the far side of faces.
    shift: [[f32; 3]; 2],
    /// By axis, the offset in bytes of the near faces in a [`WideNode`].
    near: [u32; 3],
    /// Slot in the [`RayBuffer`].
    slot: u32,
    /// Index of the first free entry of the stack.
    top: u32,
}

/// The stacks of all rays, one after the other: where the pending children begin, and the children. At the
/// bottom of each lies [`Child::END`].
#[derive(Default)]
pub(super) struct Pool {
    begins: Vec<f32>,
    children: Vec<Child>,
}

/// Room at the bottom of a stack for the vectors that [`Stacks::pop`] loads.
const BOTTOM: usize = MAX_WIDTH;

/// Pointers to the stacks.
#[derive(Clone, Copy)]
struct Stacks {
    begins: *mut f32,
    children: *mut Child,
    depth: usize,
}

impl Stacks {
    /// Returns the stacks of all rays, each with room for this many children.
    fn new(pool: &mut Pool, pending: usize) -> Stacks {
        let depth = BOTTOM + pending + MAX_WIDTH;
        pool.begins.resize(RAYS * depth, 0.0);
        pool.children.resize(RAYS * depth, Child::END);
        for stack in 0..RAYS {
            let bottom = stack * depth..stack * depth + BOTTOM;
            pool.begins[bottom.clone()].fill(f32::NEG_INFINITY);
            pool.children[bottom].fill(Child::END);
        }
        Stacks {
            begins: pool.begins.as_mut_ptr(),
            children: pool.children.as_mut_ptr(),
            depth,
        }
    }

    /// Returns the index of the first free entry of an empty stack.
    fn bottom(&self, ray: usize) -> u32 {
        (ray * self.depth + BOTTOM) as u32
    }

    /// Pops a child of a ray, or [`Child::END`]: that on top, or the first below it that begins before the limit.
    /// The bottom is before any limit. Where any hit suffices, a ray that is hit drops all.
    ///
    /// # Safety
    /// As [`Simd`]; `top` is that of the ray's stack.
    #[inline(always)]
    unsafe fn pop<N: Eight>(&self, ray: usize, top: &mut u32, limit: f32, any_hit: bool) -> Child {
        let mut at = *top as usize - 1;
        if any_hit {
            at = select_unpredictable(limit < 0.0, self.bottom(ray) as usize - 1, at);
        } else if *self.begins.add(at) > limit {
            // Rarely: only after a hit.
            at = self.first_before::<N>(at, limit);
        }
        *top = at as u32;
        *self.children.add(at)
    }

    /// Returns the index of the last entry below `top` that begins before the limit.
    ///
    /// # Safety
    /// As above.
    #[inline(always)]
    unsafe fn first_before<N: Eight>(&self, top: usize, limit: f32) -> usize {
        let limit = N::splat(limit);
        let mut at = top - MAX_WIDTH;
        loop {
            let before = N::mask_bits(N::le(N::load(self.begins.add(at)), limit));
            if before != 0 {
                return at + before.ilog2() as usize;
            }
            at -= MAX_WIDTH;
        }
    }
}

/// Rays of the pool with a child each, in any order. Their number is kept apart, in a register.
struct List {
    rays: [u32; 2 * RAYS],
    children: [Child; 2 * RAYS],
}

impl List {
    const EMPTY: List = List {
        rays: [0; 2 * RAYS],
        children: [Child::END; 2 * RAYS],
    };

    /// Appends a ray if `is_added` to the list of `count` rays. Branchless: it is stored in any case.
    ///
    /// # Safety
    /// Fewer than all rays are in the list.
    #[inline(always)]
    unsafe fn push(&mut self, count: &mut usize, is_added: bool, ray: u32, child: Child) {
        *self.rays.get_unchecked_mut(*count) = ray;
        *self.children.get_unchecked_mut(*count) = child;
        *count += usize::from(is_added);
    }

    /// # Safety
    /// There are more than `k`.
    #[inline(always)]
    unsafe fn get(&self, k: usize) -> (u32, Child) {
        (*self.rays.get_unchecked(k), *self.children.get_unchecked(k))
    }
}

/// Traces rays through a hierarchy: first the entering rays in `ahead`, then those of the queue as chunks
/// become free. `S` are the vectors of rays, `N` those of boxes and objects.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) unsafe fn traverse<S: Simd, N: Eight, B: Block>(
    tree: &BoxTree<B>,
    rays: &mut RayBuffer,
    mut ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    pool: &mut Pool,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    const { assert!(N::LANES == MAX_WIDTH && B::PLACES == MAX_WIDTH) };
    let stacks = Stacks::new(pool, tree.max_pending);
    let (nodes, blocks) = (tree.nodes.nodes.as_ptr(), tree.blocks.as_ptr());
    let any_hit = tests.any_hit_suffices();
    candidates.resize(RAYS * B::PLACES, Candidate::default());
    let mut reached = Leaves::<RAYS>::new();
    let mut flights = [PoolRay::default(); RAYS];
    let mut limits = [-1.0_f32; RAYS];
    let mut free: [u32; RAYS] = std::array::from_fn(|k| k as u32);
    let mut free_count = RAYS;
    // Rays at a node, and rays at a leaf.
    let (mut moving, mut leaves) = (List::EMPTY, List::EMPTY);
    let (mut moving_count, mut leaf_count) = (0, 0);
    loop {
        // Start rays.
        while free_count > 0 {
            if ahead.is_empty() {
                if queue.is_empty() {
                    break;
                }
                let Some(chunk) = free_chunk(&flights, &free[..free_count]) else {
                    break;
                };
                rays.entering.keep_from(ahead.start);
                queue.refill::<S>(rays, chunk, tests);
                ahead = 0..rays.entering.count;
                continue;
            }
            free_count -= 1;
            let k = *free.get_unchecked(free_count);
            let entry = ahead.start;
            ahead.start += 1;
            *flights.get_unchecked_mut(k as usize) =
                PoolRay::new(rays, entry, stacks.bottom(k as usize));
            *limits.get_unchecked_mut(k as usize) = *rays.entering.t_exit.get_unchecked(entry);
            moving.push(&mut moving_count, true, k, Child::default());
            queue.prefetch(1);
        }
        // Step until enough rays are at a leaf.
        while moving_count > 0 && leaf_count < ENOUGH {
            let count = std::mem::take(&mut moving_count);
            for i in 0..count {
                let (k, node) = moving.get(i);
                let ray = flights.get_unchecked_mut(k as usize);
                let limit = *limits.get_unchecked(k as usize);
                push::<N>(&*nodes.add(node.index()), ray, &stacks, limit, any_hit);
                let next = stacks.pop::<N>(k as usize, &mut ray.top, limit, any_hit);
                prefetch_child(next, nodes, blocks);
                moving.push(&mut moving_count, !next.is_leaf(), k, next);
                leaves.push(&mut leaf_count, next.is_leaf(), k, next);
            }
        }
        if leaf_count == 0 {
            if free_count == RAYS && ahead.is_empty() && queue.is_empty() {
                return;
            }
            continue;
        }
        // Rays at the bottom of their stack are done.
        let mut waiting = 0;
        for i in 0..std::mem::take(&mut leaf_count) {
            let (k, leaf) = leaves.get(i);
            let is_end = leaf == Child::END;
            *free.get_unchecked_mut(free_count) = k;
            free_count += usize::from(is_end);
            prefetch(blocks.wrapping_add(leaf.index()));
            let at = Leaf {
                lane: k,
                block: leaf.index() as u32,
                left: tree.nodes.blocks(leaf) as u32,
            };
            reached.push_one(!is_end, at);
            leaves.push(&mut waiting, !is_end, k, leaf);
        }
        test_leaves::<N, B, RAYS>(
            &mut reached,
            &tree.blocks,
            rays,
            |k| flights.get_unchecked(k).slot,
            &mut limits,
            candidates,
            tests,
        );
        for i in 0..waiting {
            let (k, _) = leaves.get(i);
            let ray = flights.get_unchecked_mut(k as usize);
            let limit = *limits.get_unchecked(k as usize);
            let next = stacks.pop::<N>(k as usize, &mut ray.top, limit, any_hit);
            prefetch_child(next, nodes, blocks);
            moving.push(&mut moving_count, !next.is_leaf(), k, next);
            leaves.push(&mut leaf_count, next.is_leaf(), k, next);
        }
    }
}

/// Prefetches a node, or the beginning of a leaf's first block. Branchless: nodes and leaves follow each other
/// without a pattern.
#[inline(always)]
unsafe fn prefetch_child<B>(child: Child, nodes: *const WideNode, blocks: *const B) {
    let node = nodes.wrapping_add(child.index());
    let block = blocks.wrapping_add(child.index()).cast();
    prefetch(select_unpredictable(child.is_leaf(), block, node));
}

impl PoolRay {
    /// Returns an entering ray with an empty stack.
    #[inline(always)]
    unsafe fn new(rays: &RayBuffer, entry: usize, bottom: u32) -> PoolRay {
        let entering = &rays.entering;
        let thickness = 2.0 * rays.half_thickness;
        let mut ray = PoolRay {
            t_enter: *entering.t_enter.get_unchecked(entry),
            slot: *entering.ray.get_unchecked(entry),
            top: bottom,
            ..PoolRay::default()
        };
        for k in 0..3 {
            let inverse = *entering.inverse[k].get_unchecked(entry);
            let near = -(*entering.shifted[k].get_unchecked(entry) * inverse);
            ray.inverse[k] = inverse;
            ray.shift[0][k] = near;
            ray.shift[1][k] = near + thickness * inverse.abs();
            ray.near[k] = (2 * k as u32 + u32::from(inverse.is_sign_negative())) * FACES;
        }
        ray
    }
}

/// Tests the children of a node, and pushes those that the ray meets before its limit, the nearest on top. Where
/// any hit suffices, their order does not matter.
///
/// Children are sorted by the distances where their boxes begin, with the child's place in the lowest bits.
/// Rounded down again, such a distance still is a lower bound.
#[inline(always)]
unsafe fn push<N: Eight>(
    node: &WideNode,
    ray: &mut PoolRay,
    stacks: &Stacks,
    limit: f32,
    any_hit: bool,
) {
    let faces = node.faces.as_flattened().as_flattened().as_ptr();
    let (mut enter, mut exit) = (N::splat(ray.t_enter), N::splat(limit));
    for k in 0..3 {
        let inverse = N::splat(ray.inverse[k]);
        let at = ray.near[k] as usize;
        let [near, far] = [at, at ^ FACES as usize].map(|at| N::load(faces.byte_add(at)));
        let near = N::mul_add(near, inverse, N::splat(ray.shift[0][k]));
        let far = N::mul_add(far, inverse, N::splat(ray.shift[1][k]));
        enter = N::max(near, enter);
        exit = N::min(far, exit);
    }
    let is_met = N::le(enter, exit);
    let children = N::load_u(node.children.as_ptr().cast());
    let top = ray.top as usize;
    ray.top += N::mask_bits(is_met).count_ones();
    if any_hit {
        N::compress_store(stacks.children.add(top).cast(), is_met, children);
        return;
    }
    let place = N::splat_u(PLACE);
    let begins = N::and_not_u(N::bits_of(enter), place);
    let keys = N::from_bits(N::add_u(begins, N::load_u(PLACES.as_ptr())));
    // The missed ones come last.
    let keys = N::select(is_met, keys, N::splat(f32::NEG_INFINITY));
    let sorted = N::bits_of(N::sort_descending(keys));
    N::store_u(stacks.begins.add(top).cast(), N::and_not_u(sorted, place));
    N::store_u(
        stacks.children.add(top).cast(),
        N::permute_u(children, sorted),
    );
}

const PLACES: [u32; MAX_WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7];

/// Returns a chunk none of whose rays is in the pool. No ray is ahead.
fn free_chunk(flights: &[PoolRay; RAYS], free: &[u32]) -> Option<usize> {
    let mut is_free = [false; RAYS];
    for &k in free {
        is_free[k as usize] = true;
    }
    let mut used = [false; CHUNKS];
    for (ray, _) in flights.iter().zip(is_free).filter(|(_, is_free)| !is_free) {
        used[ray.slot as usize / CHUNK] = true;
    }
    used.iter().position(|used| !used)
}
