//! The rays of a call, prepared chunk by chunk as earlier chunks are finished.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::arithmetic::Simd;
use super::candidate::ExactTests;
use super::prefetch::prefetch;
use super::ray::{CHUNK, CHUNKS, RayBuffer, RaySetup};
use crate::geometry::Ray;

/// The rays of a call that are not prepared yet.
pub(super) struct RayQueue<'a> {
    setup: RaySetup<'a>,
    rays: &'a [Ray],
    /// The first that is not prepared.
    next: usize,
    /// The first that is not prefetched.
    to_prefetch: usize,
}

impl<'a> RayQueue<'a> {
    pub(super) fn new(setup: RaySetup<'a>, rays: &'a [Ray]) -> Self {
        RayQueue {
            setup,
            rays,
            next: 0,
            to_prefetch: 0,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.next == self.rays.len()
    }

    /// Prepares the next rays in a chunk whose rays are all done, after finishing their answers.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn refill<S: Simd>(
        &mut self,
        buffer: &mut RayBuffer,
        chunk: usize,
        tests: &mut dyn ExactTests,
    ) {
        tests.end(buffer, chunk);
        let indices = self.next..self.rays.len().min(self.next + CHUNK);
        (self.next, self.to_prefetch) = (indices.end, indices.end);
        let before = buffer.entering.count;
        buffer.fill::<S>(&self.setup, chunk, self.rays, indices.clone());
        tests.begin(buffer, chunk);
        // A ray is prefetched whenever another one starts; those that miss the scene never do.
        self.prefetch(before + indices.len() - buffer.entering.count);
    }

    /// Prefetches the next `count` rays.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn prefetch(&mut self, count: usize) {
        for ray in self.to_prefetch..self.to_prefetch + count {
            // The address may lie behind the last ray.
            prefetch(self.rays.as_ptr().wrapping_add(ray));
        }
        self.to_prefetch += count;
    }
}

/// Finishes the answers of all rays, which must be done.
pub(super) fn end_all(buffer: &mut RayBuffer, tests: &mut dyn ExactTests) {
    for chunk in 0..CHUNKS {
        tests.end(buffer, chunk);
        buffer.chunks[chunk] = 0..0;
    }
}
