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

use super::arithmetic::Simd;
use super::block::Block;
use super::candidate::{Candidate, ExactTests};
use super::prefetch::prefetch;
use super::queue::RayQueue;
use super::ray::{CHUNK, CHUNKS, RayBuffer};
use crate::structure::MAX_WIDTH;
use crate::structure::simd_tree::{BLOCK, BlockTree, WideNode};
use std::ops::Range;

/// Rays in the pool.
const RAYS: usize = 32;

/// Leaves are tested once this many rays are at one.
const ENOUGH: usize = 12;

/// A child of a node: an inner node, or the blocks of a leaf.
#[derive(Clone, Copy, Default)]
struct Child {
    index: u32,
    /// 0 for an inner node.
    blocks: u32,
}

/// A pending child.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
struct Pending {
    t_enter: f32,
    child: Child,
}

/// A ray of the pool.
#[derive(Clone, Copy, Default)]
struct PoolRay {
    inverse: [f32; 3],
    /// Added to a distance from the frame's origin: for the near and the far side of faces.
    shift: [[f32; 3]; 2],
    /// By axis, 1 if the ray points towards lower coordinates.
    backward: [usize; 3],
    t_enter: f32,
    /// Slot in the [`RayBuffer`].
    slot: u32,
    /// Number of pending children.
    pending: usize,
}

/// The memory of a pool.
#[derive(Default)]
pub(super) struct Pool {
    /// The stacks of all rays, one after the other.
    stacks: Vec<Pending>,
}

/// Rays of the pool with a child each, in any order.
struct List {
    rays: [u32; RAYS],
    children: [Child; RAYS],
    count: usize,
}

impl List {
    fn new() -> Self {
        List {
            rays: [0; RAYS],
            children: [Child::default(); RAYS],
            count: 0,
        }
    }

    /// Appends a ray.
    ///
    /// # Safety
    /// The list is not full.
    #[inline(always)]
    unsafe fn push(&mut self, ray: u32, child: Child) {
        *self.rays.get_unchecked_mut(self.count) = ray;
        *self.children.get_unchecked_mut(self.count) = child;
        self.count += 1;
    }
}

/// Traces rays through a hierarchy: first the entering rays in `ahead`, then those of the queue as chunks
/// become free. `S` are the vectors of objects, `N` those of boxes, with eight lanes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub(super) unsafe fn traverse<S: Simd, N: Simd, B: Block>(
    tree: &BlockTree<B>,
    nodes: &[WideNode],
    rays: &mut RayBuffer,
    mut ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    pool: &mut Pool,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    const { assert!(N::LANES == MAX_WIDTH) };
    let depth = tree.max_pending + MAX_WIDTH;
    pool.stacks.resize(RAYS * depth, Pending::default());
    let stacks = pool.stacks.as_mut_ptr();
    let any_hit = tests.any_hit_suffices();
    let mut flights = [PoolRay::default(); RAYS];
    let mut limits = [-1.0_f32; RAYS];
    let mut free: [u32; RAYS] = std::array::from_fn(|k| k as u32);
    let mut free_count = RAYS;
    let (mut moving, mut leaves) = (List::new(), List::new());
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
            *flights.get_unchecked_mut(k as usize) = PoolRay::new(rays, entry);
            *limits.get_unchecked_mut(k as usize) = rays.entering.t_exit[entry];
            moving.push(k, Child::default());
            queue.prefetch(1);
        }
        // Step until enough rays are at a leaf.
        while moving.count > 0 && leaves.count < ENOUGH {
            let count = std::mem::take(&mut moving.count);
            for i in 0..count {
                let k = *moving.rays.get_unchecked(i);
                let node = nodes.get_unchecked(moving.children.get_unchecked(i).index as usize);
                let ray = flights.get_unchecked_mut(k as usize);
                let stack = stacks.add(k as usize * depth);
                let limit = *limits.get_unchecked(k as usize);
                let next = match step::<N>(node, ray, stack, limit, any_hit) {
                    Some(child) => Some(child),
                    None => pop(ray, stack, limit),
                };
                place(
                    next,
                    k,
                    tree,
                    nodes,
                    &mut moving,
                    &mut leaves,
                    &mut free,
                    &mut free_count,
                );
            }
        }
        if leaves.count == 0 {
            if free_count == RAYS && ahead.is_empty() && queue.is_empty() {
                return;
            }
            continue;
        }
        // Test leaves.
        let count = std::mem::take(&mut leaves.count);
        let at_leaves = (leaves.rays, leaves.children);
        candidates.clear();
        for i in 0..count {
            let (k, leaf) = (at_leaves.0[i], at_leaves.1[i]);
            let slot = flights.get_unchecked(k as usize).slot;
            let limit = limits.get_unchecked_mut(k as usize);
            for block in leaf.index..leaf.index + leaf.blocks {
                let objects = tree.blocks.get_unchecked(block as usize);
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
                        block,
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
            let k = at_leaves.0[i];
            let ray = flights.get_unchecked_mut(k as usize);
            let limit = *limits.get_unchecked(k as usize);
            let next = pop(ray, stacks.add(k as usize * depth), limit);
            place(
                next,
                k,
                tree,
                nodes,
                &mut moving,
                &mut leaves,
                &mut free,
                &mut free_count,
            );
        }
    }
}

