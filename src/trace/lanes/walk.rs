//! The walk of many rays at once, one a lane: each with its own node and stack.
//!
//! Lanes come in groups of a vector each, several of which take their steps in turn, so that one
//! group's nodes are on their way from memory while another computes. A lane that comes to a leaf
//! waits; when enough wait, their leaves are held against their rays, what may be hit is tested, and
//! they go on with what is on their stacks or with new rays.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::block::{BLOCK, Block};
use super::leaves::{Leaf, Leaves, prefetch};
use super::prepare::{ABOVE_EMPTY, BELOW_EMPTY, LEAF, PLACE, Prepared};
use super::ray::{Column, LaneRays, PART, PARTS};
use super::simd::{Simd, WIDEST};
use super::stacks::{Notes, Stacks};
use super::supply::Supply;
use std::hint::select_unpredictable;
use std::ops::Range;

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
}

/// Objects of a block that the ray of a lane may hit.
#[derive(Clone, Copy, Default)]
struct Match {
    lane: u32,
    ray: u32,
    block: u32,
    /// A bit for each.
    maybe: u32,
}

/// The exact tests of the few objects that rays may hit.
pub(super) trait Tests {
    /// Whether one hit is enough, and it does not matter where.
    fn any_will_do(&self) -> bool;

    /// The rays of a part begin.
    fn begin(&mut self, rays: &LaneRays, part: usize);

    /// They are all done: there is nothing more to test for them.
    fn end(&mut self, rays: &LaneRays, part: usize);

    /// That rays hit something is certain, if not where: those in these slots.
    fn hit(&mut self, rays: &LaneRays, slots: &[u32]);

    /// Tests objects, and lowers the limits of rays that are hit: the distances in the unit frame
    /// beyond which nothing matters any more, −1 where nothing does at all.
    fn test(&mut self, rays: &LaneRays, candidates: &[Candidate], limits: &mut [f32]);
}

/// The most groups there are room for.
const MOST_GROUPS: usize = 5;

/// Room for a leaf of every lane, and a vector more.
const LEAVES: usize = WIDEST * (MOST_GROUPS + 1);

/// What a group's lanes hold of their rays.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
struct Group {
    shifted: [[f32; WIDEST]; 3],
    inverse: [[f32; WIDEST]; 3],
    /// The lane's ray.
    ray: [u32; WIDEST],
}

impl Group {
    const NEW: Group = Group {
        shifted: [[0.0; WIDEST]; 3],
        inverse: [[1.0; WIDEST]; 3],
        ray: [0; WIDEST],
    };
}

/// The lanes of all groups.
const NUMBERS: [[u32; WIDEST]; MOST_GROUPS] = {
    let mut numbers = [[0; WIDEST]; MOST_GROUPS];
    let mut k = 0;
    while k < MOST_GROUPS * WIDEST {
        numbers[k / WIDEST][k % WIDEST] = k as u32;
        k += 1;
    }
    numbers
};

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

