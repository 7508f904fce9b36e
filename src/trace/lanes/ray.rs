//! Rays as lanes walk and test them: in `f32`, with bounds on what that rounds.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::simd::{Simd, WIDEST};
use super::three;
use crate::geometry::Ray;
use crate::primitive::{FramedRay, UnitFrame};
use std::hint::select_unpredictable;
use std::ops::Range;

/// Rays that are made ready at once.
pub(super) const PART: usize = 256;

/// Parts of rays that there is room for: a part is used again when the last of its rays is done, and
/// others meanwhile.
pub(super) const PARTS: usize = 4;

/// Places for rays that are made ready: what is known of them stays in the cache.
pub(super) const SLOTS: usize = PARTS * PART;

/// What tests want of a ray, in one line of the cache; in the coordinates of the unit frame.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct LaneRay {
    pub(super) origin: [f32; 3],
    /// Its largest component is from ½ to 2.
    pub(super) direction: [f32; 3],
    pub(super) t_min: f32,
    pub(super) t_max: f32,
    /// 1 over the direction, finite.
    pub(super) inverse: [f32; 3],
    /// Bound on how far any coordinate of the scene is from that of the origin.
    pub(super) reach: f32,
    /// The axis of the direction's largest component.
    pub(super) axis: u32,
    /// The first two components over the last, axes turned.
    pub(super) shear: [f32; 2],
    _room: u32,
}

/// Numbers of half a [`LaneRay`].
pub(super) const HALF: usize = 8;

impl LaneRay {
    /// Ends before it begins.
    const NONE: LaneRay = LaneRay {
        origin: [0.0; 3],
        direction: [1.0; 3],
        t_min: 0.0,
        t_max: -1.0,
        inverse: [1.0; 3],
        reach: 0.0,
        axis: 0,
        shear: [0.0; 2],
        _room: 0,
    };

    fn set_uncommon(&mut self, ray: &FramedRay) {
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
        self.set([ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max]);
    }

    #[inline(always)]
    fn set(&mut self, [ox, oy, oz, dx, dy, dz, t_min, t_max]: [f32; HALF]) {
        self.origin = [ox, oy, oz];
        self.direction = [dx, dy, dz];
        (self.t_min, self.t_max) = (t_min, t_max);
    }

    /// The axes in cyclic order, that of the largest component last.
    #[inline(always)]
    pub(super) fn turned_axes(&self) -> [usize; 3] {
        let last = self.axis as usize;
        // As a branch it would often be foretold wrong.
        let next = |k| select_unpredictable(k == 2, 0, k + 1);
        [next(last), next(next(last)), last]
    }

    /// The origin, moved by half the thickness of planes along each axis the way the ray goes: planes
    /// are met where they begin.
    #[inline(always)]
    pub(super) fn shifted(&self, thick: f32) -> [f32; 3] {
        three(|k| self.origin[k] + thick.copysign(self.direction[k]))
    }
}

/// A number for every ray that meets the scene, with room for what vectors write beyond.
pub(super) type Column<T> = [T; SLOTS + WIDEST];

/// What lanes begin rays with that meet the scene, number by number.
pub(super) struct Starts {
    /// [`LaneRay::shifted`].
    pub(super) shifted: [Column<f32>; 3],
    pub(super) inverse: [Column<f32>; 3],
    /// Where the ray is within the scene.
    pub(super) t_enter: Column<f32>,
    pub(super) t_exit: Column<f32>,
    /// The ray's place among those made ready.
    pub(super) ray: Column<u32>,
    pub(super) count: usize,
}

impl Starts {
    /// Keeps those from `first` on.
    pub(super) fn keep_from(&mut self, first: usize) {
        let kept = first..self.count;
        let columns = self.shifted.iter_mut().chain(&mut self.inverse);
        for column in columns.chain([&mut self.t_enter, &mut self.t_exit]) {
            column.copy_within(kept.clone(), 0);
        }
        self.ray.copy_within(kept.clone(), 0);
        self.count = kept.len();
    }
}

/// Rays made ready, in parts.
pub(super) struct LaneRays {
    /// Half the thickness of planes.
    pub(super) thick: f32,
    pub(super) rays: [LaneRay; SLOTS],
    /// Where on the ray in the world this one's origin lies, and distances here per distance there.
    start: [f64; SLOTS],
    scale: [f64; SLOTS],
    /// By part: the numbers that its rays have in the call.
    pub(super) parts: [Range<usize>; PARTS],
    /// Those of the call so far that the unit frame cannot hold, by their numbers in it.
    pub(super) others: Vec<u32>,
    pub(super) starts: Starts,
}

