//! The walk of many rays at once, one a lane: each with its own node and stack.
//!
//! Lanes come in groups of a vector each, several of which take their steps in turn, so that one
//! group's nodes are on their way from memory while another computes. A lane that comes to a leaf
//! waits; when enough wait, their leaves are held against their rays, what may be hit is tested, and
//! they go on with what is on their stacks or with new rays.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::block::{BLOCK, Block};
use super::prepare::{ABOVE_EMPTY, BELOW_EMPTY, PLACE, Prepared};
use super::ray::{LaneRays, Start};
use super::simd::{Simd, Waiting};

/// An object that the ray of a lane may hit.
#[derive(Clone, Copy, Default)]
pub(super) struct Candidate {
    /// Where the ray's limit stands.
    pub(super) lane: u32,
    /// The ray's place among those made ready.
    pub(super) ray: u32,
    /// The object's block and its place there.
    pub(super) block: u32,
    pub(super) place: u32,
    pub(super) object: u32,
    /// That it is hit is certain, if not where.
    pub(super) surely: bool,
}

/// The exact tests of the few objects that rays may hit.
pub(super) trait Tests {
    /// Whether one hit is enough, and it does not matter where.
    fn any_will_do(&self) -> bool;

    /// Tests objects, and lowers the limits of rays that are hit: the distances in the unit frame
    /// beyond which nothing matters any more, −1 where nothing does at all.
    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]);
}

/// Lanes of the widest vector.
pub(super) const WIDEST: usize = 16;

/// The most groups there are room for.
const MOST_GROUPS: usize = 6;

/// Candidates that are tested at once, at most; a block adds up to [`BLOCK`].
pub(super) const MOST_CANDIDATES: usize = 256;

/// What a group's lanes hold of their rays.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Group {
    shifted: [[f32; WIDEST]; 3],
    inverse: [[f32; WIDEST]; 3],
    /// Where new rays enter and leave the scene.
    t_enter: [f32; WIDEST],
    t_exit: [f32; WIDEST],
    /// The leaf that the lane has come to: its first block and the number of its blocks.
    first: [u32; WIDEST],
    blocks: [u32; WIDEST],
    /// The lane's ray.
    ray: [u32; WIDEST],
}

impl Group {
    const NEW: Group = Group {
        shifted: [[0.0; WIDEST]; 3],
        inverse: [[1.0; WIDEST]; 3],
        t_enter: [0.0; WIDEST],
        t_exit: [0.0; WIDEST],
        first: [0; WIDEST],
        blocks: [0; WIDEST],
        ray: [0; WIDEST],
    };

    /// Gives a lane a new ray.
    #[inline(always)]
    unsafe fn begin(&mut self, lane: usize, rays: &LaneRays, start: &Start) {
        let ray = rays.rays.get_unchecked(start.ray as usize);
        for (k, shifted) in ray.shifted(rays.thick).into_iter().enumerate() {
            *self.shifted[k].get_unchecked_mut(lane) = shifted;
            *self.inverse[k].get_unchecked_mut(lane) = ray.inverse[k];
        }
        *self.t_enter.get_unchecked_mut(lane) = start.t_enter;
        *self.t_exit.get_unchecked_mut(lane) = start.t_exit;
        *self.blocks.get_unchecked_mut(lane) = 0;
        *self.ray.get_unchecked_mut(lane) = start.ray;
    }
}

/// Where a group's lanes are.
struct Place<S: Simd> {
    node: S::U,
    /// Where the next node is put on the stack.
    top: S::U,
    /// Where on the ray the cell lies.
    enter: S::F,
    exit: S::F,
    /// Lanes that have a ray, and lanes that are at an inner node.
    alive: u32,
    active: S::M,
}

impl<S: Simd> Place<S> {
    /// Lanes that have come to a leaf.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn waiting(&self) -> u32 {
        self.alive & !S::bits(self.active)
    }
}

