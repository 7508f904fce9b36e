//! The accuracy study: measures how much time each cheaper setting saves and how much error it
//! causes.
//!
//! Every choice of settings is rendered and compared with a reference. A choice changes one
//! setting, or several at once.
//!
//! A time is the CPU time of the render with all its samples. Rounds are interleaved: each round
//! measures every choice once, so that a machine that slows down affects all choices alike.

mod error;
mod filter;
mod flip;
mod front;
mod knobs;
mod measures;
mod outcome;

pub use error::{ImageError, pixel_errors};
pub use front::pareto_front;
pub use knobs::{KNOBS, Knob};
pub use measures::{ERROR_MEASURES, ErrorMeasure};
pub use outcome::{Choice, Outcome};

use super::MeasureError;
use crate::primitive::Primitive;
use crate::progress::{Cancelled, Progress};
use crate::scene::{Cylinders, Scene, SceneRequest};
use crate::setup::Setup;
use crate::structure::{BuildSettings, Tree, build};
use crate::trace::{
    Picture, PrecisionChoice, RenderError, RenderSettings, Scratch, closest_hit, render_timed,
    thread_pool,
};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// The result of an accuracy study: all choices that were measured.
#[derive(Clone, Debug, PartialEq)]
pub struct AccuracyStudy {
    /// The reference comes first, with error 0 and time ratio 1.
    pub outcomes: Vec<Outcome>,
}

impl AccuracyStudy {
    /// Returns the outcome's time relative to the reference: the minimum, median and maximum over
    /// the rounds, each divided by the reference's median.
    pub fn ratios(&self, outcome: &Outcome) -> [f64; 3] {
        let unit = self.outcomes[0].median();
        let last = outcome.seconds.len() - 1;
        [outcome.seconds[0], outcome.median(), outcome.seconds[last]].map(|s| s / unit)
    }

    /// Returns, for each outcome, whether it is on the Pareto front of time and RMSE.
    pub fn front(&self) -> Vec<bool> {
        self.front_by(&ERROR_MEASURES[0])
    }

    /// Returns, for each outcome, whether it is on the Pareto front of time and this error. Choices
    /// that change only the time are never on the front; the reference can be.
    pub fn front_by(&self, error: &ErrorMeasure) -> Vec<bool> {
        let points: Vec<_> = self
            .outcomes
            .iter()
            .map(|outcome| {
                let error = if outcome.choice.moves_image || outcome.choice.turned.is_empty() {
                    (error.value)(outcome)
                } else {
                    f64::NAN
                };
                [self.ratios(outcome)[1], error]
            })
            .collect();
        pareto_front(&points)
    }
}

/// Returns the reference settings of a study: `f64`, exact cylinders, secondary rays at least 8
/// deep, and no minimum contribution.
pub fn reference(setup: &Setup) -> Setup {
    Setup {
        scene: SceneRequest {
            cylinders: Cylinders::Exact,
            ..setup.scene.clone()
        },
        build: setup.build.clone(),
        render: RenderSettings {
            precision: PrecisionChoice::F64,
            d_arec: setup.render.d_arec.max(8),
            min_contribution: 0.0,
            ..setup.render
        },
    }
}

/// Returns the choices of a study: the reference, then every knob alone at each of its values, then
/// the knobs that change the image combined.
///
/// The first combination sets every such knob to its first value, the second to its second value,
/// and so on. A knob with fewer values stays at its last.
pub fn choices(reference: &Setup, scene: &Scene) -> Vec<Choice> {
    let mut choices = vec![Choice {
        turned: Vec::new(),
        moves_image: false,
        setup: reference.clone(),
    }];
    for knob in KNOBS {
        for (value, setup) in knob.choices(reference, scene) {
            choices.push(Choice {
                turned: vec![(knob.name(), value)],
                moves_image: knob.moves_image(),
                setup,
            });
        }
    }
    let image_knobs = || KNOBS.iter().filter(|knob| knob.moves_image());
    let steps = image_knobs().map(|knob| knob.choices(reference, scene).len());
    for step in 0..steps.max().unwrap_or(0) {
        let mut together = choices[0].clone();
        for knob in image_knobs() {
            // The number of combinations comes from the reference. The knobs set so far may leave
            // this knob fewer values, or none.
            let count = knob.choices(reference, scene).len();
            let Some(step) = count.checked_sub(1).map(|last| step.min(last)) else {
                continue;
            };
            let Some((value, setup)) = knob.choices(&together.setup, scene).into_iter().nth(step)
            else {
                continue;
            };
            together.turned.push((knob.name(), value));
            together.setup = setup;
        }
        together.moves_image = true;
        choices.push(together);
    }
    choices
}

