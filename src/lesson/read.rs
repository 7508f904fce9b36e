//! Parses a lesson: TOML between lines `+++`, then one step per heading `# `, with a block of TOML
//! settings, text, and after a line `---` the text with the answer.

use super::content::{Expectation, Lesson, LessonError, Step};
use super::figures::Side;
use super::formula::{Condition, Formula};
use super::prose::Prose;
use super::question::{Answer, Choice, Question};
use super::subject::{Look, Named, Subject};
use super::tolerance::Tolerance;
use crate::geometry::Vec3;
use crate::measure::heat::heatmap;
use crate::scene::{Camera, CameraOverride, Cylinders, SceneRequest, SceneSource};
use crate::setup::{Edits, Setup};
use crate::structure::BuildSettings;
use crate::trace::RenderSettings;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// The line before and after the file's header.
const HEAD: &str = "+++";

/// The line between the text before and after the prediction.
const REVEAL: &str = "---";

/// The line of an error, counted from 1, and the reason.
type Wrong = (usize, String);

/// Parses a lesson. Paths of scenes are relative to `folder`, if there is one.
pub fn read(text: &str, name: &str, folder: Option<&Path>) -> Result<Lesson, LessonError> {
    lesson(text, name, folder).map_err(|(line, reason)| LessonError {
        file: name.to_owned(),
        line,
        reason,
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawHead {
    title: String,
    about: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct RawStep {
    scene: Spanned<String>,
    a: Spanned<String>,
    b: Option<Spanned<String>>,
    #[serde(default = "usual_size")]
    size: [u32; 2],
    camera: Option<Spanned<RawCamera>>,
    pixel: Option<Spanned<[u32; 2]>>,
    heatmap: Option<Spanned<String>>,
    front: Option<Spanned<String>>,
    view: Option<Spanned<String>>,
    #[serde(default)]
    panes: Vec<Spanned<String>>,
    #[serde(default)]
    panels: Vec<Spanned<String>>,
    question: Option<Spanned<String>>,
    number: Option<Spanned<String>>,
    within: Option<Spanned<String>>,
    compare: Option<Spanned<[String; 2]>>,
    same_within: Option<Spanned<String>>,
    choices: Option<Spanned<Vec<[String; 2]>>>,
    #[serde(default)]
    expect: Vec<Spanned<String>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCamera {
    from: [f64; 3],
    at: [f64; 3],
    #[serde(default = "usual_up")]
    up: [f64; 3],
    #[serde(default = "usual_angle")]
    angle: f64,
}

/// Small enough that a step's figures are there in a moment.
fn usual_size() -> [u32; 2] {
    [128, 128]
}

fn usual_up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn usual_angle() -> f64 {
    45.0
}

fn lesson(text: &str, name: &str, folder: Option<&Path>) -> Result<Lesson, Wrong> {
    let lines: Vec<&str> = text.lines().collect();
    if lines.first().map(|line| line.trim_end()) != Some(HEAD) {
        return Err((1, format!("expected a line {HEAD}")));
    }
    let end = lines
        .iter()
        .skip(1)
        .position(|line| line.trim_end() == HEAD);
    let end = end.ok_or_else(|| (1, format!("the second line {HEAD} is missing")))? + 1;
    let head: RawHead = Block::new(&lines, 1, end).read()?;
    let mut starts = headings(&lines, end + 1);
    let first = starts.first().copied().unwrap_or(lines.len());
    if let Some(stray) = (end + 1..first).find(|&i| !lines[i].trim().is_empty()) {
        return Err((
            stray + 1,
            "expected a heading: '# ' and the title of a step".into(),
        ));
    }
    if starts.is_empty() {
        return Err((end + 1, "the lesson has no step (a heading '# ')".into()));
    }
    starts.push(lines.len());
    let steps = starts
        .windows(2)
        .map(|part| step(&lines, part[0], part[1], folder))
        .collect::<Result<_, _>>()?;
    Ok(Lesson {
        name: name.to_owned(),
        title: head.title,
        about: head.about,
        steps,
    })
}

/// Returns the indices of the lines that begin with `# `, except within fenced blocks.
fn headings(lines: &[&str], from: usize) -> Vec<usize> {
    let mut fenced = false;
    let mut found = Vec::new();
    for (i, line) in lines.iter().enumerate().skip(from) {
        fenced ^= line.trim_start().starts_with("```");
        if !fenced && line.starts_with("# ") {
            found.push(i);
        }
    }
    found
}

/// A block of TOML in the file.
struct Block {
    /// Index of its first line.
    start: usize,
    text: String,
}

impl Block {
    /// Creates a block of the lines from `start` to before `end`.
    fn new(lines: &[&str], start: usize, end: usize) -> Self {
        Block {
            start,
            text: lines[start..end].join("\n"),
        }
    }

    fn read<T: DeserializeOwned>(&self) -> Result<T, Wrong> {
        toml::from_str(&self.text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            (self.line(at), error.message().to_owned())
        })
    }

    /// Returns the line number of a byte offset in the block.
    fn line(&self, at: usize) -> usize {
        let before = &self.text.as_bytes()[..at.min(self.text.len())];
        self.start + 1 + before.iter().filter(|&&byte| byte == b'\n').count()
    }

    fn line_of<T>(&self, value: &Spanned<T>) -> usize {
        self.line(value.span().start)
    }

    /// Applies a function to a value and adds the value's line to an error.
    fn with<T, R>(
        &self,
        value: &Spanned<T>,
        what: impl FnOnce(&T) -> Result<R, String>,
    ) -> Result<R, Wrong> {
        what(value.get_ref()).map_err(|reason| (self.line_of(value), reason))
    }

    fn named(&self, names: &[Spanned<String>]) -> Vec<Named> {
        let name = |name: &Spanned<String>| Named {
            line: self.line_of(name),
            name: name.get_ref().clone(),
        };
        names.iter().map(name).collect()
    }
}

/// Parses the step whose heading is line index `start` and which ends before `end`.
fn step(lines: &[&str], start: usize, end: usize, folder: Option<&Path>) -> Result<Step, Wrong> {
    let opening = (start + 1..end).find(|&i| !lines[i].trim().is_empty());
    let opening = opening.filter(|&i| lines[i].trim_end() == "```toml");
    let opening = opening.ok_or_else(|| {
        let reason = "expected a block ```toml after the heading";
        (start + 1, reason.to_owned())
    })?;
    let closing = (opening + 1..end).find(|&i| lines[i].trim_end() == "```");
    let closing =
        closing.ok_or_else(|| (opening + 1, "the block is not closed by ```".to_owned()))?;
    let block = Block::new(lines, opening + 1, closing);
    let raw: RawStep = block.read()?;

    let divider = (closing + 1..end).find(|&i| lines[i].trim_end() == REVEAL);
    let prose = |from: usize, to: usize| Prose::parse(&lines[from..to].join("\n"), from + 1);
    let before = prose(closing + 1, divider.unwrap_or(end))?;
    let after = divider.map_or(Ok(Prose::default()), |line| prose(line + 1, end))?;
    let step = Step {
        line: start + 1,
        title: lines[start][2..].trim().to_owned(),
        scene_line: block.line_of(&raw.scene),
        subject: subject(&block, &raw, folder)?,
        question: question(&block, &raw)?,
        expectations: expectations(&block, &raw)?,
        before,
        after,
    };
    step.check(divider.map(|line| line + 1))?;
    Ok(step)
}

fn subject(block: &Block, raw: &RawStep, folder: Option<&Path>) -> Result<Subject, Wrong> {
    let source = match SceneSource::parse(raw.scene.get_ref()) {
        SceneSource::File(path) if path.is_relative() => {
            SceneSource::File(folder.map_or_else(PathBuf::new, Path::to_owned).join(path))
        }
        source => source,
    };
    let camera = raw.camera.as_ref().map(|camera| {
        block.with(camera, |raw_camera| {
            let camera = Camera {
                from: Vec3::from(raw_camera.from),
                at: Vec3::from(raw_camera.at),
                up: Vec3::from(raw_camera.up),
                angle: raw_camera.angle,
                near: 1.0,
                resolution: raw.size,
            };
            camera.frame().map_err(|error| error.to_string())?;
            Ok(CameraOverride::from(camera))
        })
    });
    let base = Setup {
        scene: SceneRequest {
            source,
            cylinders: Cylinders::Exact,
        },
        build: BuildSettings::default(),
        render: RenderSettings {
            width: raw.size[0],
            height: raw.size[1],
            camera: camera.transpose()?.unwrap_or_default(),
            ..RenderSettings::default()
        },
    };
    let side = |text: &String| Edits::parse(text)?.apply(&base);
    let pixel = raw.pixel.as_ref().map(|pixel| {
        block.with(pixel, |&[x, y]| match x < raw.size[0] && y < raw.size[1] {
            true => Ok([x, y]),
            false => Err(format!("pixel [{x}, {y}] is outside the picture")),
        })
    });
    let symbol = raw.heatmap.as_ref().map(|name| {
        block.with(name, |name| {
            let found = heatmap(name).map(|heatmap| heatmap.symbol);
            found.ok_or_else(|| format!("no heatmap is called '{name}'"))
        })
    });
    let front = raw.front.as_ref().map(|front| {
        block.with(front, |front| match front.as_str() {
            "a" => Ok(Side::A),
            "b" if raw.b.is_some() => Ok(Side::B),
            "b" => Err("there is no tree b in this step".to_owned()),
            _ => Err(format!("expected 'a' or 'b', found '{front}'")),
        })
    });
    Ok(Subject {
        a: block.with(&raw.a, side)?,
        b: raw.b.as_ref().map(|b| block.with(b, side)).transpose()?,
        pixel: pixel.transpose()?,
        look: Look {
            heatmap: symbol.transpose()?,
            front: front.transpose()?.unwrap_or_default(),
            view: block.named(raw.view.as_slice()).pop(),
            panes: block.named(&raw.panes),
            panels: block.named(&raw.panels),
        },
    })
}

fn question(block: &Block, raw: &RawStep) -> Result<Option<Question>, Wrong> {
    let Some(ask) = &raw.question else {
        let stray = [&raw.number, &raw.within, &raw.same_within];
        let stray = stray.into_iter().flatten().map(|v| block.line_of(v));
        let stray = stray
            .chain(raw.compare.iter().map(|v| block.line_of(v)))
            .chain(raw.choices.iter().map(|v| block.line_of(v)));
        return match stray.min() {
            Some(line) => Err((line, "this key needs 'question'".into())),
            None => Ok(None),
        };
    };
    let answer = match (&raw.number, &raw.compare, &raw.choices) {
        (Some(number), None, None) => {
            let within = raw.within.as_ref().ok_or_else(|| {
                let reason = "'number' needs 'within': how far off a prediction may be";
                (block.line_of(number), reason.to_owned())
            })?;
            Answer::Number {
                formula: block.with(number, |text| Formula::parse(text))?,
                within: block.with(within, |text| Tolerance::parse(text))?,
            }
        }
        (None, Some(compare), None) => {
            let same = raw.same_within.as_ref().map(|text| {
                block.with(text, |text| match Tolerance::parse(text)? {
                    Tolerance::Relative(share) => Ok(share),
                    Tolerance::Absolute(_) => Err(format!("expected '5 %', found '{text}'")),
                })
            });
            let same = same.transpose()?.unwrap_or(0.0);
            block.with(compare, |[first, second]| {
                let (first, second) = (Formula::parse(first)?, Formula::parse(second)?);
                Ok(Answer::comparison(&first, &second, same))
            })?
        }
        (None, None, Some(choices)) => block.with(choices, |choices| {
            let choice = |[text, when]: &[String; 2]| {
                let when = when.split(" and ").map(|w| untimed(Condition::parse(w)?));
                Ok(Choice {
                    text: text.clone(),
                    when: when.collect::<Result<_, String>>()?,
                })
            };
            let choices: Vec<_> = choices.iter().map(choice).collect::<Result<_, String>>()?;
            match choices.len() {
                0 | 1 => Err("a question needs at least two choices".to_owned()),
                _ => Ok(Answer::Choice(choices)),
            }
        })?,
        _ => {
            let reason = "a question needs exactly one of 'number', 'compare' and 'choices'";
            return Err((block.line_of(ask), reason.into()));
        }
    };
    Ok(Some(Question {
        line: block.line_of(ask),
        ask: ask.get_ref().clone(),
        answer,
    }))
}

fn expectations(block: &Block, raw: &RawStep) -> Result<Vec<Expectation>, Wrong> {
    let read = |text: &Spanned<String>| {
        Ok(Expectation {
            line: block.line_of(text),
            text: text.get_ref().clone(),
            condition: block.with(text, |text| untimed(Condition::parse(text)?))?,
        })
    };
    raw.expect.iter().map(read).collect()
}

/// Rejects a condition on a time, because it would not hold on every machine.
fn untimed(condition: Condition) -> Result<Condition, String> {
    let [left, right] = condition.sides();
    if left.is_timed() || right.is_timed() {
        return Err("conditions cannot use times, because these differ between runs".into());
    }
    Ok(condition)
}

impl Step {
    /// Checks the consistency of a step; `divider` is the line with [`REVEAL`].
    fn check(&self, divider: Option<usize>) -> Result<(), Wrong> {
        let Some(question) = &self.question else {
            return match divider {
                Some(line) => Err((line, format!("'{REVEAL}' needs 'question' in the step"))),
                None => self.check_names(),
            };
        };
        if divider.is_none() || self.after.is_empty() {
            let reason = format!("a question needs text with the answer after a line '{REVEAL}'");
            return Err((question.line, reason));
        }
        if self.before.is_empty() {
            return Err((self.line, "a step needs text before its question".into()));
        }
        self.check_names()
    }

    /// Checks that every figure is available and that the text before the prediction does not give
    /// the answer away. It may contain only specified figures and, in a step with two trees,
    /// figures of A.
    fn check_names(&self) -> Result<(), Wrong> {
        let answer = self.question.iter().flat_map(|question| {
            let formulas = question.answer.formulas().into_iter();
            formulas
                .flat_map(|formula| formula.names())
                .map(|name| (question.line, name))
        });
        let expected = self.expectations.iter().flat_map(|expectation| {
            let sides = expectation.condition.sides().into_iter();
            sides
                .flat_map(|side| side.names())
                .map(|name| (expectation.line, name))
        });
        let shown = self.before.names().chain(self.after.names());
        for (line, name) in shown.chain(answer).chain(expected) {
            if name.is_of_pixel() && self.subject.pixel.is_none() {
                return Err((line, format!("{name:?}: the step has no 'pixel'")));
            }
            if name.side() != Some(Side::A) && self.subject.b.is_none() {
                return Err((line, format!("{name:?}: the step has no tree 'b'")));
            }
        }
        let known = |side| self.subject.b.is_some() && side == Some(Side::A);
        let shown_before = self.before.names();
        match shown_before
            .into_iter()
            .find(|(_, name)| !name.is_given() && !known(name.side()))
        {
            Some((line, name)) => Err((
                line,
                format!(
                    "{name:?} gives the answer away before the prediction; move it below '{REVEAL}'"
                ),
            )),
            None => Ok(()),
        }
    }
}
