//! Everything that a setup asks for: the scene, its tree, the picture with its time, and the counts.

use super::build::Build;
use super::cache::Cache;
use super::context::{Context, JobError};
use super::job::Job;
use super::load::Load;
use super::pixel_counts::{CountPixels, CountedPixels};
use super::slot::{Priority, Slot};
use crate::geometry::Vec3;
use crate::measure::Measurement;
use crate::measure::heat::PixelCounts;
use crate::scene::Scene;
use crate::setup::Setup;
use crate::structure::Tree;
use crate::trace::{Picture, RenderSettings, Tile, preview, render_timed};
use std::sync::{Arc, Mutex, PoisonError};

/// Edge, in pixels, of the squares of the coarse first picture.
const PREVIEW_STEP: u32 = 8;

/// Answers a setup. Redoes only what changed since the scenes and trees in the cache: a camera move
/// builds no tree, a new `D_MAX` loads no scene.
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
    /// The coarse first picture.
    pub picture: Arc<Picture>,
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
    /// What every pixel cost. Comes right before the complete figures, except for pictures of more
    /// than [`PIXEL_COUNTS_LIMIT`](crate::measure::heat::PIXEL_COUNTS_LIMIT) pixels.
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

    fn slot(&self) -> Slot {
        Slot::named("picture")
    }

    fn priority(&self) -> Priority {
        Priority::Now
    }

    fn run(self, context: &Context<Update>) -> Result<(), JobError> {
        let RenderPicture {
            setup,
            reload,
            cache,
        } = self;
        let stage = |stage| context.send(Update::Stage(stage));
        let scene = match cache.scene(&setup.scene, reload) {
            Some(scene) => scene,
            None => {
                stage(Stage::Loading);
                let scene = Load(setup.scene.clone()).run(&context.silent())?;
                cache.put_scene(setup.scene.clone(), reload, Arc::clone(&scene));
                scene
            }
        };
        let render: RenderSettings = setup.render;
        // A wrong camera or size is reported before work is done for it.
        render.view(&scene)?;
        let pool = cache.pool(render.threads)?;
        let built = match cache.tree(&scene, &setup.build) {
            Some(built) => built,
            None => {
                stage(Stage::Building);
                let build = Build {
                    scene: Arc::clone(&scene),
                    setup: setup.clone(),
                    pool: Arc::clone(&pool),
                };
                let built = build.run(&context.silent())?;
                cache.put_tree(built.clone());
                built
            }
        };
        let tree = built.tree;
        let mut measurement = built.known.with_render(&scene, &render);

        stage(Stage::Previewing);
        context.stage("first picture");
        let picture = context.unit(|progress| {
            let picture = Mutex::new(Picture::new(render.width, render.height));
            let add = |tile: &Tile, colors: &[Vec3]| {
                let mut picture = picture.lock().unwrap_or_else(PoisonError::into_inner);
                picture.add_tile(tile, 0, colors);
            };
            preview(&scene, &tree, &render, PREVIEW_STEP, &pool, progress, add)?;
            let picture = picture.into_inner();
            Ok::<_, JobError>(picture.unwrap_or_else(PoisonError::into_inner))
        })?;
        context.send(Update::Shown(Box::new(Shown {
            setup: setup.clone(),
            reload,
            scene: Arc::clone(&scene),
            tree: Arc::clone(&tree),
            picture: Arc::new(picture),
            measurement: measurement.clone(),
        })));

        let sample_with = |sample, progress: &_| {
            let send = |&tile: &Tile, colors: &[Vec3]| {
                context.send(Update::Tile {
                    tile,
                    sample,
                    colors: colors.to_vec(),
                });
            };
            render_timed(&scene, &tree, &render, sample, &pool, progress, send)
        };
        stage(Stage::Rendering);
        context.stage("rendering (timed)");
        let time = context.timed(|progress| sample_with(0, progress))?;
        measurement.rendering = Some(time);

        stage(Stage::Counting);
        let count = CountPixels {
            scene: Arc::clone(&scene),
            tree: Arc::clone(&tree),
            render,
            pool: Arc::clone(&pool),
            measurement,
        };
        let provisional = context.map(|measurement| Update::Measured {
            measurement: Box::new(measurement),
            complete: false,
        });
        let CountedPixels {
            measurement,
            pixels,
        } = count.run(&provisional)?;
        if let Some(pixels) = pixels {
            context.send(Update::PixelCounts(Arc::new(pixels)));
        }
        context.send(Update::Measured {
            measurement: Box::new(measurement),
            complete: true,
        });

        for sample in 1..render.samples {
            stage(Stage::Refining(sample, render.samples));
            context.stage(format!("sample {} of {}", sample + 1, render.samples));
            context.unit(|progress| sample_with(sample, progress))?;
        }
        Ok(())
    }
}
