//! Rendering of whole images: a coarse preview, timed rendering, counted rendering.

use super::{
    CountingKernel, PixelTallies, RayKind, RayMaxima, RenderError, RenderSettings, ScalarKernel,
    Scratch, Shading, Tally, Tile, TimedBatches, TimedKernel, objects_on_ray, tiles, trace_samples,
};
use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
use crate::scene::Scene;
use crate::structure::Tree;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Creates the threads for rendering; 0 means one per core.
///
/// # Errors
/// The system cannot start the threads.
pub fn thread_pool(threads: usize) -> Result<rayon::ThreadPool, RenderError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("trace-{i}"))
        .build()
        .map_err(|error| RenderError::Threads(error.to_string()))
}

/// The times of one rendering.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimedRender {
    /// CPU time of all threads together, `T_TR`.
    pub cpu: Duration,
    /// Wall-clock time.
    pub wall: Duration,
    /// Threads that rendered.
    pub threads: usize,
    /// Rays that were traced.
    pub rays: u64,
    /// CPU time of tracing them, in batches: all of `cpu` but making rays and shading.
    pub tracing: Duration,
}

/// The counts of one rendering.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CountedRender {
    /// By [`RayKind`].
    pub tallies: [Tally; 4],
    /// Maxima over single rays, by [`RayKind`].
    pub maxima: [RayMaxima; 4],
    /// The sum over rays of the squared number of leaves that each visits, by [`RayKind`].
    pub leaves_squared: [u64; 4],
    /// CPU time of the traversal of all rays to their known ends, without tests and shading, `T_TT`.
    pub traversal: Duration,
    /// Sum over the primary rays of the objects that each hits: `D_COMPX` times the number of primary rays.
    pub objects_met: u64,
}

/// The counts of one tile.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedTile {
    pub tile: Tile,
    pub sum: CountedRender,
    /// Row by row.
    pub pixels: Vec<PixelTallies>,
    /// Objects that the primary ray of each pixel hits, row by row.
    pub depth_complexity: Vec<u32>,
}

impl CountedRender {
    /// Returns the standard deviation, over all rays of these kinds, of the leaves that a ray visits. `None`
    /// without rays.
    pub fn leaf_deviation(&self, kinds: &[RayKind]) -> Option<f64> {
        let tally: Tally = kinds.iter().map(|&k| self.tallies[k as usize]).sum();
        let squares: u64 = kinds.iter().map(|&k| self.leaves_squared[k as usize]).sum();
        let rays = tally.rays as f64;
        let mean = tally.leaves as f64 / rays;
        // Rounding may make the variance of equal numbers negative.
        let variance = (squares as f64 / rays - mean * mean).max(0.0);
        (tally.rays > 0).then(|| variance.sqrt())
    }

    /// Returns the sum of both.
    pub fn merge(mut self, other: CountedRender) -> CountedRender {
        for kind in RayKind::ALL {
            let kind = kind as usize;
            self.tallies[kind] += other.tallies[kind];
            self.maxima[kind] = self.maxima[kind].merge(other.maxima[kind]);
            self.leaves_squared[kind] += other.leaves_squared[kind];
        }
        self.traversal += other.traversal;
        self.objects_met += other.objects_met;
        self
    }
}

/// Calls `work` for every tile of an image, in parallel, and merges the results.
pub(super) fn over_tiles<R: Send>(
    settings: &RenderSettings,
    pool: &rayon::ThreadPool,
    progress: &Progress,
    work: impl Fn(&Tile, &[(u32, u32)]) -> R + Sync,
    merge: impl Fn(R, R) -> R + Sync + Send,
    nothing: impl Fn() -> R + Sync + Send,
) -> Result<R, Cancelled> {
    let tiles = tiles(settings.width, settings.height);
    let done = AtomicUsize::new(0);
    pool.install(|| {
        tiles
            .par_iter()
            .with_max_len(1)
            .map(|tile| {
                progress.check()?;
                let pixels: Vec<_> = (0..tile.len() as u32).map(|i| tile.pixel(i)).collect();
                let result = work(tile, &pixels);
                progress.check()?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.set(done as f64 / tiles.len() as f64);
                Ok(result)
            })
            .try_reduce(nothing, |a, b| Ok(merge(a, b)))
    })
}

/// Renders sample number `sample` of every pixel with the timed kernel. `on_tile` is called with the linear
/// colors of every finished tile, from any thread and in any order. Its time is not counted.
///
/// # Errors
/// A camera without a view, a resolution out of range, or cancellation.
pub fn render_timed(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    sample: u32,
    pool: &rayon::ThreadPool,
    progress: &Progress,
    on_tile: impl Fn(&Tile, &[Vec3]) + Sync,
) -> Result<TimedRender, RenderError> {
    let shading = Shading::new(scene, settings)?;
    // Preparing the tree for the kernel, once per tree, does not count as rendering time.
    TimedKernel::new(settings.kernel, scene, tree, shading.shapes, progress);
    let start = Instant::now();
    let (cpu, tracing, rays) = over_tiles(
        settings,
        pool,
        progress,
        |tile, pixels| {
            let start = ThreadTime::now();
            let kernel = TimedKernel::new(settings.kernel, scene, tree, shading.shapes, progress);
            let mut tracer = TimedBatches::new(kernel);
            let mut colors = Vec::new();
            trace_samples(&shading, pixels, sample, &mut tracer, &mut colors);
            let time = start.elapsed();
            if !progress.is_cancelled() {
                on_tile(tile, &colors);
            }
            (time, tracer.time, tracer.rays)
        },
        |a, b| (a.0 + b.0, a.1 + b.1, a.2 + b.2),
        || (Duration::ZERO, Duration::ZERO, 0),
    )?;
    Ok(TimedRender {
        cpu,
        wall: start.elapsed(),
        threads: pool.current_num_threads(),
        rays,
        tracing,
    })
}

