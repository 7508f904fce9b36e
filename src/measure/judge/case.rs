//! A fault as a small file that can be replayed.

use super::tolerance::Tolerance;
use super::verdict::{Answer, Standing, Verdict, examine, scale_of, settle};
use crate::geometry::{Ray, Vec3};
use crate::measure::verify::{ask, unsplit};
use crate::primitive::Precision;
use crate::progress::Progress;
use crate::scene::format::{ReadError, nff};
use crate::scene::{Scene, SceneParts};
use crate::structure::{BuildError, BuildSettings, build};
use crate::trace::{Hit, RayKind};
use serde::{Deserialize, Serialize};

/// Who gave an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Answerer {
    /// The tree with these settings.
    Tree(BuildSettings),
    /// Another program, which computes in this precision.
    Program(Precision),
}

/// A ray for which a tree and testing every object disagree, or to which another program gave a wrong answer,
/// with everything needed to reproduce it.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    pub scene: Scene,
    pub by: Answerer,
    pub kind: RayKind,
    pub ray: Ray,
    /// The answer from testing every object.
    pub expected: Answer,
    /// The answer of the tree or the program.
    pub found: Answer,
}

/// Why a case could not be read.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    #[error("not a case: {0}")]
    Json(#[from] serde_json::Error),
    #[error("the case's scene, line {0}")]
    Scene(#[from] ReadError),
    #[error("neither the settings of a tree nor the precision of a program")]
    Answerer,
    #[error("no rays are called '{0}'")]
    Kind(String),
    #[error(transparent)]
    Build(#[from] BuildError),
}

/// The file format. Numbers are written in the shortest form that reads back to the same bits. An
/// infinite number is `null`.
#[derive(Serialize, Deserialize)]
struct File {
    /// NFF, line by line; objects count from 0.
    scene: Vec<String>,
    /// Of the tree; missing for the answer of another program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    settings: Option<BuildSettings>,
    /// Of the other program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    precision: Option<Precision>,
    kind: String,
    origin: Vec3,
    direction: Vec3,
    t_min: f64,
    t_max: Option<f64>,
    expected: FileAnswer,
    found: FileAnswer,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum FileAnswer {
    Hit { object: u32, t: f64 },
    Miss,
    Blocked(bool),
}

impl From<Answer> for FileAnswer {
    fn from(answer: Answer) -> Self {
        match answer {
            Answer::Blocked(blocked) => FileAnswer::Blocked(blocked),
            Answer::Nearest(Hit { t, object }) if object != Hit::MISS.object => {
                FileAnswer::Hit { object, t }
            }
            Answer::Nearest(_) => FileAnswer::Miss,
        }
    }
}

impl From<FileAnswer> for Answer {
    fn from(answer: FileAnswer) -> Self {
        match answer {
            FileAnswer::Blocked(blocked) => Answer::Blocked(blocked),
            FileAnswer::Hit { object, t } => Answer::Nearest(Hit { t, object }),
            FileAnswer::Miss => Answer::Nearest(Hit::MISS),
        }
    }
}

impl Case {
    /// Traces a ray with the tree and by testing every object. Returns `None` if they agree.
    ///
    /// # Errors
    /// Building a tree fails.
    pub fn of(
        scene: &Scene,
        settings: &BuildSettings,
        kind: RayKind,
        ray: Ray,
    ) -> Result<Option<Case>, BuildError> {
        let progress = Progress::new();
        let expected = ask(scene, &unsplit(scene, &progress)?, kind, &ray);
        let found = ask(scene, &build(scene, settings, &progress)?, kind, &ray);
        Ok((expected != found).then(|| Case {
            scene: scene.clone(),
            by: Answerer::Tree(settings.clone()),
            kind,
            ray,
            expected,
            found,
        }))
    }

    /// Checks the answer of another program, which computes in a precision. Returns `None` if it is right, a tie
    /// or rounding.
    ///
    /// # Errors
    /// The scene has too many objects.
    pub fn of_program(
        scene: &Scene,
        precision: Precision,
        ray: Ray,
        found: Answer,
    ) -> Result<Option<Case>, BuildError> {
        let tolerance = Tolerance::of(precision, scale_of(scene, &ray));
        if examine(scene, &ray, found, tolerance) != Standing::Wrong {
            return Ok(None);
        }
        let kind = match found {
            Answer::Nearest(_) => RayKind::Primary,
            Answer::Blocked(_) => RayKind::Shadow,
        };
        Ok(Some(Case {
            scene: scene.clone(),
            by: Answerer::Program(precision),
            kind,
            ray,
            expected: ask(scene, &unsplit(scene, &Progress::new())?, kind, &ray),
            found,
        }))
    }

    /// Returns the verdict. Both answers of a tree come from the same coordinates, so no rounding is allowed.
    pub fn verdict(&self) -> Verdict {
        match self.by {
            Answerer::Tree(_) => settle(&self.scene, &self.ray, [self.expected, self.found], None),
            Answerer::Program(precision) => {
                let tolerance = Tolerance::of(precision, scale_of(&self.scene, &self.ray));
                match examine(&self.scene, &self.ray, self.found, tolerance) {
                    Standing::Right => Verdict::Tie,
                    Standing::Rounded => Verdict::Rounding,
                    Standing::Wrong => Verdict::Fault {
                        a_is_wrong: false,
                        b_is_wrong: true,
                    },
                }
            }
        }
    }

    /// Removes objects that the fault does not need, in at most a hundred attempts.
    pub fn shrunk(self) -> Case {
        const ATTEMPTS: usize = 100;
        if let Answerer::Program(_) = self.by {
            // Mostly two objects matter: the one that was hit and the one that should have been.
            let mut objects: Vec<usize> = [self.expected, self.found]
                .into_iter()
                .filter_map(object_of)
                .filter(|&object| object < self.scene.objects().len())
                .collect();
            objects.sort_unstable();
            objects.dedup();
            if let Some(case) = self.only(&objects) {
                return case;
            }
        }
        let objects = fewest(self.scene.objects().len(), ATTEMPTS, |kept| {
            self.only(kept).is_some()
        });
        self.only(&objects).unwrap_or(self)
    }

    /// Returns the case with only these objects, or `None` if it is no longer a fault.
    fn only(&self, objects: &[usize]) -> Option<Case> {
        let all = self.scene.parts();
        let parts = SceneParts {
            objects: objects.iter().map(|&i| all.objects[i].clone()).collect(),
            material_of: objects.iter().map(|&i| all.material_of[i]).collect(),
            ..all.clone()
        };
        let scene = Scene::new(parts);
        let case = match &self.by {
            Answerer::Tree(settings) => Case::of(&scene, settings, self.kind, self.ray),
            Answerer::Program(precision) => {
                let found = renumbered(self.found, objects)?;
                Case::of_program(&scene, *precision, self.ray, found)
            }
        };
        case.ok()?
            .filter(|case| matches!(case.verdict(), Verdict::Fault { .. }))
    }

    /// Returns the case as the text of a file.
    pub fn to_json(&self) -> String {
        let mut scene = Vec::new();
        nff::write(self.scene.parts(), &mut scene).expect("memory takes all that is written");
        let scene = String::from_utf8_lossy(&scene);
        let (settings, precision) = match &self.by {
            Answerer::Tree(settings) => (Some(settings.clone()), None),
            Answerer::Program(precision) => (None, Some(*precision)),
        };
        let file = File {
            scene: scene.lines().map(str::to_owned).collect(),
            settings,
            precision,
            kind: self.kind.name().to_owned(),
            origin: self.ray.origin,
            direction: self.ray.direction,
            t_min: self.ray.t_min,
            t_max: Some(self.ray.t_max).filter(|t| t.is_finite()),
            expected: self.expected.into(),
            found: self.found.into(),
        };
        serde_json::to_string_pretty(&file).expect("all of it can be written as JSON")
    }

    /// Reads a case from the text of a file.
    ///
    /// # Errors
    /// The text is not JSON, or not a case.
    pub fn from_json(text: &str) -> Result<Case, CaseError> {
        let file: File = serde_json::from_str(text)?;
        let parts = nff::read(file.scene.join("\n").as_bytes(), &Progress::new())?;
        let kind = RayKind::ALL
            .into_iter()
            .find(|kind| kind.name() == file.kind)
            .ok_or(CaseError::Kind(file.kind))?;
        Ok(Case {
            scene: Scene::new(parts),
            by: match file.settings {
                Some(settings) => Answerer::Tree(settings),
                None => Answerer::Program(file.precision.ok_or(CaseError::Answerer)?),
            },
            kind,
            ray: Ray {
                origin: file.origin,
                direction: file.direction,
                t_min: file.t_min,
                t_max: file.t_max.unwrap_or(f64::INFINITY),
            },
            expected: file.expected.into(),
            found: file.found.into(),
        })
    }

    /// Traces the ray again, or checks the answer of another program again. Returns `None` if both answers agree
    /// now.
    ///
    /// # Errors
    /// Building a tree fails.
    pub fn replay(&self) -> Result<Option<Case>, BuildError> {
        match &self.by {
            Answerer::Tree(settings) => Case::of(&self.scene, settings, self.kind, self.ray),
            Answerer::Program(precision) => {
                Case::of_program(&self.scene, *precision, self.ray, self.found)
            }
        }
    }
}

/// Returns the object that an answer says is hit.
fn object_of(answer: Answer) -> Option<usize> {
    match answer {
        Answer::Nearest(hit) if hit.is_hit() => Some(hit.object as usize),
        Answer::Nearest(_) | Answer::Blocked(_) => None,
    }
}

/// Returns an answer about a scene in which only some objects are left; `None` if its object is not.
fn renumbered(answer: Answer, objects: &[usize]) -> Option<Answer> {
    let Some(object) = object_of(answer) else {
        return Some(answer);
    };
    let place = objects.iter().position(|&kept| kept == object)?;
    match answer {
        Answer::Nearest(hit) => Some(Answer::Nearest(Hit {
            object: place as u32,
            ..hit
        })),
        Answer::Blocked(_) => Some(answer),
    }
}

/// Returns a small subset of the indices below `count` that still `fails`, after at most `attempts`
/// attempts. Removes large parts first, then smaller ones (A. Zeller and R. Hildebrandt,
/// "Simplifying and isolating failure-inducing input", 2002).
fn fewest(count: usize, attempts: usize, fails: impl Fn(&[usize]) -> bool) -> Vec<usize> {
    let mut kept: Vec<usize> = (0..count).collect();
    let mut left = attempts;
    let mut part = count.div_ceil(2);
    while part > 0 {
        let mut from = 0;
        while from < kept.len() && left > 0 {
            left -= 1;
            let to = (from + part).min(kept.len());
            let rest = [&kept[..from], &kept[to..]].concat();
            if fails(&rest) {
                kept = rest;
            } else {
                from = to;
            }
        }
        part = if part == 1 || left == 0 {
            0
        } else {
            part.div_ceil(2)
        };
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_matter_is_left_out() {
        let needs = |wanted: &'static [usize]| {
            move |kept: &[usize]| wanted.iter().all(|i| kept.contains(i))
        };
        assert_eq!(fewest(1000, 100, needs(&[3, 700])), [3, 700]);
        assert!(fewest(1, 100, needs(&[])).is_empty());
        assert!(fewest(0, 100, needs(&[])).is_empty());
        let few_attempts = fewest(1000, 5, needs(&[3, 700]));
        assert!(needs(&[3, 700])(&few_attempts) && few_attempts.len() < 1000);
    }
}
