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
//!             test the boxes of its children                                    (SIMD over children)
//!             go to the nearest child, push the others, farthest first; or pop
//!     for each leaf reached, and each of its blocks:
//!         candidates += objects of the block that the ray may hit               (SIMD over objects)
//!     exact tests of the candidates; hits lower the limits of their rays
//!     each of these rays pops a node that begins before its limit, or is done
//! ```
//!
//! A box is tested as wide as rounding may move rays and objects: the near side of each pair of faces is nearer
//! by half the thickness, and the far side farther. With `c` = −(origin ± half thickness) / direction, a distance
//! is `face / direction + c`, computed with one fused multiply–add. It has an error of at most 8 ε along the
//! axis, which the thickness ([`crate::structure::SimdTree`]) covers.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::{Eight, Simd};
use super::block::Block;
use super::candidate::{Candidate, ExactTests};
use super::prefetch::prefetch;
use super::queue::RayQueue;
use super::ray::{CHUNK, CHUNKS, RayBuffer};
use crate::structure::MAX_WIDTH;
use crate::structure::simd_tree::{BLOCK, BlockTree, Child, WideNode, WideNodes};
use std::hint::select_unpredictable;
use std::ops::Range;

/// Rays in the pool.
const RAYS: usize = 32;

/// Leaves are tested once this many rays are at one.
const ENOUGH: usize = 12;

/// The bits of a distance that hold a child's place while children are sorted.
const PLACE: u32 = MAX_WIDTH as u32 - 1;

/// A ray of the pool.
#[derive(Clone, Copy, Default)]
#[repr(C, align(64))]
struct PoolRay {
    inverse: [f32; 3],
    t_enter: f32,
    /// Added to a distance from the frame's origin: for the near and the far side of faces.
    shift: [[f32; 3]; 2],
    /// By axis, 1 if the ray points towards lower coordinates.
    backward: [u32; 3],
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

    /// Removes the entries from the top to the first that begins before the limit, and returns that one. The
    /// bottom is before any limit.
    ///
    /// # Safety
    /// As [`Simd`]; `top` is that of a stack.
    #[inline(always)]
    unsafe fn pop<N: Eight>(&self, top: &mut u32, limit: f32) -> Child {
        let limit = N::splat(limit);
        let mut at = *top as usize - MAX_WIDTH;
        loop {
            let before = N::mask_bits(N::le(N::load(self.begins.add(at)), limit));
            if before != 0 {
                at += before.ilog2() as usize;
                *top = at as u32;
                return *self.children.add(at);
            }
            at -= MAX_WIDTH;
        }
    }
}

/// Rays of the pool with a child each, in any order.
struct List {
    rays: [u32; 2 * RAYS],
    children: [Child; 2 * RAYS],
    count: usize,
}

impl List {
    fn new() -> Self {
        List {
            rays: [0; 2 * RAYS],
            children: [Child::END; 2 * RAYS],
            count: 0,
        }
    }

    /// Appends a ray if `is_added`. Branchless: it is stored in any case.
    ///
    /// # Safety
    /// Fewer than all rays are in the list.
    #[inline(always)]
    unsafe fn push(&mut self, is_added: bool, ray: u32, child: Child) {
        *self.rays.get_unchecked_mut(self.count) = ray;
        *self.children.get_unchecked_mut(self.count) = child;
        self.count += usize::from(is_added);
    }
}

