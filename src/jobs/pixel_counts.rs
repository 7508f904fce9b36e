//! Counting what the rays of a picture do.

use super::context::{Context, JobError};
use super::job::Job;
use super::slot::{Priority, Slot};
use crate::measure::Measurement;
use crate::measure::heat::{PIXEL_COUNTS_LIMIT, PixelCounts};
use crate::scene::Scene;
use crate::structure::Tree;
use crate::trace::{RenderSettings, render_counted};
use rayon::ThreadPool;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How often provisional figures are sent.
const FIGURES_EVERY: Duration = Duration::from_millis(150);

/// Counts what every pixel of a picture costs. Its partial results are provisional figures.
pub struct CountPixels {
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    pub render: RenderSettings,
    pub pool: Arc<ThreadPool>,
    /// What is known before.
    pub measurement: Measurement,
}

/// What was counted.
pub struct CountedPixels {
    /// The final figures.
    pub measurement: Measurement,
    /// `None` for pictures of more than [`PIXEL_COUNTS_LIMIT`] pixels.
    pub pixels: Option<PixelCounts>,
}

impl Job for CountPixels {
    type Partial = Measurement;
    type Output = CountedPixels;

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("pixel counts"), Priority::Now)
    }

    fn run(self, context: &Context<Measurement>) -> Result<CountedPixels, JobError> {
        let CountPixels {
            scene,
            tree,
            render,
            pool,
            mut measurement,
        } = self;
        context.stage("counting");
        let size = u64::from(render.width) * u64::from(render.height);
        let is_kept = size <= PIXEL_COUNTS_LIMIT;
        let (counted, pixels) = context.unit(|progress| {
            let pixels = is_kept.then(|| PixelCounts::new(render.width, render.height));
            let so_far = Mutex::new((measurement.clone(), pixels, Instant::now()));
            let counted = render_counted(&scene, &tree, &render, &pool, progress, |part| {
                let mut guard = so_far.lock().unwrap_or_else(PoisonError::into_inner);
                let (measurement, pixels, last) = &mut *guard;
                if let Some(counts) = pixels {
                    counts.add(&part);
                }
                let sum = measurement.counted.unwrap_or_default().merge(part.sum);
                measurement.counted = Some(sum);
                if last.elapsed() >= FIGURES_EVERY {
                    *last = Instant::now();
                    context.send(measurement.clone());
                }
            })?;
            let so_far = so_far.into_inner();
            let (_, pixels, _) = so_far.unwrap_or_else(PoisonError::into_inner);
            Ok::<_, JobError>((counted, pixels))
        })?;
        measurement.counted = Some(counted);
        Ok(CountedPixels {
            measurement,
            pixels,
        })
    }
}
