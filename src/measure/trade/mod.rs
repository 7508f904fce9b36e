//! What accuracy costs: choices that buy speed with it, each alone and all together, by time and
//! error against a reference.
//!
//! Times are CPU times of the picture with all its samples, medians over rounds in which every choice
//! has its turn, so that a machine that slows down slows all of them. FLIP is left out: its one
//! implementation takes a C++ compiler.

mod error;
mod front;
mod knobs;

pub use error::ImageError;
pub use front::pareto_front;
pub use knobs::{KNOBS, Knob};

use super::MeasureError;
use crate::primitive::Primitive;
use crate::progress::{Cancelled, Progress};
use crate::scene::{Cylinders, Scene};
use crate::trace::{
    Picture, PrecisionChoice, RenderError, RenderSettings, Scratch, closest_hit, thread_pool,
    timed_pass,
};
use crate::tree::{BuildSettings, Tree, build};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Everything that a point of the trade is made with.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    pub cylinders: Cylinders,
    pub build: BuildSettings,
    pub render: RenderSettings,
}

/// What distinguishes a point from the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// Knobs and what they are turned to; none at the reference.
    pub turned: Vec<(&'static str, String)>,
    /// Whether a knob among them moves the picture.
    pub moves_image: bool,
    pub setting: Setting,
}

impl Choice {
    /// Such as `samples 4, precision f32`, or `reference`.
    pub fn words(&self) -> String {
        let words: Vec<_> = self
            .turned
            .iter()
            .map(|(knob, value)| format!("{knob} {value}"))
            .collect();
        if words.is_empty() {
            "reference".into()
        } else {
            words.join(", ")
        }
    }
}

/// A choice with its time and error.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    pub choice: Choice,
    /// CPU seconds of every round, ascending; there is at least one.
    pub seconds: Vec<f64>,
    /// Share of the reference's pixels whose primary ray meets another object, or none, or one where
    /// it should meet none. The polygons of a cylinder count as the cylinder.
    pub wrong_hits: f64,
    pub error: ImageError,
    /// Bytes of the objects as intersection tests take them.
    pub object_bytes: u64,
}

impl Outcome {
    /// The median of an odd number of rounds, else the lower of the two in the middle.
    pub fn median(&self) -> f64 {
        self.seconds[(self.seconds.len() - 1) / 2]
    }
}

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

    /// Whether each outcome is on the front of time and RMSE. Choices that move only the time are not
    /// part of that trade.
    pub fn front(&self) -> Vec<bool> {
        let points: Vec<_> = self
            .outcomes
            .iter()
            .map(|outcome| {
                let rmse = if outcome.choice.moves_image || outcome.choice.turned.is_empty() {
                    outcome.error.rmse
                } else {
                    f64::NAN
                };
                [self.ratios(outcome)[1], rmse]
            })
            .collect();
        pareto_front(&points)
    }
}

/// The reference of a trade: `f64`, exact cylinders, secondary rays at least 8 deep without a cut-off.
pub fn reference(build: &BuildSettings, render: &RenderSettings) -> Setting {
    Setting {
        cylinders: Cylinders::Exact,
        build: build.clone(),
        render: RenderSettings {
            precision: PrecisionChoice::F64,
            d_arec: render.d_arec.max(8),
            cut_off: 0.0,
            ..*render
        },
    }
}

/// The reference; every knob alone at every value; and those that move the picture together, all at
/// their first value, all at their second, and so on, a knob without one at its last.
pub fn choices(reference: &Setting, scene: &Scene) -> Vec<Choice> {
    let mut choices = vec![Choice {
        turned: Vec::new(),
        moves_image: false,
        setting: reference.clone(),
    }];
    for knob in KNOBS {
        for (value, setting) in (knob.values)(reference, scene) {
            choices.push(Choice {
                turned: vec![(knob.name, value)],
                moves_image: knob.moves_image,
                setting,
            });
        }
    }
    let image_knobs = || KNOBS.iter().filter(|knob| knob.moves_image);
    let steps = image_knobs().map(|knob| (knob.values)(reference, scene).len());
    for step in 0..steps.max().unwrap_or(0) {
        let mut together = choices[0].clone();
        for knob in image_knobs() {
            // The steps are those at the reference; what was turned before may leave nothing to turn.
            let count = (knob.values)(reference, scene).len();
            let Some(step) = count.checked_sub(1).map(|last| step.min(last)) else {
                continue;
            };
            let Some((value, setting)) = (knob.values)(&together.setting, scene)
                .into_iter()
                .nth(step)
            else {
                continue;
            };
            together.turned.push((knob.name, value));
            together.setting = setting;
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
    let Some(first) = choices.first() else {
        return Ok(Trade {
            outcomes: Vec::new(),
        });
    };
    let pool = thread_pool(first.setting.render.threads)?;
    let size = [first.setting.render.width, first.setting.render.height];
    let mut made = Made::default();
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut reference: Option<View> = None;
    let steps = f64::from(rounds.max(1)) * choices.len() as f64;
    for round in 0..rounds.max(1) {
        for (place, choice) in choices.iter().enumerate() {
            let done = f64::from(round) * choices.len() as f64 + place as f64;
            let part = progress.part(done / steps, (done + 1.0) / steps);
            let (scene, tree) = pool.install(|| made.get(exact, &choice.setting, &part))?;
            let (picture, seconds) = traced(scene, tree, &choice.setting.render, &pool, &part)?;
            if round == 0 {
                let owners = owners(exact, choice.setting.cylinders);
                let objects = objects(scene, tree, &choice.setting.render, &owners, &pool)?;
                let precision = choice.setting.render.precision_for(scene).precision;
                let bytes = scene.shapes(precision).bytes();
                let seen = View::new(&picture, &objects, size);
                let right = reference.get_or_insert_with(|| seen.clone());
                outcomes.push(Outcome {
                    choice: choice.clone(),
                    seconds: Vec::new(),
                    wrong_hits: seen.wrong_hits(right),
                    error: ImageError::between(&seen.colors, &right.colors, size[0] as usize),
                    object_bytes: bytes as u64,
                });
            }
            let outcome = &mut outcomes[place];
            let at = outcome.seconds.partition_point(|&s| s < seconds);
            outcome.seconds.insert(at, seconds);
            on_outcome(place, outcome);
        }
    }
    Ok(Trade { outcomes })
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
        setting: &Setting,
        progress: &Progress,
    ) -> Result<(&Scene, &Tree), MeasureError> {
        let cylinders = setting.cylinders;
        let scene = match self.scenes.iter().position(|(c, _)| *c == cylinders) {
            Some(place) => place,
            None => {
                let scene = Scene::new(cylinders.apply(exact.parts().clone()));
                self.scenes.push((cylinders, scene));
                self.scenes.len() - 1
            }
        };
        let scene = &self.scenes[scene].1;
        let key = (cylinders, setting.build.clone());
        let tree = match self.trees.iter().position(|(k, _)| *k == key) {
            Some(place) => place,
            None => {
                let tree = build(scene, &setting.build, progress)?;
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
        let pass = timed_pass(scene, tree, render, sample, pool, &part, |tile, colors| {
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
    let view = render.view()?;
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
