//! Measures the steps of a lesson and checks their conditions.

use super::content::{Lesson, LessonError, Step};
use super::figures::{Difference, Figures, SideFigures};
use super::question::Answer;
use crate::measure::measure;
use crate::progress::{Cancelled, Progress};
use crate::scene::{Scene, SceneRequest, load};
use crate::setup::Setup;
use crate::trace::{Picture, record_pixel};

/// Measures steps; caches the scene of the previous one.
#[derive(Default)]
pub struct Measurer {
    scene: Option<(SceneRequest, Scene)>,
}

impl Measurer {
    /// Measures all figures of a step.
    ///
    /// # Errors
    /// What failed, such as loading the scene, with file and line; or cancellation.
    pub fn measure(
        &mut self,
        lesson: &Lesson,
        step: &Step,
        progress: &Progress,
    ) -> Result<Figures, LessonError> {
        let wrong = |reason: String| lesson.error(step.scene_line, reason);
        let (a, of_a) = self.side(step, &step.subject.a, progress).map_err(wrong)?;
        let b = match &step.subject.b {
            Some(b) => Some(self.side(step, b, progress).map_err(wrong)?),
            None => None,
        };
        Ok(Figures {
            difference: b.as_ref().and_then(|(_, b)| Difference::between(&of_a, b)),
            a,
            b: b.map(|(figures, _)| figures),
        })
    }

    fn side(
        &mut self,
        step: &Step,
        setup: &Setup,
        progress: &Progress,
    ) -> Result<(SideFigures, Picture), String> {
        let wanted = setup.scene.clone();
        let kept = self.scene.take().filter(|(known, _)| *known == wanted);
        let (_, scene) = self.scene.insert(match kept {
            Some(kept) => kept,
            None => {
                let scene = load(&wanted, progress).map_err(|error| error.to_string())?;
                (wanted, scene)
            }
        });
        let Setup { build, render, .. } = setup;
        let measured =
            measure(scene, build, render, progress).map_err(|error| error.to_string())?;
        let record = step
            .subject
            .pixel
            .map(|pixel| record_pixel(scene, &measured.tree, render, pixel));
        let record = record.transpose().map_err(|error| error.to_string())?;
        let figures = SideFigures {
            measurement: measured.measurement,
            pixel: record.map(|record| record.tallies()),
        };
        Ok((figures, measured.picture))
    }
}

/// Measures every step and returns the conditions that do not hold.
///
/// # Errors
/// Cancellation.
pub fn check(lesson: &Lesson, progress: &Progress) -> Result<Vec<LessonError>, Cancelled> {
    let mut measurer = Measurer::default();
    let mut wrong = Vec::new();
    for (i, step) in lesson.steps.iter().enumerate() {
        progress.set(i as f64 / lesson.steps.len() as f64);
        match measurer.measure(lesson, step, &Progress::new()) {
            Ok(figures) => wrong.extend(check_step(lesson, step, &figures)),
            Err(error) => wrong.push(error),
        }
        progress.check()?;
    }
    Ok(wrong)
}

/// Returns the conditions of a step that do not hold with these figures.
pub fn check_step(lesson: &Lesson, step: &Step, figures: &Figures) -> Vec<LessonError> {
    let mut wrong = Vec::new();
    for expected in &step.expectations {
        let condition = &expected.condition;
        if condition.holds(figures) != Some(true) {
            let [left, right] = condition.sides().map(|side| {
                let value = side.value(figures);
                side.write(value, super::formula::Style::Plain)
            });
            let reason = format!(
                "expected {}, found {left} on the left and {right} on the right",
                expected.text
            );
            wrong.push(lesson.error(expected.line, reason));
        }
    }
    for value in step.before.placeholders().chain(step.after.placeholders()) {
        if value.formula.value(figures).is_none() {
            let reason = format!("{{{}}} has no value in this step", value.text);
            wrong.push(lesson.error(value.line, reason));
        }
    }
    if let Some(question) = &step.question {
        let reason = match &question.answer {
            Answer::Number { formula, .. } => match formula.value(figures) {
                Some(_) => None,
                None => Some("the answer has no value in this step".to_owned()),
            },
            Answer::Choice(_) => match question.answer.right_choices(figures).len() {
                1 => None,
                right => Some(format!("{right} choices are right; exactly one must be")),
            },
        };
        wrong.extend(reason.map(|reason| lesson.error(question.line, reason)));
    }
    wrong
}
