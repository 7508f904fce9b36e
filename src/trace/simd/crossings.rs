//! The exact test of rays and triangles, in `f64`, for many pairs at once.

use super::array::three;
use super::instruction_set::InstructionSet;
use super::ray::SimdRay;
use crate::geometry::Vec3;
use crate::primitive::{Estimate, PackedTriangle};
use crate::structure::simd_tree::Triangles;

/// Pairs per batch: enough that stores of the first pair have reached the cache when it is read.
pub(super) const BATCH: usize = 32;

/// Pairs per vector.
const VECTOR: usize = 8;

type Column = [f32; BATCH];

/// Pairs of a ray and a triangle, as columns. The axis of the direction's largest component is the last.
pub(super) struct Crossings {
    vertices: [[Column; 3]; 3],
    origin: [Column; 3],
    direction: [Column; 3],
    /// The estimates: distances and bounds on their errors.
    t: [f64; BATCH],
    error: [f64; BATCH],
}

impl Crossings {
    pub(super) fn new() -> Self {
        Crossings {
            vertices: [[[0.0; BATCH]; 3]; 3],
            origin: [[0.0; BATCH]; 3],
            direction: [[1.0; BATCH]; 3],
            t: [0.0; BATCH],
            error: [0.0; BATCH],
        }
    }

    /// Sets pair `k`.
    #[inline(always)]
    pub(super) fn set(&mut self, k: usize, block: &Triangles, place: usize, ray: &SimdRay) {
        let axes = ray.rotated_axes();
        let vertices = block.vertices(place, axes);
        for j in 0..3 {
            for (to, vertex) in self.vertices.iter_mut().zip(&vertices) {
                to[j][k] = vertex[j];
            }
            self.origin[j][k] = ray.origin[axes[j]];
            self.direction[j][k] = ray.direction[axes[j]];
        }
    }

    /// Computes the first `count` pairs.
    #[inline(always)]
    pub(super) fn compute(&mut self, instructions: InstructionSet, count: usize) {
        match instructions {
            // SAFETY: kernels are only created for instruction sets that the processor has.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { self.compute_avx512(count) },
            // SAFETY: likewise.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { self.compute_avx2(count) },
            _ => self.compute_inline(count),
        }
    }

    /// Returns [`PackedTriangle::estimate_rotated`] of a computed pair.
    #[inline(always)]
    pub(super) fn get(&self, k: usize) -> Estimate {
        Estimate::new(self.t[k], self.error[k])
    }

    /// # Safety
    /// The processor must have the instruction set.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl")]
    unsafe fn compute_avx512(&mut self, count: usize) {
        self.compute_inline(count);
    }

    /// # Safety
    /// As above.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    unsafe fn compute_avx2(&mut self, count: usize) {
        self.compute_inline(count);
    }

    /// Whole vectors without a remainder, and results as columns: so the inner loop becomes vectors.
    #[inline(always)]
    fn compute_inline(&mut self, count: usize) {
        for first in (0..count.min(BATCH)).step_by(VECTOR) {
            for lane in 0..VECTOR {
                let k = (first + lane) % BATCH;
                let vector = |columns: &[Column; 3]| Vec3::from(three(|j| f64::from(columns[j][k])));
                let [a, b, c] = &self.vertices;
                let estimate = PackedTriangle::estimate_rotated(
                    [vector(a), vector(b), vector(c)],
                    vector(&self.origin),
                    vector(&self.direction),
                );
                (self.t[k], self.error[k]) = estimate.parts();
            }
        }
    }
}
