//! Rays as SIMD kernels traverse and test them: in `f32`, with bounds on the rounding.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::{ROW, ROW_STRIDE, Simd, WIDEST};
use super::array::three;
use crate::geometry::Ray;
use crate::primitive::{FramedRay, UnitFrame};
use std::hint::select_unpredictable;
use std::ops::Range;

/// Rays that are prepared at once.
pub(super) const CHUNK: usize = 256;

/// Number of chunks. A chunk is reused when its last ray is done; meanwhile rays of the others are
/// traced.
pub(super) const CHUNKS: usize = 4;

/// Prepared rays at a time, few enough to stay in the cache.
pub(super) const SLOTS: usize = CHUNKS * CHUNK;

/// A ray in the coordinates of the unit frame with all that tests need, in one cache line.
#[derive(Clone, Copy)]
#[repr(C, align(64))]
pub(super) struct SimdRay {
    pub(super) origin: [f32; 3],
    /// Its largest component is from ½ to 2.
    pub(super) direction: [f32; 3],
    pub(super) t_min: f32,
    pub(super) t_max: f32,
    /// 1 / direction, finite.
    pub(super) inverse: [f32; 3],
    /// Bound on the difference between any coordinate of the scene and that of the origin.
    pub(super) reach: f32,
    /// The axis of the direction's largest component.
    pub(super) axis: u32,
    /// The first two components divided by the last, in the order of [`SimdRay::rotated_axes`].
    pub(super) shear: [f32; 2],
    _room: u32,
}

// A ray is two rows: what the world's ray determines, and what follows from that.
const _: () = assert!(size_of::<SimdRay>() == ROW_STRIDE * size_of::<f32>());

impl SimdRay {
    /// A ray that ends before it begins.
    const NONE: SimdRay = SimdRay {
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

    fn set_framed(&mut self, ray: &FramedRay) {
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin.to_array(), ray.direction.to_array());
        self.set([ox, oy, oz, dx, dy, dz, ray.t_min, ray.t_max]);
    }

    #[inline(always)]
    fn set(&mut self, [ox, oy, oz, dx, dy, dz, t_min, t_max]: [f32; ROW]) {
        self.origin = [ox, oy, oz];
        self.direction = [dx, dy, dz];
        (self.t_min, self.t_max) = (t_min, t_max);
    }

    /// Returns the axes in cyclic order with that of the largest component last.
    #[inline(always)]
    pub(super) fn rotated_axes(&self) -> [usize; 3] {
        let last = self.axis as usize;
        // Branchless: this branch mispredicts often.
        let next = |k| select_unpredictable(k == 2, 0, k + 1);
        [next(last), next(next(last)), last]
    }

    /// Returns the origin shifted by half the thickness of planes along each axis, in the direction of the
    /// ray. From there, the distance to a plane is the distance to its near side.
    #[inline(always)]
    pub(super) fn shifted(&self, half_thickness: f32) -> [f32; 3] {
        three(|k| self.origin[k] + half_thickness.copysign(self.direction[k]))
    }
}

/// One value per ray, with room for a vector behind the last.
pub(super) type Column<T> = [T; SLOTS + WIDEST];

/// Rays that enter the scene's box, as columns: what a lane needs to start their traversal.
pub(super) struct EnteringRays {
    /// [`SimdRay::shifted`].
    pub(super) shifted: [Column<f32>; 3],
    pub(super) inverse: [Column<f32>; 3],
    /// The interval of the ray within the scene's box.
    pub(super) t_enter: Column<f32>,
    pub(super) t_exit: Column<f32>,
    /// Slot of the ray.
    pub(super) ray: Column<u32>,
    pub(super) count: usize,
}

impl EnteringRays {
    /// Removes all before `first`.
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

/// Prepared rays, in chunks.
pub(super) struct RayBuffer {
    /// Half the thickness of planes.
    pub(super) half_thickness: f32,
    pub(super) rays: [SimdRay; SLOTS],
    /// The origin's distance along the world's ray, and the scale from distances there to those here.
    start: [f64; SLOTS],
    scale: [f64; SLOTS],
    /// Indices of each chunk's rays in the call.
    pub(super) chunks: [Range<usize>; CHUNKS],
    /// Indices of the call's rays that the unit frame cannot represent: the scalar kernel traces them.
    pub(super) scalar_rays: Vec<u32>,
    pub(super) entering: EnteringRays,
}

/// What the preparation of rays depends on besides the ray.
#[derive(Clone, Copy)]
pub(super) struct RaySetup<'a> {
    pub(super) frame: &'a UnitFrame,
    /// Half the thickness of planes.
    pub(super) half_thickness: f32,
    /// Lower and upper corner of the scene's box.
    pub(super) corners: &'a [[f32; 3]; 2],
    /// Whether rays that begin behind their origin are left to the scalar kernel.
    pub(super) forward_only: bool,
}