/// An accuracy study that is under way, turn by turn. A turn measures one choice once. A cancelled
/// turn can be run again.
pub struct StudyRun<'a> {
    exact: &'a Scene,
    choices: Vec<Choice>,
    rounds: usize,
    pool: rayon::ThreadPool,
    cache: Cache,
    reference: Option<View>,
    outcomes: Vec<Outcome>,
    /// Number of completed turns.
    turns_done: usize,
}

/// The result of one turn.
pub struct Turn {
    /// Index of the outcome that has a new time. In the first round, the outcome itself is new.
    pub place: usize,
    /// The [`pixel_errors`] at the reference's size. `None` after the first round, because they do
    /// not change.
    pub pixel_errors: Option<Vec<f32>>,
}

impl<'a> StudyRun<'a> {
    /// Creates a study of every choice in `rounds` rounds (at least 1), the reference first. Runs
    /// no turn yet.
    ///
    /// # Errors
    /// The thread pool of the reference cannot be created.
    pub fn new(exact: &'a Scene, choices: Vec<Choice>, rounds: u32) -> Result<Self, MeasureError> {
        let threads = choices.first().map_or(0, |c| c.setup.render.threads);
        Ok(StudyRun {
            exact,
            choices,
            rounds: rounds.max(1) as usize,
            pool: thread_pool(threads)?,
            cache: Cache::default(),
            reference: None,
            outcomes: Vec::new(),
            turns_done: 0,
        })
    }

    /// Returns the total number of turns.
    pub fn turns(&self) -> usize {
        self.rounds * self.choices.len()
    }

    /// Returns the outcomes so far. After the first round, every choice has one.
    pub fn outcomes(&self) -> &[Outcome] {
        &self.outcomes
    }

    /// Returns the study of the turns that were run.
    pub fn finish(self) -> AccuracyStudy {
        AccuracyStudy {
            outcomes: self.outcomes,
        }
    }

    /// Runs the next turn. Returns `None` if all turns are done.
    ///
    /// # Errors
    /// Settings out of range, a tree beyond the memory limit, no view, or cancellation.
    pub fn turn(&mut self, progress: &Progress) -> Result<Option<Turn>, MeasureError> {
        if self.turns_done == self.turns() {
            return Ok(None);
        }
        let place = self.turns_done % self.choices.len();
        let choice = &self.choices[place];
        let (cache, exact) = (&mut self.cache, self.exact);
        let (scene, tree) = self
            .pool
            .install(|| cache.get(exact, &choice.setup, progress))?;
        let render = &choice.setup.render;
        let (picture, seconds) = render_all_samples(scene, tree, render, &self.pool, progress)?;
        let mut pixel_errors = None;
        if place == self.outcomes.len() {
            let owners = owners(self.exact, choice.setup.scene.cylinders);
            let objects = objects(scene, tree, render, &owners, &self.pool)?;
            let precision = render.precision_for(scene).precision;
            let first = &self.choices[0].setup.render;
            let seen = View::new(&picture, &objects, [first.width, first.height]);
            let right = self.reference.get_or_insert_with(|| seen.clone());
            pixel_errors = Some(error::pixel_errors(&seen.colors, &right.colors));
            self.outcomes.push(Outcome {
                choice: choice.clone(),
                seconds: Vec::new(),
                wrong_hits: seen.wrong_hits(right),
                error: ImageError::between(&seen.colors, &right.colors, first.width as usize),
                object_bytes: scene.shapes(precision).bytes() as u64,
            });
        }
        let times = &mut self.outcomes[place].seconds;
        times.insert(times.partition_point(|&s| s < seconds), seconds);
        self.turns_done += 1;
        Ok(Some(Turn {
            place,
            pixel_errors,
        }))
    }
}

/// The scenes and trees built so far, which most choices share.
#[derive(Default)]
struct Cache {
    scenes: Vec<(Cylinders, Scene)>,
    trees: Vec<((Cylinders, BuildSettings), Tree)>,
}

