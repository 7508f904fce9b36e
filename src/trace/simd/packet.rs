//! The traversal of packets: as many rays as there are lanes traverse the tree together, with one stack.
//!
//! A node is loaded once for all rays, and a plane or an object is tested against all of them at once. So
//! coherent rays, such as those of neighboring pixels, are fast. Incoherent rays stay correct: each has its
//! own interval. A ray that meets the children of a node in the other order than the first ray of its
//! packet merely visits some leaves later than it could.
//!
//! ```text
//! for each packet:
//!     visit = root, all rays, their intervals within the scene's box
//!     loop:
//!         inner node: split rays and intervals at the plane into those of the first and the second child
//!             (first and second by the direction of the packet's first ray)
//!             both have rays: push the second; visit the first
//!             one has rays:   visit it
//!         leaf: for each block:
//!             near = objects that some ray may hit, by bounds of all rays
//!             fewer objects than rays: each object against all rays
//!             else:                    each ray against all objects
//!             exact tests of the candidates; hits lower the limits of their rays
//!         no child visited: pop a node that begins before the limit of some ray, or end
//! ```
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::{Simd, WIDEST};
use super::array::three;
use super::block::{Block, HitMasks};
use super::candidate::{Candidate, ExactTests};
use super::prefetch::prefetch;
use super::queue::RayQueue;
use super::ray::RayBuffer;
use super::ray_packet::{Lanes, Packet, store};
use crate::structure::simd_tree::{
    ABOVE_EMPTY, BELOW_EMPTY, CHILD_SHIFT, IN_PLANES, LEAF, Node, PlaneTree,
};
use std::ops::Range;

/// Maximum number of pending candidates. A ray adds up to a block, and an
/// object up to one per lane.
const MAX_CANDIDATES: usize = 256;
const _: () = assert!(IN_PLANES >= WIDEST);

/// A pending node: the lanes that visit it, and the intervals of their rays within its cell.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct PendingNode {
    enter: Lanes,
    exit: Lanes,
    node: u32,
    lanes: u32,
}

impl PendingNode {
    const NONE: PendingNode = PendingNode {
        enter: [0.0; WIDEST],
        exit: [0.0; WIDEST],
        node: 0,
        lanes: 0,
    };
}

/// The lanes that visit a node, and the intervals of their rays within its cell.
#[derive(Clone, Copy)]
struct Visit<S: Simd> {
    lanes: u32,
    enter: S::F,
    exit: S::F,
}

impl<S: Simd> Visit<S> {
    /// Returns `self` in the given lanes and `other` in all others.
    #[inline(always)]
    unsafe fn select(self, other: Visit<S>, lanes: u32) -> Visit<S> {
        let mask = S::mask_from_bits(lanes);
        Visit {
            lanes: self.lanes & lanes | other.lanes & !lanes,
            enter: S::select(mask, self.enter, other.enter),
            exit: S::select(mask, self.exit, other.exit),
        }
    }
}

/// Candidates of a packet that are pending for exact tests.
struct PendingTests<'a> {
    candidates: [Candidate; MAX_CANDIDATES],
    count: usize,
    coherence: Coherence,
    rays: &'a RayBuffer,
    tests: &'a mut dyn ExactTests,
}

impl PendingTests<'_> {
    /// # Safety
    /// There is room for it.
    #[inline(always)]
    unsafe fn add(&mut self, candidate: Candidate) {
        debug_assert!(self.count < MAX_CANDIDATES);
        *self.candidates.get_unchecked_mut(self.count) = candidate;
        self.count += 1;
    }

    /// Records that the ray in a lane certainly hits something.
    #[inline(always)]
    fn mark_hit(&mut self, packet: &Packet, lane: u32, limits: &mut Lanes) {
        let lane = lane as usize;
        self.tests.mark_hit(self.rays, &[packet.ray[lane]]);
        limits[lane] = -1.0;
    }

    /// Tests all candidates if there is no room for those that another ray or object may add.
    #[inline(always)]
    fn make_room(&mut self, limits: &mut Lanes) {
        if self.count > MAX_CANDIDATES - IN_PLANES {
            self.test(limits);
        }
    }

    /// Tests all candidates.
    #[inline(always)]
    fn test(&mut self, limits: &mut Lanes) {
        if self.count > 0 {
            self.tests
                .test(self.rays, &self.candidates[..self.count], limits);
            self.count = 0;
        }
    }
}

