//! Everything that a setup asks for: the scene, its tree, the picture, the counts, and the time.
//!
//! The picture is rendered by the fastest kernel, because all kernels find the same hits. The time is that of the
//! chosen kernel, which is measured once the picture and the counts are there.

use super::build::Build;
use super::cache::{Cache, Finished};
use super::context::{Context, JobError};
use super::job::Job;
use super::load::Load;
use super::pixel_counts::{CountPixels, CountedPixels};
use super::slot::{Priority, Slot};
use crate::geometry::Vec3;
use crate::measure::Measurement;
use crate::measure::heat::PixelCounts;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::setup::Setup;
use crate::structure::Tree;
use crate::trace::{
    KernelChoice, Picture, RenderError, RenderSettings, TILE, Tile, TimedRender, preview,
    render_timed,
};
use rayon::ThreadPool;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The least edge, in pixels, of the squares of the coarse first picture.
const LEAST_STEP: u32 = 8;

/// The most squares of the coarse first picture, which is to be there at once.
const MOST_SQUARES: u32 = 6400;

/// Returns the edge of the squares of the coarse first picture: a divisor of a tile's edge.
fn preview_step(width: u32, height: u32) -> u32 {
    let squares = |step: u32| u64::from(width.div_ceil(step)) * u64::from(height.div_ceil(step));
    let mut step = LEAST_STEP;
    while step < TILE && squares(step) > u64::from(MOST_SQUARES) {
        step *= 2;
    }
    step
}

/// Answers a setup. Redoes only what its settings affect, compared with the setups in the cache: a
/// camera move builds no tree, a new `D_MAX` loads no scene, and after a change of the kernel only the
/// time is measured again.
pub struct RenderPicture {
    pub setup: Setup,
    /// How often the scene's file was to be read again.
    pub reload: u64,
    pub cache: Cache,
}

/// What the job does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Loading,
    Building,
    Previewing,
    Rendering,
    Counting,
    /// Measures the time of the chosen kernel.
    Timing,
    /// Renders this sample, of so many.
    Refining(u32, u32),
}

/// A picture with everything that belongs to it.
#[derive(Clone, Debug)]
pub struct Shown {
    pub setup: Setup,
    /// How often the scene's file had been read again.
    pub reload: u64,
    pub scene: Arc<Scene>,
    pub tree: Arc<Tree>,
    /// The coarse first picture, or the finished one if only times change.
    pub picture: Arc<Picture>,
    /// Number of the last sample in the picture.
    pub sample: u32,
    /// What is known so far.
    pub measurement: Measurement,
}

/// What the job sends.
#[derive(Clone, Debug)]
pub enum Update {
    /// A stage began.
    Stage(Stage),
    /// A first picture with its tree and what is known of it.
    Shown(Box<Shown>),
    /// A tile of the picture: sample number `sample`, linear colors row by row.
    Tile {
        tile: Tile,
        sample: u32,
        colors: Vec<Vec3>,
    },
    /// What every pixel cost. Comes right before the final counts, or with a finished picture right
    /// after it, except for pictures of more than
    /// [`PIXEL_COUNTS_LIMIT`](crate::measure::heat::PIXEL_COUNTS_LIMIT) pixels.
    PixelCounts(Arc<PixelCounts>),
    /// More is known. Figures are provisional until `complete`.
    Measured {
        measurement: Box<Measurement>,
        complete: bool,
    },
}

impl Job for RenderPicture {
    type Partial = Update;
    type Output = ();

    fn place(&self) -> (Slot, Priority) {
        (Slot::named("picture"), Priority::Now)
    }

