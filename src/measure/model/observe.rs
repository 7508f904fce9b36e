//! The rendering time with one tree, and the counts by which equation (1) explains it.

use super::equation::{Equation, Term};
use crate::geometry::Ray;
use crate::measure::MeasureError;
use crate::primitive::{Precision, PrimitiveKind, Shapes};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::structure::{BuildSettings, Tree, build};
use crate::trace::{
    Batch, BoxTest, Children, Hit, Probe, RayKind, RayTracer, RenderError, RenderSettings, Scratch,
    Shading, any_hit, closest_hit, render_timed, thread_pool, tiles, trace_samples,
};

const KINDS: usize = PrimitiveKind::ALL.len();

/// The counts of equation (1) for one tree. Arrays are indexed by [`PrimitiveKind`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Terms {
    /// Rays of all kinds. Their number is the same for every tree.
    pub rays: u64,
    /// Nodes traversed, `N_NODES`.
    pub nodes: u64,
    /// Tests with boxes of children, `N_BT`.
    pub boxes: u64,
    /// Intersection tests.
    pub tests: [u64; KINDS],
    /// Tests that hit, whether or not the hit is the nearest so far.
    pub hits: [u64; KINDS],
    /// Primary and secondary rays whose nearest hit is of this kind, `N_HPR + N_HSECR`.
    pub nearest: [u64; KINDS],
    /// Shadow rays blocked by this kind, `N_HSR`.
    pub blocked: [u64; KINDS],
}

impl Terms {
    /// Returns the factor of a term of the equation.
    pub fn count(&self, term: Term, equation: Equation) -> f64 {
        let count = match (term, equation) {
            (Term::Constant, _) => 1,
            (Term::Node, _) => self.nodes,
            (Term::Box, _) => self.boxes,
            (Term::Hit(kind), Equation::Corrected) => self.hits[kind as usize],
            (Term::Hit(kind), Equation::Printed) => self.nearest[kind as usize],
            (Term::Miss(kind), Equation::Corrected) => {
                self.tests[kind as usize] - self.hits[kind as usize]
            }
            (Term::Miss(kind), Equation::Printed) => {
                let k = kind as usize;
                self.tests[k] - self.nearest[k] - self.blocked[k]
            }
        };
        count as f64
    }

    /// Counts a ray.
    fn add(&mut self, scene: &Scene, kind: RayKind, watcher: &Watcher) {
        let kind_of = |object: u32| scene.objects()[object as usize].kind() as usize;
        self.rays += 1;
        self.nodes += watcher.nodes;
        self.boxes += watcher.boxes;
        for &(object, hit) in &watcher.tests {
            self.tests[kind_of(object)] += 1;
            self.hits[kind_of(object)] += u64::from(hit.is_some());
        }
        if let Some(object) = watcher.answer {
            match kind {
                RayKind::Shadow => self.blocked[kind_of(object)] += 1,
                _ => self.nearest[kind_of(object)] += 1,
            }
        }
    }

    /// Counts a batch of rays in a precision. Those of [`RayKind::Shadow`] end at the first hit.
    pub fn of_batch(scene: &Scene, tree: &Tree, precision: Precision, batch: Batch<'_>) -> Terms {
        let mut terms = Terms::default();
        let mut reporter = Reporter::new(
            tree,
            scene.shapes(precision),
            |traced: &Traced<'_>, watcher: &Watcher| terms.add(scene, traced.kind, watcher),
        );
        reporter.pixels = vec![(0, 0)];
        match batch.kind {
            RayKind::Shadow => reporter.any_hits(batch, &mut Vec::new()),
            _ => reporter.closest_hits(batch, &mut Vec::new()),
        }
        terms
    }
}

/// One tree with its time.
#[derive(Clone, Debug)]
pub struct Observation {
    pub build: BuildSettings,
    pub terms: Terms,
    /// `T_TR` in seconds of CPU time: the minimum of several rounds.
    pub seconds: f64,
}

/// Builds a tree, renders the picture `rounds` times to measure `T_TR`, and counts what equation
/// (1) needs.
///
/// # Errors
/// The same as those of [`crate::measure::measure`].
pub fn observe(
    scene: &Scene,
    settings: &BuildSettings,
    render: &RenderSettings,
    rounds: u32,
    progress: &Progress,
) -> Result<Observation, MeasureError> {
    let tree = build(scene, settings, progress)?;
    let pool = thread_pool(render.threads)?;
    let mut seconds = f64::INFINITY;
    for _ in 0..rounds.max(1) {
        let pass = render_timed(scene, &tree, render, 0, &pool, progress, |_, _| ())?;
        seconds = seconds.min(pass.cpu.as_secs_f64());
    }
    Ok(Observation {
        build: settings.clone(),
        terms: count(scene, &tree, render, progress)?,
        seconds,
    })
}

