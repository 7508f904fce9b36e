//! The traversal of a stream of rays: every lane has its own ray, node and stack.
//!
//! Lanes form groups of one vector each. The groups step in turn, so that the nodes of one group are
//! loaded while another computes. A lane that reaches a leaf idles until enough lanes have.
//!
//! ```text
//! loop:
//!     for each leaf reached, and each of its blocks:
//!         candidates += objects of the block that the lane's ray may hit        (SIMD over objects)
//!         exact tests of the candidates; hits lower the limits of their rays
//!     flush pushes to the stacks
//!     refill chunks of the ray buffer that are done
//!     for each idle lane:
//!         pop a node that begins before the ray's limit, or start a new ray, or retire
//!     until most lanes idle:
//!         for each group:                                                        (SIMD over rays)
//!             lanes at a leaf:       queue the leaf, idle
//!             lanes at an inner node: go to the near child, the far child, or push the far one and go
//!                                     to the near one; skip empty leaves
//!             load the next nodes of the group
//! ```
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::stacks::{PushBuffer, Stacks};
use crate::structure::simd_tree::{ABOVE_EMPTY, BELOW_EMPTY, CHILD_SHIFT, LEAF, PlaneTree};
use crate::trace::simd::arithmetic::{Simd, WIDEST};
use crate::trace::simd::block::Block;
use crate::trace::simd::candidate::{Candidate, ExactTests};
use crate::trace::simd::leaf_pass::test_leaves;
use crate::trace::simd::leaves::Leaves;
use crate::trace::simd::queue::RayQueue;
use crate::trace::simd::ray::{CHUNK, CHUNKS, Column, RayBuffer};
use std::ops::Range;

/// Maximum number of groups.
const MAX_GROUPS: usize = 5;

/// Capacity for one leaf per lane and a vector behind them.
const LEAVES: usize = WIDEST * (MAX_GROUPS + 1);

/// The rays in a group's lanes.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Group {
    shifted: [[f32; WIDEST]; 3],
    inverse: [[f32; WIDEST]; 3],
    /// Slots of the rays.
    ray: [u32; WIDEST],
}

impl Group {
    const NEW: Group = Group {
        shifted: [[0.0; WIDEST]; 3],
        inverse: [[1.0; WIDEST]; 3],
        ray: [0; WIDEST],
    };
}

/// Lane indices of all groups.
const LANE_INDICES: [[u32; WIDEST]; MAX_GROUPS] = {
    let mut numbers = [[0; WIDEST]; MAX_GROUPS];
    let mut k = 0;
    while k < MAX_GROUPS * WIDEST {
        numbers[k / WIDEST][k % WIDEST] = k as u32;
        k += 1;
    }
    numbers
};

/// The traversal state of a group's lanes.
struct State<S: Simd> {
    node: S::U,
    /// Index of the next free entry of the stack.
    top: S::U,
    /// The interval of the ray within the node's cell.
    enter: S::F,
    exit: S::F,
    /// Lanes that have a ray, and lanes that are still traversing inner nodes.
    alive: u32,
    active: S::M,
}

impl<S: Simd> State<S> {
    /// Returns the lanes that idle at a leaf.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn idle(&self) -> u32 {
        self.alive & !S::mask_bits(self.active)
    }
}

/// Unrolls a loop over groups. A loop would keep vectors in memory.
macro_rules! each_group {
    ($groups:ident, $j:ident => $body:expr) => {
        each_group!(@one $groups, $j, 0, $body);
        each_group!(@one $groups, $j, 1, $body);
        each_group!(@one $groups, $j, 2, $body);
        each_group!(@one $groups, $j, 3, $body);
        each_group!(@one $groups, $j, 4, $body);
    };
    (@one $groups:ident, $j:ident, $number:literal, $body:expr) => {
        if $number < $groups {
            const $j: usize = $number;
            $body
        }
    };
}