/// How coherent the rays of packets were.
#[derive(Clone, Copy, Default)]
pub(super) struct Coherence {
    /// Nodes visited by packets.
    visits: u32,
    /// Sum over those visits of the lanes that took part.
    lanes: u32,
}

impl Coherence {
    /// Returns whether packets are faster than a stream. With five eighths of the lanes in the average
    /// visit both take about as long (`benches/README.md`).
    pub(super) fn favors_packets(self, lanes: usize) -> bool {
        8 * self.lanes as usize >= 5 * self.visits as usize * lanes
    }
}

/// Traces the entering rays in `ahead` through a tree, as packets.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(super) unsafe fn traverse<S: Simd, B: Block>(
    tree: &PlaneTree<B>,
    rays: &RayBuffer,
    ahead: Range<usize>,
    queue: &mut RayQueue<'_>,
    stack: &mut Vec<PendingNode>,
    tests: &mut dyn ExactTests,
) -> Coherence {
    stack.resize(tree.max_pending + 1, PendingNode::NONE);
    let any_hit = tests.any_hit_suffices();
    let mut pending = PendingTests {
        candidates: [Candidate::default(); MAX_CANDIDATES],
        count: 0,
        coherence: Coherence::default(),
        rays,
        tests,
    };
    let mut packet = Packet::NEW;
    for first in ahead.clone().step_by(S::LANES) {
        let count = S::LANES.min(ahead.end - first);
        packet.load::<S>(rays, first, count);
        queue.prefetch(count);
        traverse_packet::<S, B>(tree, &packet, stack, &mut pending, any_hit);
    }
    pending.coherence
}

/// Traces one packet.
#[inline(always)]
unsafe fn traverse_packet<S: Simd, B: Block>(
    tree: &PlaneTree<B>,
    packet: &Packet,
    stack: &mut [PendingNode],
    pending: &mut PendingTests<'_>,
    any_hit: bool,
) {
    let stack = stack.as_mut_ptr();
    let backward = three(|k| {
        let inverse = S::bits_of(S::load(packet.inverse[k].as_ptr()));
        S::mask_bits(S::test_bit_u::<31>(inverse)) & packet.lanes
    });
    // Lanes that meet the children of an axis in another order than the first ray.
    let reversed = three(|k| {
        if backward[k] & 1 == 0 {
            backward[k]
        } else {
            backward[k] ^ packet.lanes
        }
    });
    let thickness = S::splat(2.0 * packet.half_thickness);
    let mut limits = packet.t_exit;
    let mut top = 0;
    let mut at = 0;
    let mut visit = Visit::<S> {
        lanes: packet.lanes,
        enter: S::load(packet.t_enter.as_ptr()),
        exit: S::load(packet.t_exit.as_ptr()),
    };
    let nodes = &*tree.nodes;
    loop {
        pending.coherence.visits += 1;
        pending.coherence.lanes += visit.lanes.count_ones();
        let node = *nodes.get_unchecked(at as usize);
        if node.word & LEAF != LEAF {
            let axis = (node.word & LEAF) as usize;
            let shifted = S::load(packet.shifted.get_unchecked(axis).as_ptr());
            let inverse = S::load(packet.inverse.get_unchecked(axis).as_ptr());
            let plane = S::splat(f32::from_bits(node.payload));
            let begins = S::mul(S::sub(plane, shifted), inverse);
            let ends = S::mul_add(S::abs(inverse), thickness, begins);
            let mut first = Visit::<S> {
                lanes: visit.lanes & !S::mask_bits(S::lt(ends, visit.enter)),
                enter: visit.enter,
                exit: S::min(visit.exit, ends),
            };
            let mut second = Visit::<S> {
                lanes: visit.lanes & S::mask_bits(S::le(begins, visit.exit)),
                enter: S::max(visit.enter, begins),
                exit: visit.exit,
            };
            let reversed = *reversed.get_unchecked(axis) & visit.lanes;
            if reversed != 0 {
                (first, second) = (
                    second.select(first, reversed),
                    first.select(second, reversed),
                );
            }
            let above_first = *backward.get_unchecked(axis) & 1;
            let below = node.word >> CHILD_SHIFT;
            let first_empty = BELOW_EMPTY << above_first;
            let second_empty = (BELOW_EMPTY | ABOVE_EMPTY) ^ first_empty;
            let go_first = first.lanes != 0 && node.word & first_empty == 0;
            let go_second = second.lanes != 0 && node.word & second_empty == 0;
            let (near, far) = (below + above_first, below + (above_first ^ 1));
            if go_first {
                if go_second {
                    let entry = &mut *stack.add(top);
                    store::<S>(&mut entry.enter, second.enter);
                    store::<S>(&mut entry.exit, second.exit);
                    entry.node = far;
                    entry.lanes = second.lanes;
                    top += 1;
                }
                (at, visit) = (near, first);
                continue;
            }
            if go_second {
                (at, visit) = (far, second);
                continue;
            }
        } else {
            test_leaf::<S, B>(
                tree,
                node,
                visit.lanes,
                packet,
                &mut limits,
                pending,
                any_hit,
            );
        }
        let limit = S::load(limits.as_ptr());
        let next = loop {
            if top == 0 {
                return;
            }
            top -= 1;
            let entry = &*stack.add(top);
            let enter = S::load(entry.enter.as_ptr());
            let lanes = entry.lanes & S::mask_bits(S::le(enter, limit));
            if lanes != 0 {
                let exit = S::load(entry.exit.as_ptr());
                break (entry.node, Visit { lanes, enter, exit });
            }
        };
        (at, visit) = next;
    }
}