/// Walks rays through a tree in `GROUPS` groups of lanes: first those made ready, `ahead` of them, then
/// others of the call as parts become free.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(super) unsafe fn walk<S: Simd, B: Block, const GROUPS: usize>(
    tree: &Prepared<B>,
    rays: &mut LaneRays,
    mut ahead: Range<usize>,
    supply: &mut Supply<'_>,
    stacks: &mut Stacks,
    candidates: &mut Vec<Candidate>,
    tests: &mut dyn Tests,
) {
    const { assert!(GROUPS <= MOST_GROUPS && S::LANES <= WIDEST) };
    stacks.reserve(GROUPS * S::LANES, tree.most_waiting + 1);
    let mut notes = stacks.notes();
    let mut bottoms = [[0_u32; WIDEST]; MOST_GROUPS];
    for (j, bottoms) in bottoms.iter_mut().enumerate() {
        for (lane, bottom) in bottoms.iter_mut().enumerate() {
            *bottom = stacks.bottom(j * S::LANES + lane);
        }
    }
    let all = (1_u32 << S::LANES) - 1;
    let mut groups = [Group::NEW; GROUPS];
    let mut places: [Place<S>; GROUPS] = std::array::from_fn(|j| Place {
        node: S::splat_u(0),
        top: S::load_u(bottoms[j].as_ptr()),
        enter: S::splat(0.0),
        exit: S::splat(-1.0),
        alive: 0,
        active: S::mask(0),
    });
    if !ahead.is_empty() {
        each_group!(GROUPS, J => places[J].alive = all);
    }
    let mut limits = [[-1.0_f32; WIDEST]; GROUPS];
    candidates.resize(GROUPS * S::LANES * BLOCK, Candidate::default());
    let mut leaves = Leaves::new();
    let mut matches = [Match::default(); LEAVES];
    let mut certain = [0_u32; LEAVES];
    let any_will_do = tests.any_will_do();
    // A round of tests is worth its while once so many lanes wait.
    let enough = (GROUPS * S::LANES * 5 / 8) as u32;

    loop {
        leaves.ask_all(tree.blocks.as_ptr());
        // A block of every leaf, then the next of those that have more.
        while leaves.len() > 0 {
            let (mut matched, mut sure, mut going_on) = (0, 0, 0);
            for k in 0..leaves.len() {
                let leaf = leaves.get(k);
                let (number, block_number) = (leaf.lane, leaf.block);
                let (j, lane) = (number as usize / WIDEST, number as usize % WIDEST);
                let group = groups.get_unchecked(j);
                let ray = *group.ray.get_unchecked(lane);
                let block = tree.blocks.get_unchecked(block_number as usize);
                let limit = limits.get_unchecked_mut(j).get_unchecked_mut(lane);
                // Or the same again: nothing predicts whether the leaf has more.
                let next = block_number as usize + usize::from(leaf.left > 1);
                prefetch(tree.blocks.as_ptr().add(next));
                let may_hit = block.candidates::<S>(rays, ray as usize, *limit, any_will_do);
                let surely = may_hit.surely != 0;
                // Written in any case, and counted where it holds: a branch that waits for the block to be
                // decided, and is foretold wrong, would undo the work on all blocks after it.
                *certain.get_unchecked_mut(sure) = ray;
                *limit = select_unpredictable(surely, -1.0, *limit);
                sure += usize::from(surely);
                *matches.get_unchecked_mut(matched) = Match {
                    lane: number,
                    ray,
                    block: block_number,
                    maybe: may_hit.maybe,
                };
                matched += usize::from((may_hit.maybe != 0) & !surely);
                let rest = Leaf {
                    block: block_number + 1,
                    left: leaf.left - 1,
                    ..leaf
                };
                leaves.set(going_on, rest);
                going_on += usize::from((rest.left > 0) & !surely);
            }
            if sure > 0 {
                tests.hit(rays, &certain[..sure]);
            }
            let found = list(&matches[..matched], &tree.blocks, candidates);
            if found > 0 {
                tests.test(rays, &candidates[..found], limits.as_flattened_mut());
            }
            leaves.truncate(going_on);
        }
        stacks.settle(&mut notes);
        while ahead.len() < GROUPS * S::LANES && !supply.is_empty() {
            let Some(part) = free_part(rays, ahead.clone(), &places, &groups) else {
                break;
            };
            rays.starts.keep_from(ahead.start);
            supply.refill::<S>(rays, part, tests);
            ahead = 0..rays.starts.count;
            each_group!(GROUPS, J => places[J].alive = all);
        }
        let mut living = 0;
        let begun = ahead.start;
        each_group!(GROUPS, J => {
            let (place, group) = (&mut places[J], &mut groups[J]);
            let bottom = S::load_u(bottoms[J].as_ptr());
            let limits = &mut limits[J];
            go_on::<S>(place, group, limits, stacks, bottom, rays, &mut ahead);
            living += place.alive.count_ones();
        });
        if living == 0 {
            return;
        }
        supply.ask(ahead.start - begun);
        // Or once nothing else is left to do.
        let fewest = living.saturating_sub(enough);
        // A group's next nodes are asked for while the others take their steps.
        let nodes = tree.nodes.as_ptr();
        let mut fetched = [(S::splat_u(0), S::splat_u(0)); GROUPS];
        each_group!(GROUPS, J => fetched[J] = S::nodes(nodes, places[J].node));
        loop {
            each_group!(GROUPS, J => {
                let lanes = S::load_u(NUMBERS[J].as_ptr());
                step(&mut places[J], &groups[J], lanes, fetched[J], &mut notes, &mut leaves, tree);
                fetched[J] = S::nodes(nodes, places[J].node);
            });
            let mut moving = 0;
            each_group!(GROUPS, J => {
                moving += S::bits(places[J].active).count_ones();
            });
            if moving <= fewest {
                break;
            }
        }
    }
}