/// Selects one of three values per lane: by default that of axis 0.
#[inline(always)]
unsafe fn by_axis<S: Simd>(values: &[[f32; WIDEST]; 3], is_1: S::M, is_2: S::M) -> S::F {
    let z = S::load(values[2].as_ptr());
    let x_or_y = S::select(
        is_1,
        S::load(values[1].as_ptr()),
        S::load(values[0].as_ptr()),
    );
    S::select(is_2, z, x_or_y)
}

/// Traces rays through a tree in `GROUPS` groups of lanes: first those of the entering rays in `ahead`,
/// then those of the queue as chunks become free.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(crate) unsafe fn traverse<S: Simd, B: Block, const GROUPS: usize>(
    tree: &PlaneTree<B>,
    rays: &mut RayBuffer,
    mut ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    stacks: &mut Stacks,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn ExactTests,
) {
    const { assert!(GROUPS <= MAX_GROUPS && S::LANES <= WIDEST) };
    stacks.reserve(GROUPS * S::LANES, tree.max_pending + 1);
    let mut pushes = stacks.push_buffer();
    let mut bottoms = [[0_u32; WIDEST]; MAX_GROUPS];
    for (j, bottoms) in bottoms.iter_mut().enumerate() {
        for (lane, bottom) in bottoms.iter_mut().enumerate() {
            *bottom = stacks.bottom(j * S::LANES + lane);
        }
    }
    let all = (1_u32 << S::LANES) - 1;
    let mut groups = [Group::NEW; GROUPS];
    let mut states: [State<S>; GROUPS] = std::array::from_fn(|j| State {
        node: S::splat_u(0),
        top: S::load_u(bottoms[j].as_ptr()),
        enter: S::splat(0.0),
        exit: S::splat(-1.0),
        alive: 0,
        active: S::mask_from_bits(0),
    });
    if !ahead.is_empty() {
        each_group!(GROUPS, J => states[J].alive = all);
    }
    let mut limits = [[-1.0_f32; WIDEST]; GROUPS];
    candidates.resize(GROUPS * S::LANES * B::PLACES, Candidate::default());
    let mut leaves = Leaves::new();
    // Leaves are processed once this many lanes idle.
    let enough = (GROUPS * S::LANES * 5 / 8) as u32;

    loop {
        leaves.prefetch_all(tree.blocks.as_ptr());
        test_leaves::<S, B, LEAVES>(
            &mut leaves,
            &tree.blocks,
            rays,
            |lane| {
                let group = groups.get_unchecked(lane / WIDEST);
                *group.ray.get_unchecked(lane % WIDEST)
            },
            limits.as_flattened_mut(),
            candidates,
            tests,
        );
        stacks.flush(&mut pushes);
        while ahead.len() < GROUPS * S::LANES && !queue.is_empty() {
            let Some(chunk) = free_chunk(rays, ahead.clone(), &states, &groups) else {
                break;
            };
            rays.entering.keep_from(ahead.start);
            queue.refill::<S>(rays, chunk, tests);
            ahead = 0..rays.entering.count;
            each_group!(GROUPS, J => states[J].alive = all);
        }
        let mut alive = 0;
        let first_new = ahead.start;
        each_group!(GROUPS, J => {
            let (state, group) = (&mut states[J], &mut groups[J]);
            let bottom = S::load_u(bottoms[J].as_ptr());
            let limits = &mut limits[J];
            resume::<S>(state, group, limits, stacks, bottom, rays, &mut ahead);
            alive += state.alive.count_ones();
        });
        if alive == 0 {
            return;
        }
        queue.prefetch(ahead.start - first_new);
        // With few rays left, all lanes idle.
        let min_moving = alive.saturating_sub(enough);
        // The next nodes of a group are loaded while the others step.
        let nodes = tree.nodes.as_ptr().cast();
        let objects = (&*tree.blocks, S::splat(2.0 * rays.half_thickness));
        let mut fetched = [(S::splat_u(0), S::splat_u(0)); GROUPS];
        each_group!(GROUPS, J => fetched[J] = S::gather_pairs(nodes, states[J].node));
        loop {
            each_group!(GROUPS, J => {
                let lanes = S::load_u(LANE_INDICES[J].as_ptr());
                let (state, group) = (&mut states[J], &groups[J]);
                step(state, group, lanes, fetched[J], &mut pushes, &mut leaves, objects);
                fetched[J] = S::gather_pairs(nodes, states[J].node);
            });
            let mut moving = 0;
            each_group!(GROUPS, J => {
                moving += S::mask_bits(states[J].active).count_ones();
            });
            if moving <= min_moving {
                break;
            }
        }
    }
}

