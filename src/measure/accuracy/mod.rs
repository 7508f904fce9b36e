//! What accuracy costs: choices that buy speed with it, each alone and all together, by time and
//! error against a reference.
//!
//! Times are CPU times of the picture with all its samples, medians over rounds in which every choice
//! has its turn, so that a machine that slows down slows all of them.

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

/// All that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// The reference first, with no error and the ratio 1.
    pub outcomes: Vec<Outcome>,
}

impl Trade {
    /// Time as a ratio to the reference: the least, the median and the largest of the rounds, each
    /// over the reference's median. The reference's own median is 1.
    pub fn ratios(&self, outcome: &Outcome) -> [f64; 3] {
        let unit = self.outcomes[0].median();
        let last = outcome.seconds.len() - 1;
        [outcome.seconds[0], outcome.median(), outcome.seconds[last]].map(|s| s / unit)
    }

    /// Whether each outcome is on the front of time and RMSE.
    pub fn front(&self) -> Vec<bool> {
        self.front_by(&ERROR_MEASURES[0])
    }

    /// Whether each outcome is on the front of time and this error. Choices that move only the time
    /// are not part of that trade.
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

/// The reference of a trade: `f64`, exact cylinders, secondary rays at least 8 deep without a minimum contribution.
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

/// The reference; every knob alone at every value; and those that move the picture together, all at
/// their first value, all at their second, and so on, a knob without one at its last.
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
            // The steps are those at the reference; what was turned before may leave nothing to turn.
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

/// Takes a trade: every choice traced in `rounds` rounds, at least 1. `on_outcome` is told of every
/// choice after each of its turns, with its place and its times so far.
///
/// # Errors
/// Settings out of range, a tree beyond the memory limit, no view, or cancellation.
pub fn trade(
    exact: &Scene,
    choices: Vec<Choice>,
    rounds: u32,
    progress: &Progress,
    mut on_outcome: impl FnMut(usize, &Outcome),
) -> Result<Trade, MeasureError> {
    let mut trading = Trading::new(exact, choices, rounds)?;
    let turns = trading.turns() as f64;
    for turn in 0..trading.turns() {
        let part = progress.part(turn as f64 / turns, (turn + 1) as f64 / turns);
        if let Some(turn) = trading.turn(&part)? {
            on_outcome(turn.place, &trading.outcomes[turn.place]);
        }
    }
    Ok(Trade {
        outcomes: trading.outcomes,
    })
}

/// A trade that is taken turn by turn. A turn that was cancelled can be taken again.
pub struct Trading<'a> {
    exact: &'a Scene,
    choices: Vec<Choice>,
    rounds: usize,
    pool: rayon::ThreadPool,
    made: Made,
    reference: Option<View>,
    outcomes: Vec<Outcome>,
    /// Turns taken.
    taken: usize,
}

/// What came of one turn.
pub struct Turn {
    /// Which of the outcomes has another time now; in the first round, which is new.
    pub place: usize,
    /// [`pixel_errors`] in the reference's size; `None` after the first round, where they are the same
    /// again.
    pub pixel_errors: Option<Vec<f32>>,
}

impl<'a> Trading<'a> {
    /// Every choice in `rounds` rounds, at least 1, the reference first; no turn is taken yet.
    ///
    /// # Errors
    /// The reference's threads cannot be had.
    pub fn new(exact: &'a Scene, choices: Vec<Choice>, rounds: u32) -> Result<Self, MeasureError> {
        let threads = choices.first().map_or(0, |c| c.setup.render.threads);
        Ok(Trading {
            exact,
            choices,
            rounds: rounds.max(1) as usize,
            pool: thread_pool(threads)?,
            made: Made::default(),
            reference: None,
            outcomes: Vec::new(),
            taken: 0,
        })
    }

    /// How many turns there are in all.
    pub fn turns(&self) -> usize {
        self.rounds * self.choices.len()
    }

    /// What is known so far: after the first round, every choice.
    pub fn outcomes(&self) -> &[Outcome] {
        &self.outcomes
    }

    /// Takes the next turn; `None` where all were taken.
    ///
    /// # Errors
    /// Settings out of range, a tree beyond the memory limit, no view, or cancellation.
    pub fn turn(&mut self, progress: &Progress) -> Result<Option<Turn>, MeasureError> {
        if self.taken == self.turns() {
            return Ok(None);
        }
        let place = self.taken % self.choices.len();
        let choice = &self.choices[place];
        let (made, exact) = (&mut self.made, self.exact);
        let (scene, tree) = self
            .pool
            .install(|| made.get(exact, &choice.setup, progress))?;
        let render = &choice.setup.render;
        let (picture, seconds) = traced(scene, tree, render, &self.pool, progress)?;
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
        self.taken += 1;
        Ok(Some(Turn {
            place,
            pixel_errors,
        }))
    }
}

/// The scenes and trees made so far: most choices share them.
#[derive(Default)]
struct Made {
    scenes: Vec<(Cylinders, Scene)>,
    trees: Vec<((Cylinders, BuildSettings), Tree)>,
}

impl Made {
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

/// All samples of a picture, and their CPU time in seconds.
fn traced(
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

/// For every object of the scene with cylinders taken so, the object that it is part of.
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

/// What each pixel's primary ray meets, row by row; `u32::MAX` for nothing.
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

/// A picture in the reference's size, its pixels repeated where it has fewer.
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

    fn wrong_hits(&self, right: &View) -> f64 {
        let pairs = self.objects.iter().zip(&right.objects);
        pairs.filter(|(a, b)| a != b).count() as f64 / self.objects.len() as f64
    }
}
