//! The background thread between the window and the library. Latest wins.
//!
//! The window sends the whole desired state ([`Setup`]); there is one waiting slot, and a newer
//! request cancels what an older one started. The worker redoes only what changed: a camera move
//! builds no tree, a new `D_MAX` loads no scene. What comes back ([`Update`]) carries the number of
//! its request. A picture, its tree and its figures arrive together, so that none is ever shown
//! beside another's.

use crate::geometry::Vec3;
use crate::measure::heat::{PIXEL_COUNTS_LIMIT, PixelCounts};
use crate::measure::{Measurement, Times};
use crate::progress::{Cancelled, Progress};
use crate::scene::{LoadError, Scene, SceneRequest, load};
use crate::setup::Setup;
use crate::structure::{BuildError, Tree, build};
use crate::trace::{
    Picture, RenderError, RenderSettings, Tile, TimedRender, preview, render_counted, render_timed,
    thread_pool,
};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

/// What the worker is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    Loading,
    Building,
    Previewing,
    Tracing,
    Counting,
    /// Tracing this sample, of so many.
    Refining(u32, u32),
}

impl Stage {
    /// A few words for people.
    pub fn text(self) -> String {
        match self {
            Stage::Loading => "loading the scene".into(),
            Stage::Building => "building the tree".into(),
            Stage::Previewing => "first picture".into(),
            Stage::Tracing => "tracing (timed)".into(),
            Stage::Counting => "counting".into(),
            Stage::Refining(sample, of) => format!("sample {} of {of}", sample + 1),
        }
    }
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

/// News from the worker.
#[derive(Clone, Debug)]
pub enum Update {
    /// A stage began; `progress` goes on telling how far it is.
    Stage(Stage, Progress),
    /// A first picture with its tree and what is known of it.
    Shown(Box<Shown>),
    /// A tile of the picture: sample number `sample`, linear colours row by row.
    Tile {
        tile: Tile,
        sample: u32,
        colors: Vec<Vec3>,
    },
    /// What every pixel cost; comes right before the complete figures. Does not come for pictures
    /// of more than [`PIXEL_COUNTS_LIMIT`] pixels.
    PixelCounts(Arc<PixelCounts>),
    /// More is known. Figures are provisional until `complete`.
    Measured {
        measurement: Box<Measurement>,
        complete: bool,
    },
    /// All is done.
    Done,
    /// It could not be done; what was shown stays.
    Failed(String),
}

/// An update with the number of the request it answers.
#[derive(Clone, Debug)]
pub struct Numbered {
    pub request: u64,
    pub update: Update,
}

/// The handle that the window holds. Dropping it ends the thread.
pub struct Worker {
    slot: Arc<Slot>,
    updates: Receiver<Numbered>,
    thread: Option<std::thread::JoinHandle<()>>,
}

/// What the thread is asked for.
struct Request {
    setup: Setup,
    reload: u64,
}

#[derive(Default)]
struct Slot {
    state: Mutex<SlotState>,
    changed: Condvar,
}

#[derive(Default)]
struct SlotState {
    waiting: Option<(u64, Request)>,
    last_number: u64,
    /// Cancels what is being done now.
    current: Progress,
    closed: bool,
}

impl Worker {
    /// Starts the thread. `wake` is called, from any thread, whenever there is an update to fetch.
    pub fn start(wake: impl Fn() + Send + Sync + 'static) -> Worker {
        let slot = Arc::new(Slot::default());
        let (sender, updates) = channel();
        let job = Job {
            slot: Arc::clone(&slot),
            sender,
            wake: Arc::new(wake),
        };
        let thread = std::thread::Builder::new()
            .name("worker".into())
            .spawn(move || job.run())
            .expect("the system gives a thread");
        Worker {
            slot,
            updates,
            thread: Some(thread),
        }
    }

    /// Asks for a new state, in place of whatever was asked for before, and returns the request's
    /// number. Another `reload` than before reads the scene's file again.
    pub fn request(&self, setup: Setup, reload: u64) -> u64 {
        let mut state = self.slot.lock();
        state.current.cancel();
        state.last_number += 1;
        let number = state.last_number;
        state.waiting = Some((number, Request { setup, reload }));
        self.slot.changed.notify_all();
        number
    }

    /// Stops what is being done; what is shown stays as it is.
    pub fn cancel(&self) {
        let mut state = self.slot.lock();
        state.waiting = None;
        state.current.cancel();
    }

    /// The updates that have come since the last call, in order.
    pub fn updates(&self) -> impl Iterator<Item = Numbered> + '_ {
        self.updates.try_iter()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        {
            let mut state = self.slot.lock();
            state.closed = true;
            state.current.cancel();
            self.slot.changed.notify_all();
        }
        if let Some(thread) = self.thread.take() {
            // A panic in the worker was reported when it happened.
            let _ = thread.join();
        }
    }
}