impl PoolRay {
    /// Returns an entering ray.
    #[inline(always)]
    unsafe fn new(rays: &RayBuffer, entry: usize) -> PoolRay {
        let entering = &rays.entering;
        let thickness = 2.0 * rays.half_thickness;
        let mut ray = PoolRay {
            t_enter: *entering.t_enter.get_unchecked(entry),
            slot: *entering.ray.get_unchecked(entry),
            ..PoolRay::default()
        };
        for k in 0..3 {
            let inverse = *entering.inverse[k].get_unchecked(entry);
            let near = -(*entering.shifted[k].get_unchecked(entry) * inverse);
            ray.inverse[k] = inverse;
            ray.shift[0][k] = near;
            ray.shift[1][k] = near + thickness * inverse.abs();
            ray.backward[k] = usize::from(inverse.is_sign_negative());
        }
        ray
    }
}

/// Tests the children of a node. Returns the nearest of those that the ray meets before its limit, and pushes
/// the others so that the nearest is on top.
#[inline(always)]
unsafe fn step<N: Simd>(
    node: &WideNode,
    ray: &mut PoolRay,
    stack: *mut Pending,
    limit: f32,
    any_hit: bool,
) -> Option<Child> {
    let (mut enter, mut exit) = (N::splat(ray.t_enter), N::splat(limit));
    for k in 0..3 {
        let inverse = N::splat(ray.inverse[k]);
        let face = |side: usize| {
            let side = side ^ ray.backward.get_unchecked(k);
            N::load(node.corners.get_unchecked(side).get_unchecked(k).as_ptr())
        };
        let near = N::mul_add(face(0), inverse, N::splat(ray.shift[0][k]));
        let far = N::mul_add(face(1), inverse, N::splat(ray.shift[1][k]));
        enter = N::max(near, enter);
        exit = N::min(far, exit);
    }
    let mut met = N::mask_bits(N::le(enter, exit));
    if met == 0 {
        return None;
    }
    let mut begins = [0.0_f32; MAX_WIDTH];
    N::store_u(begins.as_mut_ptr().cast(), N::bits_of(enter));
    let first = ray.pending;
    loop {
        let k = met.trailing_zeros() as usize;
        met &= met - 1;
        let pending = Pending {
            t_enter: *begins.get_unchecked(k),
            child: Child {
                index: *node.child.get_unchecked(k),
                blocks: *node.blocks.get_unchecked(k),
            },
        };
        // Insertion: the nearest is on top. The order does not matter where any hit suffices.
        let mut at = ray.pending;
        if !any_hit {
            while at > first && (*stack.add(at - 1)).t_enter < pending.t_enter {
                *stack.add(at) = *stack.add(at - 1);
                at -= 1;
            }
        }
        *stack.add(at) = pending;
        ray.pending += 1;
        if met == 0 {
            break;
        }
    }
    ray.pending -= 1;
    Some((*stack.add(ray.pending)).child)
}

/// Pops a pending child that begins before the limit.
#[inline(always)]
unsafe fn pop(ray: &mut PoolRay, stack: *const Pending, limit: f32) -> Option<Child> {
    while ray.pending > 0 {
        ray.pending -= 1;
        let pending = *stack.add(ray.pending);
        if pending.t_enter <= limit {
            return Some(pending.child);
        }
    }
    None
}

/// Appends a ray to the list of those at an inner node, at a leaf, or done; and prefetches what it needs next.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
unsafe fn place<B: Block>(
    next: Option<Child>,
    ray: u32,
    tree: &BlockTree<B>,
    nodes: &[WideNode],
    moving: &mut List,
    leaves: &mut List,
    free: &mut [u32; RAYS],
    free_count: &mut usize,
) {
    match next {
        None => {
            *free.get_unchecked_mut(*free_count) = ray;
            *free_count += 1;
        }
        Some(child) if child.blocks == 0 => {
            prefetch(nodes.as_ptr().add(child.index as usize));
            moving.push(ray, child);
        }
        Some(child) => {
            prefetch(tree.blocks.as_ptr().add(child.index as usize));
            leaves.push(ray, child);
        }
    }
}

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