/// Returns the scene and the tree of a setup, and builds them if they are not in the cache.
impl Cache {
    fn get(
        &mut self,
        exact: &Scene,
        setup: &Setup,
        progress: &Progress,
    ) -> Result<(&Scene, &Tree), MeasureError> {
        let cylinders = setup.scene.cylinders;
        let scene = match self.scenes.iter().position(|(c, _)| *c == cylinders) {
            Some(place) => place,
            None => {
                let scene = Scene::new(cylinders.apply(exact.parts().clone()));
                self.scenes.push((cylinders, scene));
                self.scenes.len() - 1
            }
        };
        let scene = &self.scenes[scene].1;
        let key = (cylinders, setup.build.clone());
        let tree = match self.trees.iter().position(|(k, _)| *k == key) {
            Some(place) => place,
            None => {
                let tree = build(scene, &setup.build, progress)?;
                self.trees.push((key, tree));
                self.trees.len() - 1
            }
        };
        Ok((scene, &self.trees[tree].1))
    }
}

/// Renders all samples of a picture. Returns the picture and its CPU time in seconds.
fn render_all_samples(
    scene: &Scene,
    tree: &Tree,
    render: &RenderSettings,
    pool: &rayon::ThreadPool,
    progress: &Progress,
) -> Result<(Picture, f64), RenderError> {
    let picture = Mutex::new(Picture::new(render.width, render.height));
    let mut seconds = 0.0;
    let samples = f64::from(render.samples);
    for sample in 0..render.samples {
        let done = f64::from(sample) / samples;
        let part = progress.part(done, done + 1.0 / samples);
        let pass = render_timed(scene, tree, render, sample, pool, &part, |tile, colors| {
            let mut picture = picture.lock().unwrap_or_else(PoisonError::into_inner);
            picture.add_tile(tile, sample, colors);
        })?;
        seconds += pass.cpu.as_secs_f64();
    }
    progress.check().map_err(|Cancelled| Cancelled)?;
    let picture = picture.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok((picture, seconds))
}

/// Returns, for each object of the scene with this representation of cylinders, the number of the
/// exact object that it belongs to.
fn owners(exact: &Scene, cylinders: Cylinders) -> Vec<u32> {
    let mut owners = Vec::new();
    for (object, number) in exact.objects().iter().zip(0..) {
        let parts = match (object, cylinders) {
            (Primitive::Cone(cone), Cylinders::Polygons(sides)) => cone.prism(sides).len(),
            _ => 1,
        };
        owners.resize(owners.len() + parts, number);
    }
    owners
}

/// Returns the exact object that each pixel's primary ray hits, row by row; `u32::MAX` for a miss.
fn objects(
    scene: &Scene,
    tree: &Tree,
    render: &RenderSettings,
    owners: &[u32],
    pool: &rayon::ThreadPool,
) -> Result<Vec<u32>, RenderError> {
    let view = render.view(scene)?;
    let shapes = scene.shapes(render.precision_for(scene).precision);
    Ok(pool.install(|| {
        (0..render.height)
            .into_par_iter()
            .flat_map_iter(|y| {
                let mut scratch = Scratch::default();
                (0..render.width).map(move |x| {
                    let ray = view.primary_ray(x, y, 0);
                    let hit = closest_hit(tree, shapes, &ray, &mut scratch, &mut ());
                    owners.get(hit.object as usize).copied().unwrap_or(u32::MAX)
                })
            })
            .collect()
    }))
}

/// A picture scaled to the reference's size by repeating pixels.
#[derive(Clone)]
struct View {
    colors: Vec<[f32; 3]>,
    objects: Vec<u32>,
}

impl View {
    fn new(picture: &Picture, objects: &[u32], [width, height]: [u32; 2]) -> Self {
        let nearest =
            |i: u32, of: u32, to: u32| (u64::from(i) * u64::from(of) / u64::from(to)) as u32;
        let places = || {
            (0..height).flat_map(move |y| {
                let y = nearest(y, picture.height, height);
                (0..width).map(move |x| (nearest(x, picture.width, width), y))
            })
        };
        View {
            colors: places().map(|(x, y)| picture.get(x, y)).collect(),
            objects: places()
                .map(|(x, y)| objects[(y * picture.width + x) as usize])
                .collect(),
        }
    }

    /// Returns the share of pixels whose primary ray hits another object than in the reference, 0
    /// to 1.
    fn wrong_hits(&self, right: &View) -> f64 {
        let pairs = self.objects.iter().zip(&right.objects);
        pairs.filter(|(a, b)| a != b).count() as f64 / self.objects.len() as f64
    }
}
