//! The exact test of rays and triangles, in `f64`, for many pairs at once.

use super::array::three;
use super::instruction_set::InstructionSet;
use crate::geometry::Vec3;
use crate::primitive::{Estimate, nearest_in_plane};

/// Pairs per batch: enough that stores of the first pair have reached the cache when it is read.
pub(super) const BATCH: usize = 32;

/// Pairs per vector.
const VECTOR: usize = 8;

type Column<T> = [T; BATCH];

/// Pairs of a ray and a triangle with coordinates in `T`, as columns. The axis of the direction's largest component is the last.
pub(super) struct Crossings<T> {
    vertices: [[Column<T>; 3]; 3],
    origin: [Column<T>; 3],
    direction: [Column<T>; 3],
    /// The estimates: distances and bounds on their errors.
    t: Column<f64>,
    error: Column<f64>,
    /// [`nearest_in_plane`], where it is computed.
    nearest: Column<f64>,
}

impl<T: Copy + Default + Into<f64>> Crossings<T> {
    pub(super) fn new() -> Self {
        let zero = [T::default(); BATCH];
        Crossings {
            vertices: [[zero; 3]; 3],
            origin: [zero; 3],
            direction: [zero; 3],
            t: [0.0; BATCH],
            error: [0.0; BATCH],
            nearest: [f64::NAN; BATCH],
        }
    }

    /// Sets pair `k`.
    #[inline(always)]
    pub(super) fn set(
        &mut self,
        k: usize,
        vertices: [[T; 3]; 3],
        origin: [T; 3],
        direction: [T; 3],
    ) {
        for j in 0..3 {
            for (to, vertex) in self.vertices.iter_mut().zip(&vertices) {
                to[j][k] = vertex[j];
            }
            self.origin[j][k] = origin[j];
            self.direction[j][k] = direction[j];
        }
    }

    /// Computes the first `count` pairs: the estimates, and if `with_nearest` is set distances rounded to `f64`.
    /// To round them to `f32`, an estimate suffices.
    #[inline(always)]
    pub(super) fn compute(
        &mut self,
        instructions: InstructionSet,
        count: usize,
        with_nearest: bool,
    ) {
        match instructions {
            // SAFETY: kernels are only created for instruction sets that the processor has.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { self.compute_avx512(count, with_nearest) },
            // SAFETY: likewise.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { self.compute_avx2(count, with_nearest) },
            _ => self.compute_inline::<false>(count, with_nearest),
        }
    }

    /// Returns [`Estimate::of_triangle`] of a computed pair.
    #[inline(always)]
    pub(super) fn estimate(&self, k: usize) -> Estimate {
        Estimate::new(self.t[k], self.error[k])
    }

    /// Returns [`nearest_in_plane`] of a computed pair.
    #[inline(always)]
    pub(super) fn nearest(&self, k: usize) -> f64 {
        self.nearest[k]
    }

    /// # Safety
    /// The processor must have the instruction set.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
    unsafe fn compute_avx512(&mut self, count: usize, with_nearest: bool) {
        self.compute_inline::<true>(count, with_nearest);
    }

    /// # Safety
    /// As above.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    unsafe fn compute_avx2(&mut self, count: usize, with_nearest: bool) {
        self.compute_inline::<true>(count, with_nearest);
    }

    /// Whole vectors without a remainder, and results as columns: so the inner loops become vectors.
    #[inline(always)]
    fn compute_inline<const FMA: bool>(&mut self, count: usize, with_nearest: bool) {
        for first in (0..count.min(BATCH)).step_by(VECTOR) {
            for lane in 0..VECTOR {
                let k = (first + lane) % BATCH;
                let (vertices, origin, direction) = self.pair(k);
                (self.t[k], self.error[k]) =
                    Estimate::of_triangle(vertices, origin, direction).parts();
            }
            if with_nearest {
                for lane in 0..VECTOR {
                    let k = (first + lane) % BATCH;
                    let (vertices, origin, direction) = self.pair(k);
                    self.nearest[k] = nearest_in_plane::<FMA>(vertices, origin, direction);
                }
            }
        }
    }

    /// Returns vertices, origin and direction of pair `k`.
    #[inline(always)]
    fn pair(&self, k: usize) -> ([Vec3; 3], Vec3, Vec3) {
        let vector = |columns: &[Column<T>; 3]| Vec3::from(three(|j| columns[j][k].into()));
        let [a, b, c] = &self.vertices;
        (
            [vector(a), vector(b), vector(c)],
            vector(&self.origin),
            vector(&self.direction),
        )
    }
}