    fn run(self, context: &Context<Update>) -> Result<(), JobError> {
        let RenderPicture {
            setup,
            reload,
            cache,
        } = self;
        let stage = |stage| context.send(Update::Stage(stage));
        let scene = match cache.scene(&setup, reload) {
            Some(scene) => scene,
            None => {
                stage(Stage::Loading);
                let scene = Load(setup.scene.clone()).run(&context.silent())?;
                cache.put_scene(setup.clone(), reload, Arc::clone(&scene));
                scene
            }
        };
        let render: RenderSettings = setup.render;
        // A wrong camera or size is reported before work is done for it.
        render.view(&scene)?;
        let pool = cache.pool(render.threads)?;
        let built = match cache.tree(&setup, &scene) {
            Some(built) => built,
            None => {
                stage(Stage::Building);
                let build = Build {
                    scene: Arc::clone(&scene),
                    setup: setup.clone(),
                    pool: Arc::clone(&pool),
                };
                let built = build.run(&context.silent())?;
                cache.put_tree(setup.clone(), built.clone());
                built
            }
        };
        let finished = cache.picture(&setup, &built.tree);
        let answer = Answer {
            measurement: built.known.with_render(&scene, &render),
            setup,
            reload,
            scene,
            tree: built.tree,
            pool,
            cache: &cache,
            context,
        };
        match finished {
            Some(finished) => answer.measure_time(finished),
            None => {
                if let Some(finished) = answer.render()? {
                    cache.put_picture(answer.setup, finished);
                }
                Ok(())
            }
        }
    }
}

/// A job whose scene is loaded and whose tree is built.
struct Answer<'a> {
    setup: Setup,
    reload: u64,
    scene: Arc<Scene>,
    tree: Arc<Tree>,
    pool: Arc<ThreadPool>,
    cache: &'a Cache,
    /// What is known before a ray is traced.
    measurement: Measurement,
    context: &'a Context<Update>,
}