/// Renders sample 0 of every pixel with the counting kernel. `on_tile` is called with the counts of every
/// finished tile, from any thread and in any order. Their sum is the result.
///
/// # Errors
/// As [`render_timed`].
pub fn render_counted(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    pool: &rayon::ThreadPool,
    progress: &Progress,
    on_tile: impl Fn(CountedTile) + Sync,
) -> Result<CountedRender, RenderError> {
    let shading = Shading::new(scene, settings)?;
    let counted = over_tiles(
        settings,
        pool,
        progress,
        |&tile, pixels| {
            let mut tracer = CountingKernel::new(tree, shading.shapes, progress, pixels.len());
            trace_samples(&shading, pixels, 0, &mut tracer, &mut Vec::new());
            let (mut scratch, mut found) = (Scratch::default(), Vec::new());
            let depth_complexity: Vec<u32> = pixels
                .iter()
                .take_while(|_| !progress.is_cancelled())
                .map(|&(x, y)| {
                    let ray = shading.view.primary_ray(x, y, 0);
                    objects_on_ray(tree, shading.shapes, &ray, &mut scratch, &mut found);
                    found.len() as u32
                })
                .collect();
            let sum = CountedRender {
                tallies: tracer.tallies,
                maxima: tracer.maxima,
                leaves_squared: tracer.leaves_squared,
                traversal: tracer.traversal,
                objects_met: depth_complexity.iter().copied().map(u64::from).sum(),
            };
            if !progress.is_cancelled() {
                on_tile(CountedTile {
                    tile,
                    sum,
                    pixels: tracer.pixels,
                    depth_complexity,
                });
            }
            sum
        },
        CountedRender::merge,
        CountedRender::default,
    )?;
    Ok(counted)
}

/// Number of times that each pixel is timed.
const ROUNDS: u32 = 3;

/// Measures the time of each pixel, in seconds, row by row: its sample 0 traced and shaded alone by the
/// scalar kernel.
///
/// A pixel takes about one microsecond or more. Reading the wall clock adds 0.04 µs, reading the CPU
/// clock of a thread, a system call, adds 0.5 µs (measured). So this reads the wall clock, and takes the
/// minimum over a few rounds because the wall clock includes interruptions of the thread.
///
/// # Errors
/// As [`render_timed`].
pub fn pixel_times(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<Vec<f32>, RenderError> {
    let shading = Shading::new(scene, settings)?;
    let times = Mutex::new(vec![
        0.0;
        settings.width as usize * settings.height as usize
    ]);
    over_tiles(
        settings,
        pool,
        progress,
        |_, pixels| {
            let mut tracer = ScalarKernel::new(tree, shading.shapes, progress);
            let mut colors = Vec::new();
            let mut minimum = vec![f32::INFINITY; pixels.len()];
            for _ in 0..ROUNDS {
                for (minimum, pixel) in minimum.iter_mut().zip(pixels) {
                    let start = Instant::now();
                    trace_samples(
                        &shading,
                        std::slice::from_ref(pixel),
                        0,
                        &mut tracer,
                        &mut colors,
                    );
                    *minimum = minimum.min(start.elapsed().as_secs_f32());
                    if progress.is_cancelled() {
                        return;
                    }
                }
            }
            let mut times = times.lock().unwrap_or_else(PoisonError::into_inner);
            for (&(x, y), minimum) in pixels.iter().zip(minimum) {
                times[y as usize * settings.width as usize + x as usize] = minimum;
            }
        },
        |(), ()| (),
        || (),
    )?;
    Ok(times.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Renders a coarse image: traces one pixel per square of `step` × `step` pixels and fills the square with
/// its color. `on_tile` is called with every finished tile, from any thread.
///
/// # Errors
/// As [`render_timed`].
pub fn preview(
    scene: &Scene,
    tree: &Tree,
    settings: &RenderSettings,
    step: u32,
    pool: &rayon::ThreadPool,
    progress: &Progress,
    on_tile: impl Fn(&Tile, &[Vec3]) + Sync,
) -> Result<(), RenderError> {
    let shading = Shading::new(scene, settings)?;
    over_tiles(
        settings,
        pool,
        progress,
        |tile, _| {
            let columns = tile.width.div_ceil(step);
            let rows = tile.height.div_ceil(step);
            let centers: Vec<_> = (0..rows)
                .flat_map(|row| (0..columns).map(move |column| (column, row)))
                .map(|(column, row)| {
                    let x = tile.x + (column * step + step / 2).min(tile.width - 1);
                    let y = tile.y + (row * step + step / 2).min(tile.height - 1);
                    (x, y)
                })
                .collect();
            let mut tracer =
                TimedKernel::new(settings.kernel, scene, tree, shading.shapes, progress);
            let mut coarse = Vec::new();
            trace_samples(&shading, &centers, 0, &mut tracer, &mut coarse);
            if !progress.is_cancelled() {
                let fine: Vec<_> = (0..tile.len() as u32)
                    .map(|i| {
                        let (column, row) = (i % tile.width / step, i / tile.width / step);
                        coarse[(row * columns + column) as usize]
                    })
                    .collect();
                on_tile(tile, &fine);
            }
        },
        |(), ()| (),
        || (),
    )?;
    Ok(())
}