/// Lists the objects of blocks that rays may hit one by one; gives how many there are.
///
/// # Safety
/// There is room for them, and every block has one.
#[inline(always)]
unsafe fn list<B: Block>(matches: &[Match], blocks: &[B], candidates: &mut [Candidate]) -> usize {
    let mut found = 0;
    for &Match {
        lane,
        ray,
        block,
        mut maybe,
    } in matches
    {
        let objects = blocks.get_unchecked(block as usize).objects();
        loop {
            let place = maybe.trailing_zeros() % BLOCK as u32;
            *candidates.get_unchecked_mut(found) = Candidate {
                lane,
                ray,
                block,
                place,
                object: *objects.get_unchecked(place as usize),
            };
            found += 1;
            maybe &= maybe.wrapping_sub(1);
            if maybe == 0 {
                break;
            }
        }
    }
    found
}

/// A part of rays none of which is in a lane or ahead.
fn free_part<S: Simd>(
    rays: &LaneRays,
    ahead: Range<usize>,
    places: &[Place<S>],
    groups: &[Group],
) -> Option<usize> {
    let mut used = [false; PARTS];
    for &ray in &rays.starts.ray[ahead] {
        used[ray as usize / PART] = true;
    }
    for (place, group) in places.iter().zip(groups) {
        for (lane, &ray) in group.ray.iter().enumerate() {
            used[ray as usize / PART] |= place.alive >> lane & 1 != 0;
        }
    }
    used.iter().position(|used| !used)
}

/// Lets waiting lanes go on with the next node that waits; with a new ray where there is none, or
/// where what waits begins beyond the limit.
#[inline(always)]
unsafe fn go_on<S: Simd>(
    place: &mut Place<S>,
    group: &mut Group,
    limits: &mut [f32; WIDEST],
    stacks: &Stacks,
    bottom: S::U,
    rays: &LaneRays,
    ahead: &mut Range<usize>,
) {
    let waiting = place.waiting();
    if waiting == 0 {
        return;
    }
    let entry = S::splat_u(1);
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
    let (node, t_enter, t_exit) = stacks.at::<S>(place.top);
    place.enter = S::select(pops, t_enter, place.enter);
    place.exit = S::select(pops, t_exit, place.exit);
    place.node = S::select_u(pops, node, place.node);
    // A node beyond the limit is dropped, and its lane waits on.
    let goes = S::and(S::le(place.enter, limit), pops);
    place.active = S::or(place.active, goes);
    if done == 0 {
        return;
    }
    let starts = &rays.starts;
    let mut begins = done;
    while begins.count_ones() as usize > ahead.len() {
        begins &= begins - 1;
    }
    place.alive &= !(done ^ begins);
    let first = ahead.start;
    ahead.start += begins.count_ones() as usize;
    let begins = S::mask(begins);
    let columns = [
        (&starts.shifted, &mut group.shifted),
        (&starts.inverse, &mut group.inverse),
    ];
    for (starts, lanes) in columns {
        for k in 0..3 {
            let lane = lanes[k].as_mut_ptr();
            S::store_u(
                lane.cast(),
                S::bits_of(expanded::<S>(begins, &starts[k], first, S::load(lane))),
            );
        }
    }
    let limits = limits.as_mut_ptr().cast();
    S::store_u(
        limits,
        S::bits_of(expanded::<S>(begins, &starts.t_exit, first, limit)),
    );
    let ray = group.ray.as_mut_ptr();
    let from = starts.ray.as_ptr().add(first);
    S::store_u(ray, S::expand(begins, from, S::load_u(ray)));
    place.active = S::or(place.active, begins);
    place.enter = expanded::<S>(begins, &starts.t_enter, first, place.enter);
    place.exit = expanded::<S>(begins, &starts.t_exit, first, place.exit);
    place.node = S::select_u(begins, S::splat_u(0), place.node);
    place.top = S::select_u(begins, bottom, place.top);
}