/// Does the same for every group; written out, as a loop would keep vectors in memory.
macro_rules! each_group {
    ($groups:ident, $j:ident => $body:expr) => {
        each_group!(@one $groups, $j, 0, $body);
        each_group!(@one $groups, $j, 1, $body);
        each_group!(@one $groups, $j, 2, $body);
        each_group!(@one $groups, $j, 3, $body);
        each_group!(@one $groups, $j, 4, $body);
        each_group!(@one $groups, $j, 5, $body);
    };
    (@one $groups:ident, $j:ident, $number:literal, $body:expr) => {
        if $number < $groups {
            const $j: usize = $number;
            $body
        }
    };
}

/// Of three values a lane, the one for the axis that the masks tell.
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

/// Walks rays through a tree in `GROUPS` groups of lanes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(super) unsafe fn walk<S: Simd, B: Block, const GROUPS: usize>(
    tree: &Prepared<B>,
    rays: &LaneRays,
    mut starts: &[Start],
    stack: &mut Vec<Waiting>,
    tests: &mut dyn Tests,
) {
    const { assert!(GROUPS <= MOST_GROUPS && S::LANES <= WIDEST) };
    let depth = tree.most_waiting + 1;
    stack.resize(GROUPS * S::LANES * depth, Waiting::default());
    let stack = stack.as_mut_ptr();
    // Every lane's stack follows that of the lane before.
    let mut bottoms = [[0_u32; WIDEST]; MOST_GROUPS];
    for (j, bottoms) in bottoms.iter_mut().enumerate() {
        for (lane, bottom) in bottoms.iter_mut().enumerate() {
            *bottom = ((j * S::LANES + lane) * depth) as u32 * Waiting::PLACES;
        }
    }
    let all = (1_u32 << S::LANES) - 1;
    let mut groups = [Group::NEW; GROUPS];
    let mut places: [Place<S>; GROUPS] = std::array::from_fn(|j| Place {
        node: S::splat_u(0),
        top: S::load_u(bottoms[j].as_ptr()),
        enter: S::splat(0.0),
        exit: S::splat(-1.0),
        alive: all,
        active: S::mask(0),
    });
    let mut limits = [[-1.0_f32; WIDEST]; GROUPS];
    let mut candidates = [Candidate::default(); MOST_CANDIDATES];
    let any_will_do = tests.any_will_do();
    // A round of tests is worth its while once half the lanes wait.
    let enough = (GROUPS * S::LANES / 2) as u32;

    loop {
        let mut found = 0;
        let mut at_leaves = [0; GROUPS];
        each_group!(GROUPS, J => {
            let blocks = S::load_u(groups[J].blocks.as_ptr());
            let full = S::bits(S::test_u(blocks, S::splat_u(u32::MAX)));
            at_leaves[J] = places[J].waiting() & full;
        });
        for j in 0..GROUPS {
            let group = &groups[j];
            let mut waiting = at_leaves[j];
            while waiting != 0 {
                let lane = waiting.trailing_zeros() as usize;
                waiting &= waiting - 1;
                let first = *group.first.get_unchecked(lane) as usize;
                let blocks = *group.blocks.get_unchecked(lane) as usize;
                let ray = *group.ray.get_unchecked(lane);
                for number in first..first + blocks {
                    let block = tree.blocks.get_unchecked(number);
                    let limit = *limits.get_unchecked(j).get_unchecked(lane);
                    let may_hit = block.candidates::<S>(rays, ray as usize, limit, any_will_do);
                    let enough = may_hit.surely != 0;
                    let mut maybe = if enough {
                        may_hit.surely
                    } else {
                        may_hit.maybe
                    };
                    while maybe != 0 {
                        let place = maybe.trailing_zeros();
                        *candidates.get_unchecked_mut(found) = Candidate {
                            lane: (j * WIDEST + lane) as u32,
                            ray,
                            block: number as u32,
                            place,
                            object: *block.objects().get_unchecked(place as usize),
                            surely: enough,
                        };
                        maybe &= if enough { 0 } else { maybe - 1 };
                        found += 1;
                    }
                    if enough {
                        break;
                    }
                    if found > MOST_CANDIDATES - BLOCK {
                        tests.test(rays, &candidates[..found], limits.as_flattened_mut());
                        found = 0;
                    }
                }
            }
        }
        if found > 0 {
            tests.test(rays, &candidates[..found], limits.as_flattened_mut());
        }
        let mut living = 0;
        each_group!(GROUPS, J => {
            let (place, group) = (&mut places[J], &mut groups[J]);
            let bottom = S::load_u(bottoms[J].as_ptr());
            let limits = &mut limits[J];
            go_on::<S>(place, group, limits, stack, bottom, rays, &mut starts);
            living |= place.alive;
        });
        if living == 0 {
            return;
        }
        // A group's next nodes are asked for while the others take their steps.
        let nodes = tree.nodes.as_ptr();
        let mut fetched = [(S::splat_u(0), S::splat_u(0)); GROUPS];
        each_group!(GROUPS, J => fetched[J] = S::nodes(nodes, places[J].node));
        loop {
            each_group!(GROUPS, J => {
                step(&mut places[J], &mut groups[J], fetched[J], stack, tree);
                fetched[J] = S::nodes(nodes, places[J].node);
            });
            let (mut waiting, mut moving) = (0, 0);
            each_group!(GROUPS, J => {
                waiting += places[J].waiting().count_ones();
                moving |= S::bits(places[J].active);
            });
            if waiting >= enough || moving == 0 {
                break;
            }
        }
    }
}