impl RayBuffer {
    pub(super) fn new() -> Box<RayBuffer> {
        const ZERO: Column<f32> = [0.0; SLOTS + WIDEST];
        Box::new(RayBuffer {
            half_thickness: 0.0,
            rays: [SimdRay::NONE; SLOTS],
            start: [0.0; SLOTS],
            scale: [1.0; SLOTS],
            chunks: [const { 0..0 }; CHUNKS],
            scalar_rays: Vec::new(),
            entering: EnteringRays {
                shifted: [ZERO; 3],
                inverse: [ZERO; 3],
                t_enter: ZERO,
                t_exit: ZERO,
                ray: [0; SLOTS + WIDEST],
                count: 0,
            },
        })
    }

    /// Returns the index in the call of the ray in a slot.
    #[inline(always)]
    pub(super) fn index(&self, slot: usize) -> usize {
        self.chunks[slot / CHUNK].start + slot % CHUNK
    }

    /// Returns the slots of a chunk's rays with their indices in the call.
    #[inline(always)]
    pub(super) fn chunk(&self, chunk: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        (chunk * CHUNK..).zip(self.chunks[chunk].clone())
    }

    /// Prepares rays of a call in a chunk: those with these indices in the call, at most [`CHUNK`].
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn fill<S: Simd>(
        &mut self,
        setup: &RaySetup<'_>,
        chunk: usize,
        world: &[Ray],
        indices: Range<usize>,
    ) {
        const { assert!(CHUNK.is_multiple_of(S::LANES) && S::LANES <= WIDEST) };
        assert!(indices.len() <= CHUNK && self.entering.count + CHUNK <= SLOTS);
        let slots = chunk * CHUNK..chunk * CHUNK + indices.len();
        let rays = &world[indices.clone()];
        self.half_thickness = setup.half_thickness;
        self.chunks[chunk] = indices;
        self.start[slots.clone()].fill(0.0);
        self.scale[slots.clone()].fill(setup.frame.scale());
        for (first, rays) in slots.step_by(S::LANES).zip(rays.chunks(S::LANES)) {
            self.transform::<S>(setup, first, rays);
            self.derive::<S>(setup, first);
        }
    }

