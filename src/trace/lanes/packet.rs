//! The walk of packets: as many rays as there are lanes go through the tree together, on one stack.
//!
//! A node is read once for all of them, and a plane or an object is held against all at once; so rays
//! that take much the same way, as those of neighbouring pixels do, cost little. Rays may go any way:
//! those that meet the children of a node in the other order than the first of their packet still have
//! their own intervals of distances, and only come to some leaves later than they could.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::block::{BLOCK, Block, MayHit, SHEARED_ERROR};
use super::prepare::{ABOVE_EMPTY, BELOW_EMPTY, LEAF, Node, PLACE, Prepared};
use super::ray::{HALF, LaneRays};
use super::simd::{Simd, WIDEST};
use super::three;
use super::walk::{Candidate, Tests};
use std::ops::Range;

/// Candidates that are tested at once, at most; a block adds up to [`BLOCK`] a ray.
const MOST_CANDIDATES: usize = 256;

type Numbers = [f32; WIDEST];

/// The rays of a packet, number by number; see [`super::ray::LaneRay`].
#[repr(C, align(64))]
pub(super) struct Packet {
    pub(super) origin: [Numbers; 3],
    pub(super) direction: [Numbers; 3],
    pub(super) inverse: [Numbers; 3],
    /// The origin as planes are met from it.
    pub(super) shifted: [Numbers; 3],
    pub(super) t_min: Numbers,
    pub(super) t_max: Numbers,
    pub(super) reach: Numbers,
    /// Where rays enter and leave the scene.
    t_enter: Numbers,
    t_exit: Numbers,
    /// Half the thickness of planes.
    pub(super) thick: f32,
    /// Whether the axis of the largest component is the same for all rays.
    is_one_axis: bool,
    /// If it is.
    pub(super) bundle: Bundle,
    /// The rays' places among those made ready.
    ray: [u32; WIDEST],
    /// Lanes that have a ray.
    lanes: u32,
}

impl Packet {
    const NEW: Packet = Packet {
        origin: [[0.0; WIDEST]; 3],
        direction: [[1.0; WIDEST]; 3],
        inverse: [[1.0; WIDEST]; 3],
        shifted: [[0.0; WIDEST]; 3],
        t_min: [0.0; WIDEST],
        t_max: [-1.0; WIDEST],
        reach: [0.0; WIDEST],
        t_enter: [0.0; WIDEST],
        t_exit: [-1.0; WIDEST],
        thick: 0.0,
        is_one_axis: true,
        bundle: Bundle {
            axes: [0, 1, 2],
            origin: [[0.0; 2]; 3],
            shear: [[0.0; 2]; 2],
            error: 0.0,
        },
        ray: [0; WIDEST],
        lanes: 0,
    };

    /// Takes other rays of those that meet the scene, from the `first` on, as many as there are lanes at
    /// most, and at least one.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn begin<S: Simd>(&mut self, rays: &LaneRays, first: usize, count: usize) {
        let starts = &rays.starts;
        let one = &rays.rays[starts.ray[first] as usize];
        self.thick = rays.thick;
        self.lanes = ((1_u64 << count) - 1) as u32;
        // Lanes beyond the last ray get what no one asks about.
        S::store_u(
            self.ray.as_mut_ptr(),
            S::load_u(starts.ray.as_ptr().add(first)),
        );
        copy::<S>(&mut self.t_enter, starts.t_enter.as_ptr().add(first));
        copy::<S>(&mut self.t_exit, starts.t_exit.as_ptr().add(first));
        for k in 0..3 {
            copy::<S>(&mut self.shifted[k], starts.shifted[k].as_ptr().add(first));
            copy::<S>(&mut self.inverse[k], starts.inverse[k].as_ptr().add(first));
        }
        if count == S::LANES && self.ray[count - 1] - self.ray[0] == count as u32 - 1 {
            // Neighbours in memory.
            let from = rays.rays.as_ptr().add(self.ray[0] as usize).cast::<f32>();
            let [ox, oy, oz, dx, dy, dz, t_min, t_max] = S::columns(from);
            let [.., reach, axis, _, _, _] = S::columns(from.add(HALF));
            for (to, from) in self.origin.iter_mut().zip([ox, oy, oz]) {
                store::<S>(to, from);
            }
            for (to, from) in self.direction.iter_mut().zip([dx, dy, dz]) {
                store::<S>(to, from);
            }
            store::<S>(&mut self.t_min, t_min);
            store::<S>(&mut self.t_max, t_max);
            store::<S>(&mut self.reach, reach);
            let same = S::eq_u(S::bits_of(axis), S::splat_u(one.axis));
            self.is_one_axis = self.lanes & !S::bits(same) == 0;
            if self.is_one_axis {
                self.tie::<S>(one.turned_axes());
            }
            return;
        }
        self.is_one_axis = true;
        for lane in 0..count {
            let ray = &rays.rays[self.ray[lane] as usize];
            for k in 0..3 {
                self.origin[k][lane] = ray.origin[k];
                self.direction[k][lane] = ray.direction[k];
            }
            self.t_min[lane] = ray.t_min;
            self.t_max[lane] = ray.t_max;
            self.reach[lane] = ray.reach;
            self.is_one_axis &= ray.axis == one.axis;
        }
        if self.is_one_axis {
            self.tie::<S>(one.turned_axes());
        }
    }

    /// Finds the bounds of all rays.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn tie<S: Simd>(&mut self, axes: [usize; 3]) {
        let lanes = S::mask(self.lanes);
        let along = S::load(self.inverse[axes[2]].as_ptr());
        let dx = S::load(self.direction[axes[0]].as_ptr());
        let dy = S::load(self.direction[axes[1]].as_ptr());
        self.bundle = Bundle {
            axes,
            origin: [
                bounds::<S>(S::load(self.origin[axes[0]].as_ptr()), lanes),
                bounds::<S>(S::load(self.origin[axes[1]].as_ptr()), lanes),
                bounds::<S>(S::load(self.origin[axes[2]].as_ptr()), lanes),
            ],
            shear: [
                bounds::<S>(S::mul(dx, along), lanes),
                bounds::<S>(S::mul(dy, along), lanes),
            ],
            error: SHEARED_ERROR * bounds::<S>(S::load(self.reach.as_ptr()), lanes)[1],
        };
    }
}

