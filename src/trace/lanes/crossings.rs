//! Where rays meet triangles, for many pairs of them at once: the exact test, in `f64`.

use super::InstructionSet;
use super::block::Triangles;
use super::ray::LaneRay;
use super::three;
use crate::geometry::Vec3;
use crate::primitive::PackedTriangle;

/// Pairs at once. What is written for the first of them has reached the cache when it is read.
pub(super) const MANY: usize = 32;

/// Numbers that are read in a vector.
const TOGETHER: usize = 8;

type Column = [f32; MANY];

/// Pairs of a ray and a triangle, number by number, the axis of the direction's largest component last.
pub(super) struct Crossings {
    vertices: [[Column; 3]; 3],
    origin: [Column; 3],
    direction: [Column; 3],
    t_min: Column,
    t: [f64; MANY],
}

impl Crossings {
    pub(super) fn new() -> Self {
        Crossings {
            vertices: [[[0.0; MANY]; 3]; 3],
            origin: [[0.0; MANY]; 3],
            direction: [[1.0; MANY]; 3],
            t_min: [0.0; MANY],
            t: [f64::NAN; MANY],
        }
    }

    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, block: &Triangles, place: usize, ray: &LaneRay) {
        let axes = ray.turned_axes();
        let vertices = block.vertices(place, axes);
        for j in 0..3 {
            for (to, vertex) in self.vertices.iter_mut().zip(&vertices) {
                to[j][k] = vertex[j];
            }
            self.origin[j][k] = ray.origin[axes[j]];
            self.direction[j][k] = ray.direction[axes[j]];
        }
        self.t_min[k] = ray.t_min;
    }

    /// Computes the first `count` of them.
    #[inline(always)]
    pub(super) fn compute(&mut self, instructions: InstructionSet, count: usize) {
        match instructions {
            // SAFETY: kernels are only made for instructions that the processor has.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { self.compute_avx512(count) },
            // SAFETY: likewise.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { self.compute_avx2(count) },
            _ => self.compute_here(count),
        }
    }

    /// [`PackedTriangle::crossing_turned`] of a pair that was computed.
    #[inline(always)]
    pub(super) fn of(&self, k: usize) -> f64 {
        self.t[k]
    }

    /// # Safety
    /// The processor has these instructions.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    unsafe fn compute_avx512(&mut self, count: usize) {
        self.compute_here(count);
    }

    /// # Safety
    /// Likewise.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn compute_avx2(&mut self, count: usize) {
        self.compute_here(count);
    }

    #[inline(always)]
    fn compute_here(&mut self, count: usize) {
        for k in 0..count.next_multiple_of(TOGETHER).min(MANY) {
            let vector = |columns: &[Column; 3]| Vec3::from(three(|j| f64::from(columns[j][k])));
            let [a, b, c] = &self.vertices;
            self.t[k] = PackedTriangle::crossing_turned(
                [vector(a), vector(b), vector(c)],
                vector(&self.origin),
                vector(&self.direction),
                f64::from(self.t_min[k]),
            );
        }
    }
}