/// Traces rays through a hierarchy: first the entering rays in `ahead`, then those of the queue as chunks
/// become free. `S` are the vectors of objects, `N` those of boxes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) unsafe fn traverse<S: Simd, N: Eight, B: Block>(
    tree: &BlockTree<B>,
    wide: &WideNodes,
    rays: &mut RayBuffer,
    mut ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    pool: &mut Pool,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    const { assert!(N::LANES == MAX_WIDTH) };
    let stacks = Stacks::new(pool, tree.max_pending);
    let (nodes, blocks) = (wide.nodes.as_ptr(), tree.blocks.as_ptr());
    let any_hit = tests.any_hit_suffices();
    let mut flights = [PoolRay::default(); RAYS];
    let mut limits = [-1.0_f32; RAYS];
    let mut free = List::new();
    for k in 0..RAYS {
        free.push(true, k as u32, Child::END);
    }
    let (mut moving, mut leaves, mut reached) = (List::new(), List::new(), List::new());
    loop {
        // Start rays.
        while free.count > 0 {
            if ahead.is_empty() {
                if queue.is_empty() {
                    break;
                }
                let Some(chunk) = free_chunk(&flights, &free.rays[..free.count]) else {
                    break;
                };
                rays.entering.keep_from(ahead.start);
                queue.refill::<S>(rays, chunk, tests);
                ahead = 0..rays.entering.count;
                continue;
            }
            free.count -= 1;
            let k = *free.rays.get_unchecked(free.count);
            let entry = ahead.start;
            ahead.start += 1;
            *flights.get_unchecked_mut(k as usize) =
                PoolRay::new(rays, entry, stacks.bottom(k as usize));
            *limits.get_unchecked_mut(k as usize) = *rays.entering.t_exit.get_unchecked(entry);
            moving.push(true, k, Child::default());
            queue.prefetch(1);
        }
        // Step until enough rays are at a leaf.
        while moving.count > 0 && leaves.count < ENOUGH {
            let count = std::mem::take(&mut moving.count);
            for i in 0..count {
                let k = *moving.rays.get_unchecked(i);
                let at = moving.children.get_unchecked(i).index();
                let ray = flights.get_unchecked_mut(k as usize);
                let limit = *limits.get_unchecked(k as usize);
                let next = step::<N>(&*nodes.add(at), ray, &stacks, limit);
                place(next, k, (nodes, blocks), &mut moving, &mut leaves);
            }
        }
        if leaves.count == 0 {
            if free.count == RAYS && ahead.is_empty() && queue.is_empty() {
                return;
            }
            continue;
        }
        // Rays at the bottom of their stack are done.
        let count = std::mem::take(&mut leaves.count);
        reached.count = 0;
        for i in 0..count {
            let (k, leaf) = (leaves.rays[i], leaves.children[i]);
            prefetch(blocks.wrapping_add(leaf.index()));
            let is_end = leaf == Child::END;
            free.push(is_end, k, leaf);
            reached.push(!is_end, k, leaf);
        }
        // Test leaves.
        let count = reached.count;
        candidates.clear();
        for i in 0..count {
            let k = *reached.rays.get_unchecked(i);
            let leaf = *reached.children.get_unchecked(i);
            let slot = flights.get_unchecked(k as usize).slot;
            let limit = limits.get_unchecked_mut(k as usize);
            for block in leaf.index()..leaf.index() + wide.blocks(leaf) {
                let objects = &*blocks.add(block);
                let masks = objects.candidates::<S>(rays, slot as usize, *limit, any_hit);
                if masks.certain != 0 {
                    tests.mark_hit(rays, &[slot]);
                    *limit = -1.0;
                    break;
                }
                let mut possible = masks.possible;
                while possible != 0 {
                    let place = possible.trailing_zeros() % BLOCK as u32;
                    possible &= possible - 1;
                    candidates.push(Candidate {
                        lane: k,
                        ray: slot,
                        block: block as u32,
                        place,
                        object: *objects.objects().get_unchecked(place as usize),
                    });
                }
            }
        }
        if !candidates.is_empty() {
            tests.test(rays, candidates, &mut limits);
        }
        for i in 0..count {
            let k = *reached.rays.get_unchecked(i);
            let ray = flights.get_unchecked_mut(k as usize);
            let limit = *limits.get_unchecked(k as usize);
            let next = stacks.pop::<N>(&mut ray.top, limit);
            place(next, k, (nodes, blocks), &mut moving, &mut leaves);
        }
    }
}

/// Appends a ray to the list of those at a node or of those at a leaf, and prefetches the node or the beginning
/// of the leaf's first block. Branchless: nodes and leaves follow each other without a pattern.
#[inline(always)]
unsafe fn place<B>(
    next: Child,
    ray: u32,
    (nodes, blocks): (*const WideNode, *const B),
    moving: &mut List,
    leaves: &mut List,
) {
    let node = nodes.wrapping_add(next.index());
    let block = blocks.wrapping_add(next.index()).cast();
    prefetch(select_unpredictable(next.is_leaf(), block, node));
    moving.push(!next.is_leaf(), ray, next);
    leaves.push(next.is_leaf(), ray, next);
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
            ray.backward[k] = u32::from(inverse.is_sign_negative());
        }
        ray
    }
}

/// Tests the children of a node. Pushes those that the ray meets before its limit, the nearest on top, and pops
/// one.
///
/// Children are sorted by the distances where their boxes begin, with the child's place in the lowest bits.
/// Rounded down again, such a distance still is a lower bound.
#[inline(always)]
unsafe fn step<N: Eight>(node: &WideNode, ray: &mut PoolRay, stacks: &Stacks, limit: f32) -> Child {
    let (mut enter, mut exit) = (N::splat(ray.t_enter), N::splat(limit));
    for k in 0..3 {
        let inverse = N::splat(ray.inverse[k]);
        let face = |side: u32| {
            let side = (side ^ ray.backward[k]) as usize;
            N::load(node.corners.get_unchecked(side).get_unchecked(k).as_ptr())
        };
        let near = N::mul_add(face(0), inverse, N::splat(ray.shift[0][k]));
        let far = N::mul_add(face(1), inverse, N::splat(ray.shift[1][k]));
        enter = N::max(near, enter);
        exit = N::min(far, exit);
    }
    let is_met = N::le(enter, exit);
    let met = N::mask_bits(is_met).count_ones();
    if met == 0 {
        return stacks.pop::<N>(&mut ray.top, limit);
    }
    let place = N::splat_u(PLACE);
    let begins = N::and_not_u(N::bits_of(enter), place);
    let keys = N::from_bits(N::add_u(begins, N::load_u(PLACES.as_ptr())));
    // The missed ones come last.
    let keys = N::select(is_met, keys, N::splat(f32::NEG_INFINITY));
    let sorted = N::bits_of(N::sort_descending(keys));
    let children = N::load_u(node.children.as_ptr().cast());
    let top = ray.top as usize;
    N::store_u(stacks.begins.add(top).cast(), N::and_not_u(sorted, place));
    N::store_u(
        stacks.children.add(top).cast(),
        N::permute_u(children, sorted),
    );
    ray.top = (top as u32) + met - 1;
    *stacks.children.add(ray.top as usize)
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