    /// Transforms at most a vector of rays to the unit frame: the first row of each.
    #[inline(always)]
    unsafe fn transform<S: Simd>(&mut self, setup: &RaySetup<'_>, first: usize, rays: &[Ray]) {
        let lanes = self.rays.get_unchecked_mut(first..first + S::LANES);
        let minimum = if setup.forward_only {
            0.0
        } else {
            f64::NEG_INFINITY
        };
        // As `FramedRay` transforms common rays.
        let (c, scale) = (setup.frame.center(), setup.frame.scale());
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
            lane.set(S::scale_to_f32(&world, &to_frame));
            let ordered = ray.t_min >= minimum;
            uncommon |= u32::from(!ordered) << k;
        }
        for lane in lanes.iter_mut().skip(rays.len()) {
            *lane = SimdRay::NONE;
        }
        // Numbers that pass these comparisons also pass them before rounding.
        let [ox, oy, oz, dx, dy, dz, ..] = S::load_transposed(lanes.as_ptr().cast());
        let origin = S::max_abs(ox, S::max_abs(oy, oz));
        let direction = S::max_abs(dx, S::max_abs(dy, dz));
        let near = S::lt(origin, S::splat(FramedRay::FAR as f32));
        let unit = S::and(
            S::lt(S::splat(0.5), direction),
            S::lt(direction, S::splat(2.0)),
        );
        uncommon |= !S::mask_bits(S::and(near, unit));
        uncommon &= (1 << rays.len()) - 1;
        while uncommon != 0 {
            let k = uncommon.trailing_zeros() as usize;
            uncommon &= uncommon - 1;
            self.transform_uncommon(setup, first + k, &rays[k]);
        }
    }

    /// Transforms a ray that is far away, not about of unit length, or begins behind its origin.
    #[cold]
    #[inline(never)]
    fn transform_uncommon(&mut self, setup: &RaySetup<'_>, slot: usize, ray: &Ray) {
        match FramedRay::new(setup.frame, ray) {
            Some(framed) if !(setup.forward_only && ray.t_min < 0.0) => {
                self.rays[slot].set_framed(&framed);
                self.start[slot] = framed.start;
                self.scale[slot] = framed.scale;
            }
            _ => {
                self.rays[slot] = SimdRay::NONE;
                self.scalar_rays.push(self.index(slot) as u32);
            }
        }
    }

    /// Computes the second rows of a vector of rays from the first, and appends the rays that enter the
    /// scene's box to [`RayBuffer::entering`].
    #[inline(always)]
    unsafe fn derive<S: Simd>(&mut self, setup: &RaySetup<'_>, first: usize) {
        const EPSILON: f32 = f32::EPSILON;
        let rays = self.rays.as_mut_ptr().add(first).cast::<f32>();
        let [ox, oy, oz, dx, dy, dz, t_min, t_max] = S::load_transposed(rays);
        let (origin, direction) = ([ox, oy, oz], [dx, dy, dz]);
        let size = three(|k| S::abs(direction[k]));
        let mut t_enter = S::mul(t_min, S::splat(1.0 - 2.0 * EPSILON));
        let mut t_exit = S::mul(t_max, S::splat(1.0 + 2.0 * EPSILON));
        let (mut inverse, mut shifted) = (direction, origin);
        for k in 0..3 {
            let backward = S::test_bit_u::<31>(S::bits_of(direction[k]));
            let signed = |x: f32| S::select(backward, S::splat(-x), S::splat(x));
            // The inverse of a smaller number might overflow.
            let minimum = S::splat(1e-20);
            let finite = S::select(S::lt(size[k], minimum), signed(1e-20), direction[k]);
            inverse[k] = S::div(S::splat(1.0), finite);
            shifted[k] = S::add(origin[k], signed(setup.half_thickness));
            let to = |corner: f32| S::mul(S::sub(S::splat(corner), origin[k]), inverse[k]);
            let (a, b) = (to(setup.corners[0][k]), to(setup.corners[1][k]));
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
        // Selects the component of the axis after that of the largest.
        let rotated = |of: [S::F; 3]| S::select(is_x, of[1], S::select(is_y, of[2], of[0]));
        let along = S::select(is_x, x, S::select(is_y, y, z));
        let shear = [
            S::mul(rotated(direction), along),
            S::mul(rotated([dy, dz, dx]), along),
        ];
        let unused = S::splat(0.0);
        let row = [
            x,
            y,
            z,
            reach,
            S::from_bits(axis),
            shear[0],
            shear[1],
            unused,
        ];
        S::store_transposed(rays.add(ROW), row);

        let entering = &mut self.entering;
        let enters = S::le(t_enter, t_exit);
        let at = entering.count;
        let append = |column: &mut Column<f32>, x: S::F| {
            S::compress_store(column.as_mut_ptr().add(at).cast(), enters, S::bits_of(x));
        };
        for k in 0..3 {
            append(&mut entering.shifted[k], shifted[k]);
            append(&mut entering.inverse[k], inverse[k]);
        }
        append(&mut entering.t_enter, t_enter);
        append(&mut entering.t_exit, t_exit);
        let slots = S::add_u(S::load_u(LANE_NUMBERS.as_ptr()), S::splat_u(first as u32));
        S::compress_store(entering.ray.as_mut_ptr().add(at), enters, slots);
        entering.count += S::mask_bits(enters).count_ones() as usize;
    }

    /// Converts a distance along a prepared ray to one along the world's ray.
    #[inline(always)]
    pub(super) fn to_world(&self, slot: usize, t: f64) -> f64 {
        self.start[slot] + t / self.scale[slot]
    }

    /// Converts a distance along the world's ray to one along the prepared ray.
    #[inline(always)]
    pub(super) fn to_frame(&self, slot: usize, t: f64) -> f64 {
        (t - self.start[slot]) * self.scale[slot]
    }
}

const LANE_NUMBERS: [u32; WIDEST] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];
