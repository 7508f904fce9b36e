//! The time of tracing rays, without making and shading them.

use super::{Batch, Hit, RayTracer};
use cpu_time::ThreadTime;
use std::time::Duration;

/// A kernel whose batches are timed. Two readings of the clock per batch of a tile take about a
/// microsecond, as much as tracing a ray or two.
pub struct TimedBatches<T> {
    tracer: T,
    /// CPU time of all batches.
    pub time: Duration,
    /// Number of their rays.
    pub rays: u64,
}

impl<T> TimedBatches<T> {
    pub fn new(tracer: T) -> Self {
        TimedBatches {
            tracer,
            time: Duration::ZERO,
            rays: 0,
        }
    }

    fn timed(&mut self, rays: usize, trace: impl FnOnce(&mut T)) {
        let start = ThreadTime::now();
        trace(&mut self.tracer);
        self.time += start.elapsed();
        self.rays += rays as u64;
    }
}

impl<T: RayTracer> RayTracer for TimedBatches<T> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        let rays = batch.rays.len();
        self.timed(rays, |tracer| tracer.closest_hits(batch, hits));
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        let rays = batch.rays.len();
        self.timed(rays, |tracer| tracer.any_hits(batch, blocked));
    }
}
