//! The rays of a packet as columns, and their common bounds.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::{ROW, Simd, WIDEST};
use super::ray::RayBuffer;

/// Bound on the error of a sheared coordinate, as a multiple of `reach`: twice that of a point of a
/// triangle, see [`super::block::Triangles`].
const SHEARED_ERROR: f32 = 16.0 * f32::EPSILON;

/// One number per lane.
pub(super) type Lanes = [f32; WIDEST];

/// The rays of a packet; see [`super::ray::SimdRay`].
#[repr(C, align(64))]
pub(super) struct Packet {
    pub(super) origin: [Lanes; 3],
    pub(super) direction: [Lanes; 3],
    pub(super) inverse: [Lanes; 3],
    /// [`super::ray::SimdRay::shifted`].
    pub(super) shifted: [Lanes; 3],
    pub(super) t_min: Lanes,
    pub(super) t_max: Lanes,
    pub(super) reach: Lanes,
    /// The intervals of the rays within the scene's box.
    pub(super) t_enter: Lanes,
    pub(super) t_exit: Lanes,
    /// Half the thickness of planes.
    pub(super) half_thickness: f32,
    /// Whether all rays have the axis of the largest component in common.
    pub(super) is_one_axis: bool,
    /// Valid if they have.
    pub(super) bundle: Bundle,
    /// Slots of the rays.
    pub(super) ray: [u32; WIDEST],
    /// Mask of the lanes that have a ray.
    pub(super) lanes: u32,
}

impl Packet {
    pub(super) const NEW: Packet = Packet {
        origin: [[0.0; WIDEST]; 3],
        direction: [[1.0; WIDEST]; 3],
        inverse: [[1.0; WIDEST]; 3],
        shifted: [[0.0; WIDEST]; 3],
        t_min: [0.0; WIDEST],
        t_max: [-1.0; WIDEST],
        reach: [0.0; WIDEST],
        t_enter: [0.0; WIDEST],
        t_exit: [-1.0; WIDEST],
        half_thickness: 0.0,
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

    /// Loads `count` of the rays that enter the scene from the `first` on: at least one, and at most as
    /// many as there are lanes.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn load<S: Simd>(&mut self, rays: &RayBuffer, first: usize, count: usize) {
        let entering = &rays.entering;
        let one = &rays.rays[entering.ray[first] as usize];
        self.half_thickness = rays.half_thickness;
        self.lanes = ((1_u64 << count) - 1) as u32;
        // Lanes behind the last ray load values that are never used.
        S::store_u(
            self.ray.as_mut_ptr(),
            S::load_u(entering.ray.as_ptr().add(first)),
        );
        copy::<S>(&mut self.t_enter, entering.t_enter.as_ptr().add(first));
        copy::<S>(&mut self.t_exit, entering.t_exit.as_ptr().add(first));
        for k in 0..3 {
            copy::<S>(
                &mut self.shifted[k],
                entering.shifted[k].as_ptr().add(first),
            );
            copy::<S>(
                &mut self.inverse[k],
                entering.inverse[k].as_ptr().add(first),
            );
        }
        // Rays in consecutive slots are loaded as vectors.
        self.is_one_axis =
            if count == S::LANES && self.ray[count - 1] - self.ray[0] == count as u32 - 1 {
                let from = rays.rays.as_ptr().add(self.ray[0] as usize).cast::<f32>();
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] = S::load_transposed(from);
                let [.., reach, axis, _, _, _] = S::load_transposed(from.add(ROW));
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
                self.lanes & !S::mask_bits(same) == 0
            } else {
                let mut same = true;
                for lane in 0..count {
                    let ray = &rays.rays[self.ray[lane] as usize];
                    for k in 0..3 {
                        self.origin[k][lane] = ray.origin[k];
                        self.direction[k][lane] = ray.direction[k];
                    }
                    self.t_min[lane] = ray.t_min;
                    self.t_max[lane] = ray.t_max;
                    self.reach[lane] = ray.reach;
                    same &= ray.axis == one.axis;
                }
                same
            };
        if self.is_one_axis {
            self.compute_bundle::<S>(one.rotated_axes());
        }
    }

    /// Computes the bounds of all rays.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    unsafe fn compute_bundle<S: Simd>(&mut self, axes: [usize; 3]) {
        let lanes = S::mask_from_bits(self.lanes);
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

/// Bounds on all rays of a packet that have the axis of their largest component in common.
pub(super) struct Bundle {
    /// The axes in cyclic order, that of the largest component last.
    pub(super) axes: [usize; 3],
    /// Minimum and maximum along these axes.
    pub(super) origin: [[f32; 2]; 3],
    /// Minimum and maximum of the first two components divided by the last.
    pub(super) shear: [[f32; 2]; 2],
    /// Bound on the error of a sheared coordinate.
    pub(super) error: f32,
}

/// Returns the minimum and maximum over some lanes.
///
/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn bounds<S: Simd>(x: S::F, lanes: S::M) -> [f32; 2] {
    let none = S::splat(f32::NEG_INFINITY);
    let negated = S::max_lane(S::select(lanes, S::sub(S::splat(0.0), x), none));
    [-negated, S::max_lane(S::select(lanes, x, none))]
}

/// # Safety
/// As [`Simd`].
#[inline(always)]
pub(super) unsafe fn store<S: Simd>(to: &mut Lanes, x: S::F) {
    S::store_u(to.as_mut_ptr().cast(), S::bits_of(x));
}

/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn copy<S: Simd>(to: &mut Lanes, from: *const f32) {
    store::<S>(to, S::load(from));
}
