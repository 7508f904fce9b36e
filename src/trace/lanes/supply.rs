//! The rays of a call, which are made ready part by part as others are done.
#![allow(unsafe_op_in_unsafe_fn)] // the contract of `Simd` covers every line

use super::leaves::prefetch;
use super::ray::{LaneRays, PART, PARTS, Root};
use super::simd::Simd;
use super::walk::Tests;
use crate::geometry::Ray;

/// The rays of a call.
pub(super) struct Supply<'a> {
    root: Root<'a>,
    rays: &'a [Ray],
    /// The first that is not made ready.
    next: usize,
    /// The first that was not asked for.
    to_ask: usize,
}

impl<'a> Supply<'a> {
    pub(super) fn new(root: Root<'a>, rays: &'a [Ray]) -> Self {
        Supply {
            root,
            rays,
            next: 0,
            to_ask: 0,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.next == self.rays.len()
    }

    /// Makes the next rays ready in a part, none of whose rays is still on its way: their answers are told.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn refill<S: Simd>(
        &mut self,
        lane_rays: &mut LaneRays,
        part: usize,
        tests: &mut dyn Tests,
    ) {
        tests.end(lane_rays, part);
        let numbers = self.next..self.rays.len().min(self.next + PART);
        (self.next, self.to_ask) = (numbers.end, numbers.end);
        let before = lane_rays.starts.count;
        lane_rays.fill::<S>(&self.root, part, self.rays, numbers.clone());
        tests.begin(lane_rays, part);
        // Those that miss the scene begin no walk, with which another would be asked for.
        self.ask(before + numbers.len() - lane_rays.starts.count);
    }

    /// Asks for as many of the rays that are made ready next.
    ///
    /// # Safety
    /// As [`Simd`].
    #[inline(always)]
    pub(super) unsafe fn ask(&mut self, count: usize) {
        for ray in self.to_ask..self.to_ask + count {
            // There need not be any: it is not read.
            prefetch(self.rays.as_ptr().wrapping_add(ray));
        }
        self.to_ask += count;
    }
}

/// Tells the answers of all rays, none of which is still on its way.
pub(super) fn end_all(lane_rays: &mut LaneRays, tests: &mut dyn Tests) {
    for part in 0..PARTS {
        tests.end(lane_rays, part);
        lane_rays.parts[part] = 0..0;
    }
}
