//! The walk of packets: as many rays as there are lanes go through the tree together, on one stack.
//!
//! A node is read once for all of them, and a plane or an object is held against all at once; so rays
//! that take much the same way, as those of neighbouring pixels do, cost little. Rays may go any way:
//! those that meet the children of a node in the other order than the first of their packet still have
//! their own intervals of distances, and only come to some leaves later than they could.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

mod rays;

use super::block::{BLOCK, Block, MayHit};
use super::leaves::prefetch;
use super::prepare::{ABOVE_EMPTY, BELOW_EMPTY, LEAF, Node, PLACE, Prepared};
use super::ray::LaneRays;
use super::simd::{Simd, WIDEST};
use super::supply::Supply;
use super::three;
use super::walk::{Candidate, Tests};
pub(super) use rays::{Bundle, Packet};
use rays::{Numbers, store};
use std::ops::Range;

/// Candidates that are tested at once, at most; a block adds up to [`BLOCK`] a ray.
const MOST_CANDIDATES: usize = 256;

/// A node that waits for its turn, the lanes that are to visit it, and where on their rays its cell
/// lies.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct Aside {
    enter: Numbers,
    exit: Numbers,
    node: u32,
    lanes: u32,
}

impl Aside {
    const NONE: Aside = Aside {
        enter: [0.0; WIDEST],
        exit: [0.0; WIDEST],
        node: 0,
        lanes: 0,
    };
}

/// Lanes that are to visit a node, and where on their rays its cell lies.
#[derive(Clone, Copy)]
struct Part<S: Simd> {
    lanes: u32,
    enter: S::F,
    exit: S::F,
}

impl<S: Simd> Part<S> {
    /// This for the lanes of `others`, `that` for all else.
    #[inline(always)]
    unsafe fn or(self, that: Part<S>, others: u32) -> Part<S> {
        let mask = S::mask(others);
        Part {
            lanes: self.lanes & others | that.lanes & !others,
            enter: S::select(mask, self.enter, that.enter),
            exit: S::select(mask, self.exit, that.exit),
        }
    }
}

/// Candidates that wait for their tests.
struct Found<'a> {
    candidates: [Candidate; MOST_CANDIDATES],
    count: usize,
    company: Company,
    rays: &'a LaneRays,
    tests: &'a mut dyn Tests,
}

impl Found<'_> {
    /// # Safety
    /// There is room for it.
    #[inline(always)]
    unsafe fn add(&mut self, candidate: Candidate) {
        debug_assert!(self.count < MOST_CANDIDATES);
        *self.candidates.get_unchecked_mut(self.count) = candidate;
        self.count += 1;
    }

    /// The ray in a lane surely hits something.
    #[inline(always)]
    fn hit(&mut self, packet: &Packet, lane: u32, limits: &mut Numbers) {
        let lane = lane as usize;
        self.tests.hit(self.rays, &[packet.ray[lane]]);
        limits[lane] = -1.0;
    }

    /// Tests what there is, if there is no room for what a block or a packet adds.
    #[inline(always)]
    fn make_room(&mut self, limits: &mut Numbers) {
        if self.count > MOST_CANDIDATES - BLOCK {
            self.test(limits);
        }
    }

    #[inline(always)]
    fn test(&mut self, limits: &mut Numbers) {
        if self.count > 0 {
            self.tests
                .test(self.rays, &self.candidates[..self.count], limits);
            self.count = 0;
        }
    }
}

/// How much the rays of packets kept together.
#[derive(Clone, Copy, Default)]
pub(super) struct Company {
    /// Nodes visited by packets.
    visits: u32,
    /// Lanes that those visits were for.
    lanes: u32,
}

impl Company {
    /// Whether packets are faster than lanes that each go their own way: with five eighths of the lanes
    /// in the average visit both take about as long (`benches/README.md`).
    pub(super) fn is_close(self, lanes: usize) -> bool {
        8 * self.lanes as usize >= 5 * self.visits as usize * lanes
    }
}

/// Walks rays that meet the scene, `ahead` of them, through a tree, as many at once as there are lanes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(super) unsafe fn walk_packets<S: Simd, B: Block>(
    tree: &Prepared<B>,
    rays: &LaneRays,
    ahead: Range<usize>,
    supply: &mut Supply<'_>,
    stack: &mut Vec<Aside>,
    tests: &mut dyn Tests,
) -> Company {
    stack.resize(tree.most_waiting + 1, Aside::NONE);
    let any_will_do = tests.any_will_do();
    let mut found = Found {
        candidates: [Candidate::default(); MOST_CANDIDATES],
        count: 0,
        company: Company::default(),
        rays,
        tests,
    };
    let mut packet = Packet::NEW;
    for first in ahead.clone().step_by(S::LANES) {
        let count = S::LANES.min(ahead.end - first);
        packet.begin::<S>(rays, first, count);
        supply.ask(count);
        walk_packet::<S, B>(tree, &packet, stack, &mut found, any_will_do);
    }
    found.company
}