fn count(
    scene: &Scene,
    tree: &Tree,
    render: &RenderSettings,
    progress: &Progress,
) -> Result<Terms, MeasureError> {
    let mut terms = Terms::default();
    each_ray(scene, tree, render, progress, |traced, watcher| {
        terms.add(scene, traced.kind, watcher);
    })?;
    Ok(terms)
}

/// A ray with its kind.
pub(super) struct Traced<'a> {
    pub kind: RayKind,
    pub ray: &'a Ray,
    /// Column and row of the ray's pixel.
    pub pixel: (u32, u32),
}

/// A record of one ray's traversal.
#[derive(Default)]
pub(super) struct Watcher {
    pub nodes: u64,
    pub boxes: u64,
    /// The tested objects in order, each with the distance of its hit.
    pub tests: Vec<(u32, Option<f64>)>,
    /// The object that the ray hits, or that blocks it.
    pub answer: Option<u32>,
}

impl Probe for Watcher {
    fn inner(&mut self, _: u32, _: [f64; 2], _: f64, _: f64, _: Children) {
        self.nodes += 1;
    }

    fn boxes(&mut self, _: u32, _: [f64; 2], tests: &[BoxTest]) {
        self.nodes += 1;
        self.boxes += tests.len() as u64;
    }

    fn culled(&mut self, _: u32, _: f64, _: f64) {}

    fn leaf(&mut self, _: u32, _: &[u32], _: [f64; 2]) {
        self.nodes += 1;
    }

    fn test(&mut self, object: u32, hit: impl FnOnce() -> Option<f64>) {
        self.tests.push((object, hit()));
    }
}

/// Traces a picture on the current thread and reports every ray.
pub(super) fn each_ray(
    scene: &Scene,
    tree: &Tree,
    render: &RenderSettings,
    progress: &Progress,
    report: impl FnMut(&Traced<'_>, &Watcher),
) -> Result<(), RenderError> {
    let shading = Shading::new(scene, render)?;
    let mut tracer = Reporter::new(tree, shading.shapes, report);
    let mut colors = Vec::new();
    let tiles = tiles(render.width, render.height);
    for (done, tile) in tiles.iter().enumerate() {
        progress.check()?;
        progress.set(done as f64 / tiles.len() as f64);
        let pixels: Vec<_> = (0..tile.len() as u32).map(|i| tile.pixel(i)).collect();
        tracer.pixels.clone_from(&pixels);
        trace_samples(&shading, &pixels, 0, &mut tracer, &mut colors);
    }
    Ok(())
}

/// A kernel that reports every ray.
struct Reporter<'a, F> {
    tree: &'a Tree,
    shapes: &'a Shapes,
    scratch: Scratch,
    watcher: Watcher,
    /// Pixels of the current tile.
    pixels: Vec<(u32, u32)>,
    report: F,
}

impl<'a, F: FnMut(&Traced<'_>, &Watcher)> Reporter<'a, F> {
    fn new(tree: &'a Tree, shapes: &'a Shapes, report: F) -> Self {
        Reporter {
            tree,
            shapes,
            scratch: Scratch::default(),
            watcher: Watcher::default(),
            pixels: Vec::new(),
            report,
        }
    }

    fn clear(&mut self) {
        self.watcher.nodes = 0;
        self.watcher.boxes = 0;
        self.watcher.tests.clear();
        self.watcher.answer = None;
    }

    fn report(&mut self, kind: RayKind, ray: &Ray, pixel: u32, answer: Option<u32>) {
        self.watcher.answer = answer;
        let pixel = self.pixels[pixel as usize];
        (self.report)(&Traced { kind, ray, pixel }, &self.watcher);
    }
}

impl<F: FnMut(&Traced<'_>, &Watcher)> RayTracer for Reporter<'_, F> {
    fn closest_hits(&mut self, batch: Batch<'_>, hits: &mut Vec<Hit>) {
        hits.clear();
        for (ray, &pixel) in batch.rays.iter().zip(batch.pixels) {
            self.clear();
            let (scratch, watcher) = (&mut self.scratch, &mut self.watcher);
            let hit = closest_hit(self.tree, self.shapes, ray, scratch, watcher);
            let answer = hit.is_hit().then_some(hit.object);
            self.report(batch.kind, ray, pixel, answer);
            hits.push(hit);
        }
    }

    fn any_hits(&mut self, batch: Batch<'_>, blocked: &mut Vec<bool>) {
        blocked.clear();
        for (ray, &pixel) in batch.rays.iter().zip(batch.pixels) {
            self.clear();
            let (scratch, watcher) = (&mut self.scratch, &mut self.watcher);
            let hit = any_hit(self.tree, self.shapes, ray, scratch, watcher);
            let answer = watcher.tests.last().filter(|_| hit).map(|test| test.0);
            self.report(batch.kind, ray, pixel, answer);
            blocked.push(hit);
        }
    }
}