/// Lets waiting lanes go on with the next node that waits; with a new ray where there is none, or
/// where what waits begins beyond the limit.
#[inline(always)]
unsafe fn go_on<S: Simd>(
    place: &mut Place<S>,
    group: &mut Group,
    limits: &mut [f32; WIDEST],
    stack: *const Waiting,
    bottom: S::U,
    rays: &LaneRays,
    waiting_rays: &mut &[Start],
) {
    let waiting = place.waiting();
    if waiting == 0 {
        return;
    }
    let entry = S::splat_u(Waiting::PLACES);
    let thickness = S::splat(2.0 * rays.thick);
    let wx = S::mul(S::abs(S::load(group.inverse[0].as_ptr())), thickness);
    let wy = S::mul(S::abs(S::load(group.inverse[1].as_ptr())), thickness);
    let wz = S::mul(S::abs(S::load(group.inverse[2].as_ptr())), thickness);
    let limit = S::load(limits.as_ptr());
    // No plane on the stack is met before the end of the cell that was left, but for its thickness.
    let widest = S::max(wx, S::max(wy, wz));
    let over = S::le(limit, S::sub(place.exit, widest));
    let done = S::bits(S::or(S::eq_u(place.top, bottom), over)) & waiting;
    let pops = S::mask(waiting & !done);
    place.top = S::select_u(pops, S::sub_u(place.top, entry), place.top);
    let (node, t_enter, t_exit) = S::pop(stack, place.top);
    place.enter = S::select(pops, t_enter, place.enter);
    place.exit = S::select(pops, t_exit, place.exit);
    place.node = S::select_u(pops, node, place.node);
    // A node beyond the limit is dropped, and its lane waits on.
    let goes = S::and(S::le(place.enter, limit), pops);
    place.active = S::or(place.active, goes);
    let blocks = S::load_u(group.blocks.as_ptr());
    let none = S::select_u(S::mask(waiting), S::splat_u(0), blocks);
    S::store_u(group.blocks.as_mut_ptr(), none);
    if done == 0 {
        return;
    }
    let (mut ended, mut begun) = (done, 0);
    while ended != 0
        && let Some((start, others)) = waiting_rays.split_first()
    {
        let lane = ended.trailing_zeros() as usize;
        ended &= ended - 1;
        *waiting_rays = others;
        group.begin(lane, rays, start);
        *limits.get_unchecked_mut(lane) = start.t_exit;
        begun |= 1 << lane;
    }
    place.alive &= !ended;
    let begun = S::mask(begun);
    place.active = S::or(place.active, begun);
    place.enter = S::select(begun, S::load(group.t_enter.as_ptr()), place.enter);
    place.exit = S::select(begun, S::load(group.t_exit.as_ptr()), place.exit);
    place.node = S::select_u(begun, S::splat_u(0), place.node);
    place.top = S::select_u(begun, bottom, place.top);
}

