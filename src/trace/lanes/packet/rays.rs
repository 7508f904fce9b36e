//! The rays of a packet, and their bounds.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use crate::trace::lanes::block::SHEARED_ERROR;
use crate::trace::lanes::ray::{HALF, LaneRays};
use crate::trace::lanes::simd::{Simd, WIDEST};

/// A number for every lane.
pub(super) type Numbers = [f32; WIDEST];

/// The rays of a packet, number by number; see [`crate::trace::lanes::ray::LaneRay`].
#[repr(C, align(64))]
pub(in super::super) struct Packet {
    pub(in super::super) origin: [Numbers; 3],
    pub(in super::super) direction: [Numbers; 3],
    pub(in super::super) inverse: [Numbers; 3],
    /// The origin as planes are met from it.
    pub(in super::super) shifted: [Numbers; 3],
    pub(in super::super) t_min: Numbers,
    pub(in super::super) t_max: Numbers,
    pub(in super::super) reach: Numbers,
    /// Where rays enter and leave the scene.
    pub(super) t_enter: Numbers,
    pub(super) t_exit: Numbers,
    /// Half the thickness of planes.
    pub(in super::super) thick: f32,
    /// Whether the axis of the largest component is the same for all rays.
    pub(super) is_one_axis: bool,
    /// If it is.
    pub(in super::super) bundle: Bundle,
    /// The rays' places among those made ready.
    pub(super) ray: [u32; WIDEST],
    /// Lanes that have a ray.
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
    pub(super) unsafe fn begin<S: Simd>(&mut self, rays: &LaneRays, first: usize, count: usize) {
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
        // Neighbours in memory are read in vectors.
        self.is_one_axis =
            if count == S::LANES && self.ray[count - 1] - self.ray[0] == count as u32 - 1 {
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
                self.lanes & !S::bits(same) == 0
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
pub(in super::super) struct Bundle {
    /// The axes in cyclic order, that of the largest component last.
    pub(in super::super) axes: [usize; 3],
    /// Least and most, along these axes.
    pub(in super::super) origin: [[f32; 2]; 3],
    /// Least and most of the first two components over the last.
    pub(in super::super) shear: [[f32; 2]; 2],
    /// Of a coordinate less what it is sheared by.
    pub(in super::super) error: f32,
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
pub(super) unsafe fn store<S: Simd>(to: &mut Numbers, x: S::F) {
    S::store_u(to.as_mut_ptr().cast(), S::bits_of(x));
}

/// # Safety
/// As [`Simd`].
#[inline(always)]
unsafe fn copy<S: Simd>(to: &mut Numbers, from: *const f32) {
    store::<S>(to, S::load(from));
}
