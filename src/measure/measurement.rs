//! One scene, one tree, one picture: everything the parameters are computed from.

use super::heat::PixelCounts;
use super::{SceneFacts, TreeFacts};
use crate::progress::{Cancelled, Progress};
use crate::scene::{Camera, Scene};
use crate::structure::split::Structure;
use crate::structure::{BuildError, BuildSettings, Tree, build};
use crate::trace::{
    ChosenPrecision, CountedRender, CountedTile, Picture, RayKind, RenderError, RenderSettings,
    Tally, TimedRender, render_counted, render_timed, thread_pool,
};
use cpu_time::ThreadTime;
use rayon::ThreadPool;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Why a measurement failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasureError {
    #[error(transparent)]
    Build(#[from] BuildError),
    #[error(transparent)]
    Render(#[from] RenderError),
}

impl MeasureError {
    /// Returns whether the tree of these settings is too large, so that others can be measured nevertheless.
    pub fn is_too_large(&self) -> bool {
        matches!(self, MeasureError::Build(error) if error.is_too_large())
    }

    /// Returns whether the task was cancelled.
    pub fn is_cancelled(&self) -> bool {
        matches!(
            self,
            MeasureError::Build(BuildError::Cancelled(Cancelled))
                | MeasureError::Render(RenderError::Cancelled(Cancelled))
        )
    }
}

/// CPU time and wall-clock time of one task.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    pub cpu: Duration,
    pub wall: Duration,
    /// Threads that the task could use.
    pub threads: usize,
}

impl Times {
    /// Runs a task in an otherwise idle thread pool. CPU time is summed over its threads.
    pub fn of<R: Send>(pool: &ThreadPool, task: impl FnOnce() -> R + Send) -> (R, Times) {
        let cpu = || -> Duration {
            let clocks = pool.broadcast(|_| ThreadTime::now().as_duration());
            clocks.iter().sum()
        };
        let (cpu_before, wall) = (cpu(), Instant::now());
        let result = pool.install(task);
        let wall = wall.elapsed();
        let times = Times {
            cpu: cpu().saturating_sub(cpu_before),
            wall,
            threads: pool.current_num_threads(),
        };
        (result, times)
    }
}

/// What a node is to a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KindOfNode {
    /// A plane between two children.
    Plane,
    Voxel,
    /// The boxes of up to this many children.
    Boxes(u32),
}

/// Everything that is specified, counted and timed; `None` for what is not measured yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    pub build: BuildSettings,
    pub render: RenderSettings,
    /// The camera that was used: the scene's own where `render` does not override it.
    pub camera: Camera,
    /// The precision of the ray tracer, and the reason for it.
    pub precision: ChosenPrecision,
    /// Bytes of the objects in the layout that intersection tests use in this precision.
    pub object_bytes: u64,
    /// The resolved root margin, a length.
    pub root_margin: f64,
    /// The resolved maximum depth.
    pub depth_limit: u32,
    pub scene: SceneFacts,
    pub tree: TreeFacts,
    /// Construction of the tree.
    pub building: Times,
    /// The timed render.
    pub rendering: Option<TimedRender>,
    /// The counting render.
    pub counted: Option<CountedRender>,
}

impl Measurement {
    /// Returns the measurement after the tree is built and before rendering.
    pub fn of_tree(
        scene: &Scene,
        tree: &Tree,
        building: Times,
        render: &RenderSettings,
    ) -> Measurement {
        let precision = render.precision_for(scene);
        Measurement {
            build: tree.settings().clone(),
            render: *render,
            camera: render.camera.resolve(scene.camera()),
            object_bytes: scene.shapes(precision.precision).bytes() as u64,
            precision,
            root_margin: tree.root_margin(),
            depth_limit: tree.depth_limit(),
            scene: SceneFacts::of(scene),
            tree: TreeFacts::of(tree),
            building,
            rendering: None,
            counted: None,
        }
    }