impl Slot {
    fn lock(&self) -> std::sync::MutexGuard<'_, SlotState> {
        self.state
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Waits for a request; `None` once the window is gone.
    fn take(&self) -> Option<(u64, Request, Progress)> {
        let mut state = self.lock();
        loop {
            if state.closed {
                return None;
            }
            if let Some((number, request)) = state.waiting.take() {
                state.current = Progress::new();
                return Some((number, request, state.current.clone()));
            }
            state = self
                .changed
                .wait(state)
                .unwrap_or_else(std::sync::PoisonError::into_inner);
        }
    }
}

/// Why a request ended early.
enum Stop {
    Cancelled,
    Failed(String),
}

impl From<Cancelled> for Stop {
    fn from(_: Cancelled) -> Self {
        Stop::Cancelled
    }
}

impl From<LoadError> for Stop {
    fn from(error: LoadError) -> Self {
        match error {
            LoadError::Cancelled(c) => c.into(),
            error => Stop::Failed(error.to_string()),
        }
    }
}

impl From<BuildError> for Stop {
    fn from(error: BuildError) -> Self {
        match error {
            BuildError::Cancelled(c) => c.into(),
            error => Stop::Failed(error.to_string()),
        }
    }
}

impl From<RenderError> for Stop {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Cancelled(c) => c.into(),
            error => Stop::Failed(error.to_string()),
        }
    }
}

/// What the thread keeps from one request to the next.
#[derive(Default)]
struct Kept {
    scenes: LastTwo<Loaded>,
    trees: LastTwo<Built>,
    pool: Option<(usize, Arc<rayon::ThreadPool>)>,
}

struct Loaded {
    request: SceneRequest,
    reload: u64,
    scene: Arc<Scene>,
}

struct Built {
    scene: Arc<Scene>,
    tree: Arc<Tree>,
    /// What is known of it before a ray is traced.
    known: Measurement,
}

/// The two things used last, the later first: a comparison goes to and fro between two.
struct LastTwo<T>(Vec<T>);

impl<T> Default for LastTwo<T> {
    fn default() -> Self {
        LastTwo(Vec::new())
    }
}

impl<T> LastTwo<T> {
    /// The one that fits, from now on the one used last.
    fn find(&mut self, fits: impl FnMut(&T) -> bool) -> Option<&T> {
        let place = self.0.iter().position(fits)?;
        self.0[..=place].rotate_right(1);
        self.0.first()
    }

    fn put(&mut self, new: T) -> &T {
        self.0.insert(0, new);
        self.0.truncate(2);
        &self.0[0]
    }
}

impl Kept {
    /// The scene asked for, read anew where it is not there. Another file's scenes and trees go
    /// before that takes memory.
    fn scene(
        &mut self,
        request: &Request,
        progress: &Progress,
        reporter: &Reporter<'_>,
    ) -> Result<Arc<Scene>, Stop> {
        let (wanted, reload) = (&request.setup.scene, request.reload);
        self.scenes
            .0
            .retain(|known| known.request.source == wanted.source && known.reload == reload);
        let scenes = &self.scenes.0;
        self.trees.0.retain(|built| {
            scenes
                .iter()
                .any(|known| Arc::ptr_eq(&known.scene, &built.scene))
        });
        if let Some(known) = self.scenes.find(|known| known.request == *wanted) {
            return Ok(Arc::clone(&known.scene));
        }
        reporter.stage(Stage::Loading, progress);
        let scene = Arc::new(load(wanted, progress)?);
        let loaded = Loaded {
            request: wanted.clone(),
            reload,
            scene,
        };
        Ok(Arc::clone(&self.scenes.put(loaded).scene))
    }

    /// The tree asked for with what is known of it, built where it is not there.
    fn tree(
        &mut self,
        scene: &Arc<Scene>,
        setup: &Setup,
        progress: &Progress,
        reporter: &Reporter<'_>,
    ) -> Result<&Built, Stop> {
        let Setup {
            build: wanted,
            render,
            ..
        } = setup;
        let fits = |built: &Built| Arc::ptr_eq(&built.scene, scene) && built.known.build == *wanted;
        if !self.trees.0.iter().any(fits) {
            reporter.stage(Stage::Building, progress);
            let pool = self.pool(render.threads)?;
            let (tree, building) = Times::of(&pool, || build(scene, wanted, progress));
            let tree = Arc::new(tree?);
            self.trees.put(Built {
                scene: Arc::clone(scene),
                known: Measurement::of_tree(scene, &tree, building, render),
                tree,
            });
        }
        Ok(self
            .trees
            .find(fits)
            .expect("it was there or was put there"))
    }