/// What all rays through a tree have in common.
#[derive(Clone, Copy)]
pub(super) struct Root<'a> {
    pub(super) frame: &'a UnitFrame,
    /// Half the thickness of planes.
    pub(super) thick: f32,
    /// The corners of the scene.
    pub(super) corners: &'a [[f32; 3]; 2],
    /// Whether rays that begin before their origin are beyond lanes.
    pub(super) forward_only: bool,
}

impl LaneRays {
    pub(super) fn new() -> Box<LaneRays> {
        const ZERO: Column<f32> = [0.0; SLOTS + WIDEST];
        Box::new(LaneRays {
            thick: 0.0,
            rays: [LaneRay::NONE; SLOTS],
            start: [0.0; SLOTS],
            scale: [1.0; SLOTS],
            parts: [const { 0..0 }; PARTS],
            others: Vec::new(),
            starts: Starts {
                shifted: [ZERO; 3],
                inverse: [ZERO; 3],
                t_enter: ZERO,
                t_exit: ZERO,
                ray: [0; SLOTS + WIDEST],
                count: 0,
            },
        })
    }

    /// The number that the ray in a slot has in the call.
    #[inline(always)]
    pub(super) fn number(&self, slot: usize) -> usize {
        self.parts[slot / PART].start + slot % PART
    }

    /// The slots of a part's rays and their numbers in the call.
    #[inline(always)]
    pub(super) fn of_part(&self, part: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        (part * PART..).zip(self.parts[part].clone())
    }

    /// Makes rays of a call ready in a part, those with these numbers in the call, at most [`PART`].
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn fill<S: Simd>(
        &mut self,
        root: &Root<'_>,
        part: usize,
        world: &[Ray],
        numbers: Range<usize>,
    ) {
        const { assert!(PART.is_multiple_of(S::LANES) && S::LANES <= WIDEST) };
        assert!(numbers.len() <= PART && self.starts.count + PART <= SLOTS);
        let slots = part * PART..part * PART + numbers.len();
        let rays = &world[numbers.clone()];
        self.thick = root.thick;
        self.parts[part] = numbers;
        self.start[slots.clone()].fill(0.0);
        self.scale[slots.clone()].fill(root.frame.scale());
        for (first, rays) in slots.step_by(S::LANES).zip(rays.chunks(S::LANES)) {
            self.set::<S>(root, first, rays);
            self.derive::<S>(root, first);
        }
    }

    /// The first halves of rays, a vector of them at most.
    #[inline(always)]
    unsafe fn set<S: Simd>(&mut self, root: &Root<'_>, first: usize, rays: &[Ray]) {
        let lanes = self.rays.get_unchecked_mut(first..first + S::LANES);
        let least = if root.forward_only {
            0.0
        } else {
            f64::NEG_INFINITY
        };
        // What `FramedRay` makes of common rays.
        let (c, scale) = (root.frame.center(), root.frame.scale());
        let no = f64::NEG_INFINITY;
        let to_frame = [
            [scale, scale, scale, 1.0, 1.0, 1.0, scale, scale],
            [c.x, c.y, c.z, 0.0, 0.0, 0.0, 0.0, 0.0],
            [no, no, no, no, no, no, 0.0, no],
        ];
        let mut uncommon = 0;
        for (k, (lane, ray)) in lanes.iter_mut().zip(rays).enumerate() {
            let (o, d) = (ray.origin, ray.direction);
            let world = [o.x, o.y, o.z, d.x, d.y, d.z, ray.t_min, ray.t_max];
            lane.set(S::narrowed(&world, &to_frame));
            let ordered = ray.t_min >= least;
            uncommon |= u32::from(!ordered) << k;
        }
        for lane in lanes.iter_mut().skip(rays.len()) {
            *lane = LaneRay::NONE;
        }
        // What passes here does so before it is rounded, too.
        let [ox, oy, oz, dx, dy, dz, ..] = S::columns(lanes.as_ptr().cast());
        let origin = S::max_abs(ox, S::max_abs(oy, oz));
        let direction = S::max_abs(dx, S::max_abs(dy, dz));
        let near = S::lt(origin, S::splat(FramedRay::FAR as f32));
        let unit = S::and(
            S::lt(S::splat(0.5), direction),
            S::lt(direction, S::splat(2.0)),
        );
        uncommon |= !S::bits(S::and(near, unit));
        uncommon &= (1 << rays.len()) - 1;
        while uncommon != 0 {
            let k = uncommon.trailing_zeros() as usize;
            uncommon &= uncommon - 1;
            self.set_uncommon(root, first + k, &rays[k]);
        }
    }