/// Bounds of all rays of a packet that have the axis of their largest component in common.
pub(super) struct Bundle {
    /// The axes in cyclic order, that of the largest component last.
    pub(super) axes: [usize; 3],
    /// Least and most, along these axes.
    pub(super) origin: [[f32; 2]; 3],
    /// Least and most of the first two components over the last.
    pub(super) shear: [[f32; 2]; 2],
    /// Of a coordinate less what it is sheared by.
    pub(super) error: f32,
}

/// Least and most of some lanes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn bounds<S: Simd>(x: S::F, lanes: S::M) -> [f32; 2] {
    let none = S::splat(f32::NEG_INFINITY);
    let least = S::greatest(S::select(lanes, S::sub(S::splat(0.0), x), none));
    [-least, S::greatest(S::select(lanes, x, none))]
}

/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn store<S: Simd>(to: &mut Numbers, x: S::F) {
    S::store_u(to.as_mut_ptr().cast(), S::bits_of(x));
}

/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn copy<S: Simd>(to: &mut Numbers, from: *const f32) {
    store::<S>(to, S::load(from));
}

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
        *self.candidates.get_unchecked_mut(self.count) = candidate;
        self.count += 1;
    }

    /// Tests what there is, if there is no room for another block.
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
        S::bits(S::test_u(inverse, S::splat_u(1 << 31))) & packet.lanes
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
                    S::store_u(aside.enter.as_mut_ptr().cast(), S::bits_of(second.enter));
                    S::store_u(aside.exit.as_mut_ptr().cast(), S::bits_of(second.exit));
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
    for number in from..to {
        let block = tree.blocks.get_unchecked(number as usize);
        let objects = block.objects();
        let candidate = |lane: u32, place: u32, surely| Candidate {
            lane,
            ray: packet.ray[lane as usize],
            block: number,
            place,
            object: objects[place as usize],
            surely,
        };
        let mut near = u32::MAX;
        if packet.is_one_axis {
            near = block.near::<S>(&packet.bundle);
        }
        // Every object against all rays, or every ray against all objects, whichever is less.
        if packet.is_one_axis && lanes.count_ones() >= near.count_ones() {
            while near != 0 {
                let place = near.trailing_zeros();
                near &= near - 1;
                let may_hit = block.rays_that_may_hit::<S>(
                    place as usize,
                    packet,
                    S::load(limits.as_ptr()),
                    any_will_do,
                );
                let surely = may_hit.surely & lanes;
                let mut maybe = may_hit.maybe & lanes;
                lanes &= !surely;
                while maybe != 0 {
                    let lane = maybe.trailing_zeros();
                    maybe &= maybe - 1;
                    found.add(candidate(lane, place, surely >> lane & 1 != 0));
                }
                found.make_room(limits);
            }
        } else {
            let mut ahead = lanes;
            while ahead != 0 {
                let lane = ahead.trailing_zeros();
                ahead &= ahead - 1;
                let ray = packet.ray[lane as usize] as usize;
                let limit = limits[lane as usize];
                let MayHit { mut maybe, surely } =
                    block.candidates::<S>(found.rays, ray, limit, any_will_do);
                if surely != 0 {
                    lanes &= !(1 << lane);
                    found.add(candidate(lane, surely.trailing_zeros(), true));
                    continue;
                }
                while maybe != 0 {
                    found.add(candidate(lane, maybe.trailing_zeros(), false));
                    maybe &= maybe - 1;
                }
                found.make_room(limits);
            }
        }
    }
    found.test(limits);
}