/// Gives the lanes of a mask the numbers of a column from `first` on, and the others their own.
#[inline(always)]
unsafe fn expanded<S: Simd>(mask: S::M, column: &Column<f32>, first: usize, own: S::F) -> S::F {
    let from = column.as_ptr().add(first).cast();
    S::from_bits(S::expand(mask, from, S::bits_of(own)))
}

/// Lets lanes at an inner node go to a child, and lanes at a leaf wait.
#[inline(always)]
unsafe fn step<S: Simd, B: Block>(
    place: &mut Place<S>,
    group: &Group,
    lanes: S::U,
    (payload, word): (S::U, S::U),
    notes: &mut Notes,
    leaves: &mut Leaves<LEAVES>,
    tree: &Prepared<B>,
) {
    let one = S::splat_u(1);
    let (is_1, is_2) = (S::bit_u::<0>(word), S::bit_u::<1>(word));
    let mask = S::and(S::and(is_1, is_2), place.active);
    place.active = S::and_not(place.active, mask);
    let full = S::and_not(mask, S::eq_u(word, S::splat_u(LEAF)));
    leaves.push::<S>(full, lanes, payload, S::shr_u::<2>(word));
    leaves.ask(tree.blocks.as_ptr());
    let act = place.active;
    let shifted = by_axis::<S>(&group.shifted, is_1, is_2);
    let inverse = by_axis::<S>(&group.inverse, is_1, is_2);
    let begins = S::mul(S::sub(S::from_bits(payload), shifted), inverse);
    let ends = S::mul_add(S::abs(inverse), S::splat(2.0 * tree.thick), begins);
    let backward = S::shr_u::<31>(S::bits_of(inverse));
    let near = S::add_u(S::shr_u::<PLACE>(word), backward);
    let far = S::xor_u(near, one);
    const { assert!(ABOVE_EMPTY == BELOW_EMPTY << 1) };
    let (near_empty, far_empty) = S::bits_by_u::<{ BELOW_EMPTY.trailing_zeros() }>(word, backward);
    let only_far = S::lt(ends, place.enter);
    let both = S::and_not(S::and(S::le(begins, place.exit), act), only_far);
    let skip = S::and(both, near_empty);
    let take = S::and_not(both, near_empty);
    let push = S::and_not(take, far_empty);
    let after = S::max(place.enter, begins);
    notes.push::<S>(push, place.top, far, after, place.exit);
    place.top = S::select_u(push, S::add_u(place.top, one), place.top);
    place.enter = S::select(skip, after, place.enter);
    place.exit = S::select(take, S::min(place.exit, ends), place.exit);
    let to_far = S::or(only_far, skip);
    let next = S::select_u(to_far, far, near);
    place.node = S::select_u(act, next, place.node);
}