    fn pool(&mut self, threads: usize) -> Result<Arc<rayon::ThreadPool>, Stop> {
        match &self.pool {
            Some((known, pool)) if *known == threads => Ok(Arc::clone(pool)),
            _ => {
                let pool = Arc::new(thread_pool(threads)?);
                self.pool = Some((threads, Arc::clone(&pool)));
                Ok(pool)
            }
        }
    }
}

struct Job {
    slot: Arc<Slot>,
    sender: Sender<Numbered>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

/// Sends updates of one request.
struct Reporter<'a> {
    job: &'a Job,
    request: u64,
}

impl Reporter<'_> {
    fn send(&self, update: Update) {
        // Without a window nobody needs the news.
        let _ = self.job.sender.send(Numbered {
            request: self.request,
            update,
        });
        (self.job.wake)();
    }

    fn stage(&self, stage: Stage, progress: &Progress) {
        progress.set(0.0);
        self.send(Update::Stage(stage, progress.clone()));
    }
}

/// Edge, in pixels, of the squares of the coarse first picture.
const PREVIEW_STEP: u32 = 8;

/// How often provisional figures are sent while counting.
const FIGURES_EVERY: Duration = Duration::from_millis(150);

impl Job {
    fn run(&self) {
        let mut kept = Kept::default();
        while let Some((number, request, progress)) = self.slot.take() {
            let reporter = Reporter {
                job: self,
                request: number,
            };
            match serve(&request, &mut kept, &progress, &reporter) {
                Ok(()) => reporter.send(Update::Done),
                Err(Stop::Cancelled) => {}
                Err(Stop::Failed(reason)) => reporter.send(Update::Failed(reason)),
            }
        }
    }
}

/// Does what a request asks for, from the first stage that differs from the last request.
fn serve(
    request: &Request,
    kept: &mut Kept,
    progress: &Progress,
    reporter: &Reporter<'_>,
) -> Result<(), Stop> {
    let scene = kept.scene(request, progress, reporter)?;
    let render: RenderSettings = request.setup.render;
    // A wrong camera or size is told before work is done for it.
    render.view(&scene)?;

    let pool = kept.pool(render.threads)?;
    let Built { tree, known, .. } = kept.tree(&scene, &request.setup, progress, reporter)?;

    reporter.stage(Stage::Previewing, progress);
    let mut measurement = known.with_render(&scene, &render);
    let picture = Mutex::new(Picture::new(render.width, render.height));
    preview(
        &scene,
        tree,
        &render,
        PREVIEW_STEP,
        &pool,
        progress,
        |tile, colors| lock(&picture).add_tile(tile, 0, colors),
    )?;
    reporter.send(Update::Shown(Box::new(Shown {
        setup: request.setup.clone(),
        reload: request.reload,
        scene: Arc::clone(&scene),
        tree: Arc::clone(tree),
        picture: Arc::new(
            picture
                .into_inner()
                .unwrap_or_else(std::sync::PoisonError::into_inner),
        ),
        measurement: measurement.clone(),
    })));

    let trace = |sample: u32| -> Result<TimedRender, Stop> {
        Ok(render_timed(
            &scene,
            tree,
            &render,
            sample,
            &pool,
            progress,
            |&tile, colors| {
                reporter.send(Update::Tile {
                    tile,
                    sample,
                    colors: colors.to_vec(),
                });
            },
        )?)
    };
    reporter.stage(Stage::Tracing, progress);
    measurement.rendering = Some(trace(0)?);

    reporter.stage(Stage::Counting, progress);
    let pixels = u64::from(render.width) * u64::from(render.height);
    let every_pixel =
        (pixels <= PIXEL_COUNTS_LIMIT).then(|| PixelCounts::new(render.width, render.height));
    let so_far = Mutex::new((measurement.clone(), every_pixel, Instant::now()));
    let counted = render_counted(&scene, tree, &render, &pool, progress, |part| {
        let mut guard = lock(&so_far);
        let (measurement, every_pixel, last) = &mut *guard;
        if let Some(counts) = every_pixel {
            counts.add(&part);
        }
        let sum = measurement.counted.unwrap_or_default().merge(part.sum);
        measurement.counted = Some(sum);
        if last.elapsed() >= FIGURES_EVERY {
            *last = Instant::now();
            reporter.send(Update::Measured {
                measurement: Box::new(measurement.clone()),
                complete: false,
            });
        }
    })?;
    measurement.counted = Some(counted);
    let (_, every_pixel, _) = so_far
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(counts) = every_pixel {
        reporter.send(Update::PixelCounts(Arc::new(counts)));
    }
    reporter.send(Update::Measured {
        measurement: Box::new(measurement),
        complete: true,
    });

    for sample in 1..render.samples {
        reporter.stage(Stage::Refining(sample, render.samples), progress);
        trace(sample)?;
    }
    Ok(())
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner)
}