/// Returns a chunk none of whose rays is in a lane or ahead.
fn free_chunk<S: Simd>(
    rays: &RayBuffer,
    ahead: Range<usize>,
    states: &[State<S>],
    groups: &[Group],
) -> Option<usize> {
    let mut used = [false; CHUNKS];
    for &ray in &rays.entering.ray[ahead] {
        used[ray as usize / CHUNK] = true;
    }
    for (state, group) in states.iter().zip(groups) {
        for (lane, &ray) in group.ray.iter().enumerate() {
            used[ray as usize / CHUNK] |= state.alive >> lane & 1 != 0;
        }
    }
    used.iter().position(|used| !used)
}

/// Resumes idle lanes with the next pending node, or with a new ray where none is left before the limit.
#[inline(always)]
unsafe fn resume<S: Simd>(
    state: &mut State<S>,
    group: &mut Group,
    limits: &mut [f32; WIDEST],
    stacks: &Stacks,
    bottom: S::U,
    rays: &RayBuffer,
    ahead: &mut Range<usize>,
) {
    let idle = state.idle();
    if idle == 0 {
        return;
    }
    let entry = S::splat_u(1);
    let thickness = S::splat(2.0 * rays.half_thickness);
    let wx = S::mul(S::abs(S::load(group.inverse[0].as_ptr())), thickness);
    let wy = S::mul(S::abs(S::load(group.inverse[1].as_ptr())), thickness);
    let wz = S::mul(S::abs(S::load(group.inverse[2].as_ptr())), thickness);
    let limit = S::load(limits.as_ptr());
    // No pending cell begins before the end of the last one, less the thickness of planes.
    let max_width = S::max(wx, S::max(wy, wz));
    let beyond = S::le(limit, S::sub(state.exit, max_width));
    let done = S::mask_bits(S::or(S::eq_u(state.top, bottom), beyond)) & idle;
    let pops = S::mask_from_bits(idle & !done);
    state.top = S::replace_u(pops, S::sub_u(state.top, entry), state.top);
    let (node, t_enter, t_exit) = stacks.get::<S>(state.top);
    state.enter = S::replace(pops, t_enter, state.enter);
    state.exit = S::replace(pops, t_exit, state.exit);
    state.node = S::replace_u(pops, node, state.node);
    // A node that begins beyond the limit is dropped. Its lane idles on.
    let resumes = S::and(S::le(state.enter, limit), pops);
    state.active = S::or(state.active, resumes);
    if done == 0 {
        return;
    }
    let entering = &rays.entering;
    let mut starts = done;
    while starts.count_ones() as usize > ahead.len() {
        starts &= starts - 1;
    }
    state.alive &= !(done ^ starts);
    let first = ahead.start;
    ahead.start += starts.count_ones() as usize;
    let starts = S::mask_from_bits(starts);
    let columns = [
        (&entering.shifted, &mut group.shifted),
        (&entering.inverse, &mut group.inverse),
    ];
    for (columns, lanes) in columns {
        for k in 0..3 {
            let lane = lanes[k].as_mut_ptr();
            S::store_u(
                lane.cast(),
                S::bits_of(expanded::<S>(starts, &columns[k], first, S::load(lane))),
            );
        }
    }
    let limits = limits.as_mut_ptr().cast();
    S::store_u(
        limits,
        S::bits_of(expanded::<S>(starts, &entering.t_exit, first, limit)),
    );
    let ray = group.ray.as_mut_ptr();
    let from = entering.ray.as_ptr().add(first);
    S::store_u(ray, S::expand_load(starts, from, S::load_u(ray)));
    state.active = S::or(state.active, starts);
    state.enter = expanded::<S>(starts, &entering.t_enter, first, state.enter);
    state.exit = expanded::<S>(starts, &entering.t_exit, first, state.exit);
    state.node = S::replace_u(starts, S::splat_u(0), state.node);
    state.top = S::replace_u(starts, bottom, state.top);
}