    #[cold]
    #[inline(never)]
    fn set_uncommon(&mut self, root: &Root<'_>, i: usize, ray: &Ray) {
        match FramedRay::new(root.frame, ray) {
            Some(framed) if !(root.forward_only && ray.t_min < 0.0) => {
                self.rays[i].set_uncommon(&framed);
                self.start[i] = framed.start;
                self.scale[i] = framed.scale;
            }
            _ => {
                self.rays[i] = LaneRay::NONE;
                self.others.push(self.number(i) as u32);
            }
        }
    }

    /// What follows from the first halves of a vector of rays.
    #[inline(always)]
    unsafe fn derive<S: Simd>(&mut self, root: &Root<'_>, first: usize) {
        const EPSILON: f32 = f32::EPSILON;
        let rays = self.rays.as_mut_ptr().add(first).cast::<f32>();
        let [ox, oy, oz, dx, dy, dz, t_min, t_max] = S::columns(rays);
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let size = three(|k| S::abs(direction[k]));
        let mut t_enter = S::mul(t_min, S::splat(1.0 - 2.0 * EPSILON));
        let mut t_exit = S::mul(t_max, S::splat(1.0 + 2.0 * EPSILON));
        let (mut inverse, mut shifted) = (direction, origin);
        for k in 0..3 {
            let backward = S::bit_u::<31>(S::bits_of(direction[k]));
            let signed = |x: f32| S::select(backward, S::splat(-x), S::splat(x));
            // Below, its inverse may not be a number.
            let least = S::splat(1e-20);
            let finite = S::select(S::lt(size[k], least), signed(1e-20), direction[k]);
            inverse[k] = S::div(S::splat(1.0), finite);
            shifted[k] = S::add(origin[k], signed(root.thick));
            let to = |corner: f32| S::mul(S::sub(S::splat(corner), origin[k]), inverse[k]);
            let (a, b) = (to(root.corners[0][k]), to(root.corners[1][k]));
            t_enter = S::max(S::min(a, b), t_enter);
            t_exit = S::min(S::max(a, b), t_exit);
        }
        let reach = S::max_abs(ox, S::max_abs(oy, oz));
        let reach = S::add(reach, S::splat(0.5));
        let y_or_z = S::select_u(S::lt(size[2], size[1]), S::splat_u(1), S::splat_u(2));
        let is_x = S::and(S::lt(size[1], size[0]), S::lt(size[2], size[0]));
        let axis = S::select_u(is_x, S::splat_u(0), y_or_z);
        let [x, y, z] = inverse;
        let is_y = S::eq_u(axis, S::splat_u(1));
        // Of three components, the one that many axes after the largest.
        let turned = |of: [S::F; 3]| S::select(is_x, of[1], S::select(is_y, of[2], of[0]));
        let along = S::select(is_x, x, S::select(is_y, y, z));
        let shear = [
            S::mul(turned(direction), along),
            S::mul(turned([dy, dz, dx]), along),
        ];
        let rest = S::splat(0.0);
        let half = [x, y, z, reach, S::from_bits(axis), shear[0], shear[1], rest];
        S::write_columns(rays.add(HALF), half);

        let starts = &mut self.starts;
        let meets = S::le(t_enter, t_exit);
        let at = starts.count;
        let append = |column: &mut Column<f32>, x: S::F| {
            S::append(column.as_mut_ptr().add(at).cast(), meets, S::bits_of(x));
        };
        for k in 0..3 {
            append(&mut starts.shifted[k], shifted[k]);
            append(&mut starts.inverse[k], inverse[k]);
        }
        append(&mut starts.t_enter, t_enter);
        append(&mut starts.t_exit, t_exit);
        let numbers = S::add_u(S::load_u(COUNTED.as_ptr()), S::splat_u(first as u32));
        S::append(starts.ray.as_mut_ptr().add(at), meets, numbers);
        starts.count += S::bits(meets).count_ones() as usize;
    }

    /// A distance on a ray as one on the ray in the world.
    #[inline(always)]
    pub(super) fn to_world(&self, ray: usize, t: f64) -> f64 {
        self.start[ray] + t / self.scale[ray]
    }

    /// A distance on the ray in the world as one on this ray.
    #[inline(always)]
    pub(super) fn in_frame(&self, ray: usize, t: f64) -> f64 {
        (t - self.start[ray]) * self.scale[ray]
    }
}

/// From 0 on.
const COUNTED: [u32; WIDEST] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
