//! Whole passes over a picture: a coarse preview, the timed pass, the counted pass.

use super::{
    CountingKernel, PixelTallies, RayKind, RayMaxima, RenderSettings, ScalarKernel, Scratch,
    Shading, Tally, Tile, TimedKernel, objects_on_ray, tiles, trace_samples,
};
use crate::geometry::Vec3;
use crate::progress::{Cancelled, Progress};
use crate::scene::{CameraError, Scene, View};
use crate::structure::Tree;
use cpu_time::ThreadTime;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RenderError {
    #[error(transparent)]
    Camera(#[from] CameraError),
    #[error("a picture of {width} × {height} pixels: both must be from 1 to {limit}")]
    Resolution { width: u32, height: u32, limit: u32 },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error("the threads could not be started: {0}")]
    Threads(String),
}

/// The most pixels a picture can have on a side.
const RESOLUTION_LIMIT: u32 = 16_384;

impl RenderSettings {
    /// The view of a scene with these settings.
    ///
    /// # Errors
    /// A camera without a view or a resolution out of range.
    pub fn view(&self, scene: &Scene) -> Result<View, RenderError> {
        let range = 1..=RESOLUTION_LIMIT;
        if !range.contains(&self.width) || !range.contains(&self.height) {
            return Err(RenderError::Resolution {
                width: self.width,
                height: self.height,
                limit: RESOLUTION_LIMIT,
            });
        }
        let camera = self.camera.resolve(scene.camera());
        Ok(camera.view(self.width, self.height, self.sampling)?)
    }
}

/// Threads to trace on; 0 takes as many as the machine has cores.
///
/// # Errors
/// The system gives no threads.
pub fn thread_pool(threads: usize) -> Result<rayon::ThreadPool, RenderError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .thread_name(|i| format!("trace-{i}"))
        .build()
        .map_err(|error| RenderError::Threads(error.to_string()))
}

/// What one timed pass took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimedRender {
    /// CPU time of all threads together, `T_TR`.
    pub cpu: Duration,
    /// Time on the clock on the wall.
    pub wall: Duration,
    /// Threads that rendered.
    pub threads: usize,
}

/// What one counted pass counted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CountedRender {
    /// By [`RayKind`].
    pub tallies: [Tally; 4],
    /// The most that a single ray did, by [`RayKind`].
    pub maxima: [RayMaxima; 4],
    /// CPU time of walking all rays to their known ends without tests and shading, `T_TT`.
    pub traversal: Duration,
    /// Objects met by all primary rays together: `D_COMPX` times the number of primary rays.
    pub objects_met: u64,
}

/// What one tile of a counted pass counted.
#[derive(Clone, Debug, PartialEq)]
pub struct CountedTile {
    pub tile: Tile,
    pub sum: CountedRender,
    /// Row by row.
    pub pixels: Vec<PixelTallies>,
    /// Objects that each pixel's primary ray meets, row by row.
    pub depth_complexity: Vec<u32>,
}

impl CountedRender {
    /// Both together.
    pub fn merge(mut self, other: CountedRender) -> CountedRender {
        for kind in RayKind::ALL {
            let kind = kind as usize;
            self.tallies[kind] += other.tallies[kind];
            self.maxima[kind] = self.maxima[kind].merge(other.maxima[kind]);
        }
        self.traversal += other.traversal;
        self.objects_met += other.objects_met;
        self
    }
}

/// A pass's tiles in parallel; every tile is given to `work` once.
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

/// Traces sample number `sample` of every pixel with the timed kernel. `on_tile` gets every
/// finished tile's linear colours, from any thread and in any order; its time is not counted.
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
    // Making the tree ready for the kernel, once a tree, is no part of tracing.
    TimedKernel::new(settings.kernel, scene, tree, shading.shapes, progress);
    let start = Instant::now();
    let cpu = over_tiles(
        settings,
        pool,
        progress,
        |tile, pixels| {
            let start = ThreadTime::now();
            let mut tracer =
                TimedKernel::new(settings.kernel, scene, tree, shading.shapes, progress);
            let mut colors = Vec::new();
            trace_samples(&shading, pixels, sample, &mut tracer, &mut colors);
            let time = start.elapsed();
            if !progress.is_cancelled() {
                on_tile(tile, &colors);
            }
            time
        },
        |a, b| a + b,
        || Duration::ZERO,
    )?;
    Ok(TimedRender {
        cpu,
        wall: start.elapsed(),
        threads: pool.current_num_threads(),
    })
}

/// Traces sample 0 of every pixel with the counting kernel. `on_tile` gets the counts of every
/// finished tile, from any thread and in any order; they sum to the result.
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
    let pass = over_tiles(
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
    Ok(pass)
}

/// How often each pixel is timed.
const ROUNDS: u32 = 3;

/// The time that each pixel takes, in seconds, row by row: its sample 0 traced and shaded alone by
/// the timed kernel.
///
/// A pixel takes from about one microsecond up. Reading the wall clock adds 0.04 µs to that, reading
/// a thread's CPU clock, a call of the system, 0.5 µs (measured), so the wall clock it is. What
/// speaks against it, that it runs on while a thread is interrupted, is met by taking the least of
/// a few rounds over the tile.
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
            let mut least = vec![f32::INFINITY; pixels.len()];
            for _ in 0..ROUNDS {
                for (least, pixel) in least.iter_mut().zip(pixels) {
                    let start = Instant::now();
                    trace_samples(
                        &shading,
                        std::slice::from_ref(pixel),
                        0,
                        &mut tracer,
                        &mut colors,
                    );
                    *least = least.min(start.elapsed().as_secs_f32());
                    if progress.is_cancelled() {
                        return;
                    }
                }
            }
            let mut times = times.lock().unwrap_or_else(PoisonError::into_inner);
            for (&(x, y), least) in pixels.iter().zip(least) {
                times[y as usize * settings.width as usize + x as usize] = least;
            }
        },
        |(), ()| (),
        || (),
    )?;
    Ok(times.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Traces one pixel of every square of `step` × `step` pixels and gives the whole square its
/// colour: a coarse first picture. `on_tile` gets the squares, from any thread.
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