/// Loads a column from `first` on into the lanes of a mask; the other lanes keep their own.
#[inline(always)]
unsafe fn expanded<S: Simd>(mask: S::M, column: &Column<f32>, first: usize, own: S::F) -> S::F {
    let from = column.as_ptr().add(first).cast();
    S::from_bits(S::expand_load(mask, from, S::bits_of(own)))
}

/// Advances the lanes at an inner node to a child, and queues the leaves of the lanes at a leaf.
///
/// ```text
/// begins, ends = distances to the near and the far side of the plane
/// ends < enter:   go to the far child
/// exit < begins:  go to the near child
/// else both:      near child empty:  go to the far child from `begins` on
///                 far child empty:   go to the near child until `ends`
///                 else:              push the far child, go to the near one
/// ```
#[inline(always)]
unsafe fn step<S: Simd, B: Block>(
    state: &mut State<S>,
    group: &Group,
    lanes: S::U,
    (payload, word): (S::U, S::U),
    pushes: &mut PushBuffer,
    leaves: &mut Leaves<LEAVES>,
    (blocks, thickness): (&[B], S::F),
) {
    let one = S::splat_u(1);
    let (is_1, is_2) = (S::test_bit_u::<0>(word), S::test_bit_u::<1>(word));
    let at_leaf = S::and(S::and(is_1, is_2), state.active);
    state.active = S::and_not(state.active, at_leaf);
    let full = S::and_not(at_leaf, S::eq_u(word, S::splat_u(LEAF)));
    leaves.push::<S>(full, lanes, payload, S::shr_u::<2>(word));
    leaves.prefetch_next(blocks.as_ptr());
    let active = state.active;
    let shifted = by_axis::<S>(&group.shifted, is_1, is_2);
    let inverse = by_axis::<S>(&group.inverse, is_1, is_2);
    let begins = S::mul(S::sub(S::from_bits(payload), shifted), inverse);
    let ends = S::mul_add(S::abs(inverse), thickness, begins);
    let backward = S::shr_u::<31>(S::bits_of(inverse));
    let near = S::add_u(S::shr_u::<CHILD_SHIFT>(word), backward);
    let far = S::xor_u(near, one);
    const { assert!(ABOVE_EMPTY == BELOW_EMPTY << 1) };
    let (near_empty, far_empty) =
        S::test_bit_pair_u::<{ BELOW_EMPTY.trailing_zeros() }>(word, backward);
    let only_far = S::lt(ends, state.enter);
    let both = S::and_not(S::and(S::le(begins, state.exit), active), only_far);
    let skip = S::and(both, near_empty);
    let take = S::and_not(both, near_empty);
    let push = S::and_not(take, far_empty);
    let after = S::max(state.enter, begins);
    pushes.push::<S>(push, state.top, far, after, state.exit);
    state.top = S::replace_u(push, S::add_u(state.top, one), state.top);
    state.enter = S::replace(skip, after, state.enter);
    state.exit = S::replace(take, S::min(state.exit, ends), state.exit);
    let to_far = S::or(only_far, skip);
    let next = S::select_u(to_far, far, near);
    state.node = S::replace_u(active, next, state.node);
}