impl Answer<'_> {
    fn stage(&self, stage: Stage) {
        self.context.send(Update::Stage(stage));
    }

    fn show(&self, picture: Arc<Picture>, sample: u32, measurement: &Measurement) {
        self.context.send(Update::Shown(Box::new(Shown {
            setup: self.setup.clone(),
            reload: self.reload,
            scene: Arc::clone(&self.scene),
            tree: Arc::clone(&self.tree),
            picture,
            sample,
            measurement: measurement.clone(),
        })));
    }

    fn complete(&self, measurement: Measurement) {
        self.context.send(Update::Measured {
            measurement: Box::new(measurement),
            complete: true,
        });
    }

    /// Measures the time of a picture that is finished and otherwise stays as it is.
    fn measure_time(&self, finished: Finished) -> Result<(), JobError> {
        let mut measurement = self.measurement.clone();
        measurement.counted = Some(finished.counted);
        let last = self.setup.render.samples.saturating_sub(1);
        self.show(finished.picture, last, &measurement);
        self.context
            .send(Update::PixelCounts(finished.pixel_counts));
        measurement.rendering = Some(self.time(|_, _| ())?);
        self.complete(measurement);
        Ok(())
    }

    /// Returns the settings with the kernel that renders pictures.
    fn fastest(&self) -> RenderSettings {
        RenderSettings {
            kernel: KernelChoice::Auto,
            ..self.setup.render
        }
    }

    /// Renders the picture, counts what it costs and measures the time. Returns what can be reused;
    /// `None` if the picture has too many pixels for that.
    fn render(&self) -> Result<Option<Finished>, JobError> {
        let context = self.context;
        let mut measurement = self.measurement.clone();
        let preview = self.preview()?;
        self.show(Arc::new(preview), 0, &measurement);

        let render = &self.setup.render;
        let picture = Mutex::new(Picture::new(render.width, render.height));
        let add = |sample| {
            let picture = &picture;
            move |&tile: &Tile, colors: &[Vec3]| {
                lock(picture).add_tile(&tile, sample, colors);
                context.send(Update::Tile {
                    tile,
                    sample,
                    colors: colors.to_vec(),
                });
            }
        };
        // The fastest kernel is timed while it renders the picture.
        let is_timed = *render == self.fastest();
        if is_timed {
            measurement.rendering = Some(self.time(add(0))?);
        } else {
            self.stage(Stage::Rendering);
            context.stage("rendering");
            context.unit(|progress| self.render_sample(&self.fastest(), 0, progress, add(0)))?;
        }
        let CountedPixels {
            mut measurement,
            pixels,
        } = self.count(measurement)?;
        self.find_overlaps(&mut measurement)?;
        let counted = measurement.counted.unwrap_or_default();
        let pixel_counts = pixels.map(Arc::new);
        if let Some(counts) = &pixel_counts {
            context.send(Update::PixelCounts(Arc::clone(counts)));
        }
        if !is_timed {
            context.send(Update::Measured {
                measurement: Box::new(measurement.clone()),
                complete: false,
            });
            measurement.rendering = Some(self.time(|_, _| ())?);
        }
        self.complete(measurement);

        for sample in 1..render.samples {
            self.stage(Stage::Refining(sample, render.samples));
            context.stage(format!("sample {} of {}", sample + 1, render.samples));
            let settings = self.fastest();
            context
                .unit(|progress| self.render_sample(&settings, sample, progress, add(sample)))?;
        }
        let picture = picture.into_inner();
        Ok(pixel_counts.map(|pixel_counts| Finished {
            tree: Arc::clone(&self.tree),
            picture: Arc::new(picture.unwrap_or_else(PoisonError::into_inner)),
            pixel_counts,
            counted,
        }))
    }

    fn preview(&self) -> Result<Picture, JobError> {
        // The fastest kernel would first have to prepare the tree.
        let (scene, tree, render) = (&self.scene, &self.tree, &self.setup.render);
        self.stage(Stage::Previewing);
        self.context.stage("first picture");
        self.context.unit(|progress| {
            let picture = Mutex::new(Picture::new(render.width, render.height));
            let add = |tile: &Tile, colors: &[Vec3]| lock(&picture).add_tile(tile, 0, colors);
            let step = preview_step(render.width, render.height);
            preview(scene, tree, render, step, &self.pool, progress, add)?;
            let picture = picture.into_inner();
            Ok::<_, JobError>(picture.unwrap_or_else(PoisonError::into_inner))
        })
    }

    /// Renders the first sample with the chosen kernel, and measures the time.
    fn time(
        &self,
        on_tile: impl Fn(&Tile, &[Vec3]) + Sync + Copy,
    ) -> Result<TimedRender, JobError> {
        self.stage(Stage::Timing);
        let kernel = &self.setup.render.kernel;
        self.context
            .stage(format!("timing the {} kernel", kernel.name()));
        self.context
            .timed(|progress| self.render_sample(&self.setup.render, 0, progress, on_tile))
    }

    fn render_sample(
        &self,
        render: &RenderSettings,
        sample: u32,
        progress: &Progress,
        on_tile: impl Fn(&Tile, &[Vec3]) + Sync,
    ) -> Result<TimedRender, RenderError> {
        let (scene, tree) = (&self.scene, &self.tree);
        render_timed(scene, tree, render, sample, &self.pool, progress, on_tile)
    }

    /// Finds how far the nodes of the tree overlap, once per tree. That can take as long as building it, so it
    /// comes after the picture.
    fn find_overlaps(&self, measurement: &mut Measurement) -> Result<(), JobError> {
        let facts = &mut measurement.tree;
        self.context.unit(|progress| {
            let find = || facts.find_overlaps(&self.scene, &self.tree, progress);
            self.pool.install(find).map_err(RenderError::from)
        })?;
        self.cache.put_facts(&self.tree, *facts);
        Ok(())
    }

    fn count(&self, measurement: Measurement) -> Result<CountedPixels, JobError> {
        self.stage(Stage::Counting);
        let count = CountPixels {
            scene: Arc::clone(&self.scene),
            tree: Arc::clone(&self.tree),
            render: self.setup.render,
            pool: Arc::clone(&self.pool),
            measurement,
        };
        count.run(&self.context.map(|measurement| Update::Measured {
            measurement: Box::new(measurement),
            complete: false,
        }))
    }
}

fn lock(picture: &Mutex<Picture>) -> MutexGuard<'_, Picture> {
    picture.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_picture_of_a_large_picture_is_coarser() {
        for (width, height, step) in [
            (48, 48, 8),
            (512, 512, 8),
            (1024, 768, 16),
            (1600, 1000, 16),
            (3840, 2160, 32),
            (16_384, 16_384, 32),
        ] {
            assert_eq!(preview_step(width, height), step, "{width} × {height}");
            assert_eq!(TILE % step, 0);
        }
    }
}