    /// Returns a measurement of the same scene and tree with other render settings, before
    /// rendering.
    pub fn with_render(&self, scene: &Scene, render: &RenderSettings) -> Measurement {
        let precision = render.precision_for(scene);
        Measurement {
            render: *render,
            camera: render.camera.resolve(scene.camera()),
            object_bytes: scene.shapes(precision.precision).bytes() as u64,
            precision,
            rendering: None,
            counted: None,
            ..self.clone()
        }
    }

    /// Returns what a node of this tree is to a ray. Numbers of nodes are comparable only if it is the same.
    pub fn kind_of_node(&self) -> KindOfNode {
        match self.build.method.structure {
            Structure::Bintree | Structure::Octree => KindOfNode::Plane,
            Structure::Grid => KindOfNode::Voxel,
            Structure::Bvh => KindOfNode::Boxes(self.build.constant("width") as u32),
        }
    }

    /// Returns the counts of the rays of a kind; `None` before they are counted.
    pub fn tally(&self, kind: RayKind) -> Option<Tally> {
        Some(self.counted.as_ref()?.tallies[kind as usize])
    }

    /// Returns the counts of secondary (reflected and refracted) rays.
    pub fn secondary(&self) -> Option<Tally> {
        Some(
            [RayKind::Reflected, RayKind::Refracted]
                .into_iter()
                .filter_map(|kind| self.tally(kind))
                .sum(),
        )
        .filter(|_| self.counted.is_some())
    }

    /// Returns the counts of all rays.
    pub fn all_rays(&self) -> Option<Tally> {
        Some(self.counted.as_ref()?.tallies.iter().copied().sum())
    }
}

/// A tree with its measurement, and the picture of the timed render.
#[derive(Debug)]
pub struct Measured {
    pub tree: Tree,
    pub measurement: Measurement,
    /// One sample per pixel.
    pub picture: Picture,
}

/// Builds a tree and measures it: first a timed render, then a counting one.
///
/// # Errors
/// Settings out of range, a tree beyond the memory limit, no view, or cancellation.
pub fn measure(
    scene: &Scene,
    build_settings: &BuildSettings,
    render_settings: &RenderSettings,
    progress: &Progress,
) -> Result<Measured, MeasureError> {
    measure_with(scene, build_settings, render_settings, progress, |_| ())
}

/// Measures like [`measure`], and also counts per pixel.
///
/// # Errors
/// The same as those of [`measure`].
pub fn measure_pixels(
    scene: &Scene,
    build_settings: &BuildSettings,
    render_settings: &RenderSettings,
    progress: &Progress,
) -> Result<(Measured, PixelCounts), MeasureError> {
    let counts = PixelCounts::new(render_settings.width, render_settings.height);
    let counts = Mutex::new(counts);
    let add = |tile: CountedTile| {
        let mut counts = counts.lock().unwrap_or_else(PoisonError::into_inner);
        counts.add(&tile);
    };
    let measured = measure_with(scene, build_settings, render_settings, progress, add)?;
    let counts = counts.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok((measured, counts))
}

fn measure_with(
    scene: &Scene,
    build_settings: &BuildSettings,
    render_settings: &RenderSettings,
    progress: &Progress,
    on_counted: impl Fn(CountedTile) + Sync,
) -> Result<Measured, MeasureError> {
    let pool = thread_pool(render_settings.threads)?;
    let (tree, building) = Times::of(&pool, || build(scene, build_settings, progress));
    let tree = tree?;
    let mut measurement = Measurement::of_tree(scene, &tree, building, render_settings);
    pool.install(|| measurement.tree.find_overlaps(scene, &tree, progress))
        .map_err(BuildError::from)?;
    let picture = Mutex::new(Picture::new(render_settings.width, render_settings.height));
    measurement.rendering = Some(render_timed(
        scene,
        &tree,
        render_settings,
        0,
        &pool,
        progress,
        |tile, colors| {
            let mut picture = picture.lock().unwrap_or_else(PoisonError::into_inner);
            picture.add_tile(tile, 0, colors);
        },
    )?);
    measurement.counted = Some(render_counted(
        scene,
        &tree,
        render_settings,
        &pool,
        progress,
        on_counted,
    )?);
    Ok(Measured {
        tree,
        measurement,
        picture: picture.into_inner().unwrap_or_else(PoisonError::into_inner),
    })
}