/// Walks one packet.
#[inline(always)]
unsafe fn walk_packet<S: Simd, B: Block>(
    tree: &Prepared<B>,
    packet: &Packet,
    stack: &mut [Aside],
    found: &mut Found<'_>,
    any_will_do: bool,
) {
    let stack = stack.as_mut_ptr();
    let backward = three(|k| {
        let inverse = S::bits_of(S::load(packet.inverse[k].as_ptr()));
        S::bits(S::bit_u::<31>(inverse)) & packet.lanes
    });
    // Lanes that meet the children of an axis in another order than the first.
    let others = three(|k| {
        if backward[k] & 1 == 0 {
            backward[k]
        } else {
            backward[k] ^ packet.lanes
        }
    });
    let thickness = S::splat(2.0 * packet.thick);
    let mut limits = packet.t_exit;
    let mut waiting = 0;
    let mut at = 0;
    let mut now = Part::<S> {
        lanes: packet.lanes,
        enter: S::load(packet.t_enter.as_ptr()),
        exit: S::load(packet.t_exit.as_ptr()),
    };
    loop {
        found.company.visits += 1;
        found.company.lanes += now.lanes.count_ones();
        let node = *tree.nodes.get_unchecked(at as usize);
        if node.word & LEAF != LEAF {
            let axis = (node.word & LEAF) as usize;
            let shifted = S::load(packet.shifted.get_unchecked(axis).as_ptr());
            let inverse = S::load(packet.inverse.get_unchecked(axis).as_ptr());
            let plane = S::splat(f32::from_bits(node.payload));
            let begins = S::mul(S::sub(plane, shifted), inverse);
            let ends = S::mul_add(S::abs(inverse), thickness, begins);
            let mut first = Part::<S> {
                lanes: now.lanes & !S::bits(S::lt(ends, now.enter)),
                enter: now.enter,
                exit: S::min(now.exit, ends),
            };
            let mut second = Part::<S> {
                lanes: now.lanes & S::bits(S::le(begins, now.exit)),
                enter: S::max(now.enter, begins),
                exit: now.exit,
            };
            let others = *others.get_unchecked(axis) & now.lanes;
            if others != 0 {
                (first, second) = (second.or(first, others), first.or(second, others));
            }
            let above_first = *backward.get_unchecked(axis) & 1;
            let below = node.word >> PLACE;
            let first_empty = BELOW_EMPTY << above_first;
            let second_empty = (BELOW_EMPTY | ABOVE_EMPTY) ^ first_empty;
            let go_first = first.lanes != 0 && node.word & first_empty == 0;
            let go_second = second.lanes != 0 && node.word & second_empty == 0;
            let (near, far) = (below + above_first, below + (above_first ^ 1));
            if go_first {
                if go_second {
                    let aside = &mut *stack.add(waiting);
                    store::<S>(&mut aside.enter, second.enter);
                    store::<S>(&mut aside.exit, second.exit);
                    aside.node = far;
                    aside.lanes = second.lanes;
                    waiting += 1;
                }
                (at, now) = (near, first);
                continue;
            }
            if go_second {
                (at, now) = (far, second);
                continue;
            }
        } else {
            visit::<S, B>(
                tree,
                node,
                now.lanes,
                packet,
                &mut limits,
                found,
                any_will_do,
            );
        }
        let limit = S::load(limits.as_ptr());
        let next = loop {
            if waiting == 0 {
                return;
            }
            waiting -= 1;
            let aside = &*stack.add(waiting);
            let enter = S::load(aside.enter.as_ptr());
            let lanes = aside.lanes & S::bits(S::le(enter, limit));
            if lanes != 0 {
                let exit = S::load(aside.exit.as_ptr());
                break (aside.node, Part { lanes, enter, exit });
            }
        };
        (at, now) = next;
    }
}

/// Tests the objects of a leaf against the rays of some lanes.
#[inline(always)]
unsafe fn visit<S: Simd, B: Block>(
    tree: &Prepared<B>,
    leaf: Node,
    mut lanes: u32,
    packet: &Packet,
    limits: &mut Numbers,
    found: &mut Found<'_>,
    any_will_do: bool,
) {
    let (from, to) = (leaf.payload, leaf.payload + (leaf.word >> 2));
    prefetch(tree.blocks.as_ptr().add(from as usize));
    for number in from..to {
        if number + 1 < to {
            prefetch(tree.blocks.as_ptr().add(number as usize + 1));
        }
        let block = tree.blocks.get_unchecked(number as usize);
        let objects = block.objects();
        let candidate = |lane: u32, place: u32| Candidate {
            lane,
            ray: packet.ray[lane as usize],
            block: number,
            place,
            object: objects[place as usize],
        };
        let mut near = if packet.is_one_axis {
            block.near::<S>(&packet.bundle)
        } else {
            u32::MAX
        };
        // Every object against all rays, or every ray against all objects, whichever is less.
        if packet.is_one_axis && lanes.count_ones() >= near.count_ones() {
            while near != 0 {
                let place = near.trailing_zeros();
                near &= near - 1;
                found.make_room(limits);
                let may_hit = block.rays_that_may_hit::<S>(
                    place as usize,
                    packet,
                    S::load(limits.as_ptr()),
                    any_will_do,
                );
                let mut surely = may_hit.surely & lanes;
                let mut maybe = may_hit.maybe & lanes & !surely;
                lanes &= !surely;
                while surely != 0 {
                    found.hit(packet, surely.trailing_zeros(), limits);
                    surely &= surely - 1;
                }
                while maybe != 0 {
                    found.add(candidate(maybe.trailing_zeros(), place));
                    maybe &= maybe - 1;
                }
            }
        } else {
            let mut ahead = lanes;
            while ahead != 0 {
                let lane = ahead.trailing_zeros();
                ahead &= ahead - 1;
                found.make_room(limits);
                let ray = packet.ray[lane as usize] as usize;
                let limit = limits[lane as usize];
                let MayHit { mut maybe, surely } =
                    block.candidates::<S>(found.rays, ray, limit, any_will_do);
                if surely != 0 {
                    lanes &= !(1 << lane);
                    found.hit(packet, lane, limits);
                    continue;
                }
                while maybe != 0 {
                    found.add(candidate(lane, maybe.trailing_zeros()));
                    maybe &= maybe - 1;
                }
            }
        }
    }
    found.test(limits);
}