/// Tests the objects of a leaf against the rays of some lanes.
#[inline(always)]
unsafe fn test_leaf<S: Simd, B: Block>(
    tree: &PlaneTree<B>,
    leaf: Node,
    mut lanes: u32,
    packet: &Packet,
    limits: &mut Lanes,
    pending: &mut PendingTests<'_>,
    any_hit: bool,
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
            block.candidates_of_bundle::<S>(&packet.bundle)
        } else {
            u32::MAX
        };
        // Each object against all rays, or each ray against all objects, whichever takes fewer tests.
        if packet.is_one_axis && lanes.count_ones() >= near.count_ones() {
            while near != 0 {
                let place = near.trailing_zeros();
                near &= near - 1;
                pending.make_room(limits);
                let masks = block.candidate_rays::<S>(
                    place as usize,
                    packet,
                    S::load(limits.as_ptr()),
                    any_hit,
                );
                let mut certain = masks.certain & lanes;
                let mut possible = masks.possible & lanes & !certain;
                lanes &= !certain;
                while certain != 0 {
                    pending.mark_hit(packet, certain.trailing_zeros(), limits);
                    certain &= certain - 1;
                }
                while possible != 0 {
                    pending.add(candidate(possible.trailing_zeros(), place));
                    possible &= possible - 1;
                }
            }
        } else {
            let mut ahead = lanes;
            while ahead != 0 {
                let lane = ahead.trailing_zeros();
                ahead &= ahead - 1;
                pending.make_room(limits);
                let ray = packet.ray[lane as usize] as usize;
                let limit = limits[lane as usize];
                let HitMasks {
                    mut possible,
                    certain,
                } = block.candidates::<S>(pending.rays, ray, limit, any_hit);
                if certain != 0 {
                    lanes &= !(1 << lane);
                    pending.mark_hit(packet, lane, limits);
                    continue;
                }
                while possible != 0 {
                    pending.add(candidate(lane, possible.trailing_zeros()));
                    possible &= possible - 1;
                }
            }
        }
    }
    pending.test(limits);
}