/// Lets lanes at an inner node go to a child, and lanes at a leaf wait.
#[inline(always)]
unsafe fn step<S: Simd, B: Block>(
    place: &mut Place<S>,
    group: &mut Group,
    (payload, word): (S::U, S::U),
    stack: *mut Waiting,
    tree: &Prepared<B>,
) {
    #[repr(align(64))]
    struct Firsts([u32; WIDEST]);
    let (one, two) = (S::splat_u(1), S::splat_u(2));
    let (is_1, is_2) = (S::test_u(word, one), S::test_u(word, two));
    let mask = S::and(S::and(is_1, is_2), place.active);
    let leaves = S::bits(mask);
    if leaves != 0 {
        place.active = S::and_not(place.active, mask);
        let first = S::select_u(mask, payload, S::load_u(group.first.as_ptr()));
        S::store_u(group.first.as_mut_ptr(), first);
        let blocks = S::shr_u::<2>(word);
        let mut full = S::bits(S::test_u(blocks, S::splat_u(u32::MAX))) & leaves;
        let blocks = S::select_u(mask, blocks, S::load_u(group.blocks.as_ptr()));
        S::store_u(group.blocks.as_mut_ptr(), blocks);
        let mut firsts = Firsts([0; WIDEST]);
        S::store_u(firsts.0.as_mut_ptr(), payload);
        while full != 0 {
            let lane = full.trailing_zeros() as usize;
            full &= full - 1;
            prefetch(
                tree.blocks
                    .as_ptr()
                    .add(*firsts.0.get_unchecked(lane) as usize),
            );
        }
    }
    let act = place.active;
    let shifted = by_axis::<S>(&group.shifted, is_1, is_2);
    let inverse = by_axis::<S>(&group.inverse, is_1, is_2);
    let begins = S::mul(S::sub(S::from_bits(payload), shifted), inverse);
    let ends = S::mul_add(S::abs(inverse), S::splat(2.0 * tree.thick), begins);
    let backward = S::shr_u::<31>(S::bits_of(inverse));
    let near = S::add_u(S::shr_u::<PLACE>(word), backward);
    let far = S::xor_u(near, one);
    let near_flag = S::shl_by_u(S::splat_u(BELOW_EMPTY), backward);
    let far_flag = S::xor_u(near_flag, S::splat_u(BELOW_EMPTY | ABOVE_EMPTY));
    let near_empty = S::test_u(word, near_flag);
    let far_empty = S::test_u(word, far_flag);
    let only_far = S::lt(ends, place.enter);
    let both = S::and_not(S::and(S::le(begins, place.exit), act), only_far);
    let skip = S::and(both, near_empty);
    let take = S::and_not(both, near_empty);
    let push = S::and_not(take, far_empty);
    let after = S::max(place.enter, begins);
    S::push(stack, place.top, far, after, place.exit);
    let entry = S::splat_u(Waiting::PLACES);
    place.top = S::select_u(push, S::add_u(place.top, entry), place.top);
    place.enter = S::select(skip, after, place.enter);
    place.exit = S::select(take, S::min(place.exit, ends), place.exit);
    let to_far = S::or(only_far, skip);
    let next = S::select_u(to_far, far, near);
    place.node = S::select_u(act, next, place.node);
}

/// Asks for a block before it is needed.
#[inline(always)]
unsafe fn prefetch<B>(block: *const B) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let block = block.cast::<i8>();
        let mut line = 0;
        while line < size_of::<B>() {
            _mm_prefetch::<_MM_HINT_T0>(block.add(line));
            line += 64;
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = block;
}
