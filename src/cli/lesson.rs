//! `bspscope lesson`: lists, checks and prints lessons.

use super::args::{LessonArgs, LessonCommand};
use super::outcome::Outcome;
use super::{bar, output};
use crate::lesson::{Answer, LESSONS, Lesson, Measurer, Step, Style, check};
use anyhow::Result;

pub fn run(args: &LessonArgs) -> Result<Outcome> {
    match &args.command {
        LessonCommand::List => list(),
        LessonCommand::Check { lessons } => check_all(lessons),
        LessonCommand::Show { lesson } => show(lesson),
    }
}

fn list() -> Result<Outcome> {
    output::write_to(None, |out| {
        for known in LESSONS {
            let lesson = known.read();
            let steps = lesson.steps.len();
            writeln!(out, "{}: {} ({steps} steps)", known.name, lesson.title)?;
            writeln!(out, "    {}", lesson.about)?;
        }
        Ok(())
    })?;
    Ok(Outcome::Done)
}

fn check_all(names: &[String]) -> Result<Outcome> {
    let lessons = if names.is_empty() {
        LESSONS.iter().map(|known| known.read()).collect()
    } else {
        let opened = names.iter().map(|name| Lesson::open(name));
        opened.collect::<Result<Vec<_>, _>>()?
    };
    let mut all_hold = true;
    for lesson in &lessons {
        let wrong = bar::with_bar(&format!("{}: checking", lesson.name), |progress| {
            check(lesson, progress)
        })?;
        all_hold &= wrong.is_empty();
        output::write_to(None, |out| {
            if wrong.is_empty() {
                let conditions: usize = lesson.steps.iter().map(|s| s.expectations.len()).sum();
                let steps = lesson.steps.len();
                writeln!(
                    out,
                    "{}: {steps} steps, {conditions} of {conditions} conditions hold",
                    lesson.name
                )?;
            }
            wrong.iter().try_for_each(|wrong| writeln!(out, "{wrong}"))
        })?;
    }
    Ok(match all_hold {
        true => Outcome::Done,
        false => Outcome::CheckFailed,
    })
}

fn show(name: &str) -> Result<Outcome> {
    let lesson = Lesson::open(name)?;
    let mut measurer = Measurer::default();
    let mut steps = Vec::new();
    for (i, step) in lesson.steps.iter().enumerate() {
        let stage = format!("{}: step {} of {}", lesson.name, i + 1, lesson.steps.len());
        let figures = bar::with_bar(&stage, |progress| measurer.measure(&lesson, step, progress))?;
        steps.push((step, figures));
    }
    output::write_to(None, |out| {
        writeln!(out, "# {}\n\n{}", lesson.title, lesson.about)?;
        for (i, (step, figures)) in steps.iter().enumerate() {
            writeln!(out, "\n## {}. {}\n", i + 1, step.title)?;
            writeln!(out, "{}", step.before.fill(Some(figures)).trim())?;
            if let Some(answer) = answer(step, figures) {
                writeln!(
                    out,
                    "\n{answer}\n\n{}",
                    step.after.fill(Some(figures)).trim()
                )?;
            }
        }
        Ok(())
    })?;
    Ok(Outcome::Done)
}

/// Returns the question of a step with its answer; `None` if nothing is asked.
fn answer(step: &Step, figures: &crate::lesson::Figures) -> Option<String> {
    let question = step.question.as_ref()?;
    let answer = match &question.answer {
        Answer::Number { formula, within } => {
            let truth = formula.write(formula.value(figures), Style::Plain);
            format!("{truth} (right within {within})")
        }
        Answer::Choice(choices) => {
            let right = question.answer.right_choices(figures);
            let right: Vec<_> = right.iter().map(|&i| choices[i].text.as_str()).collect();
            right.join("; ")
        }
    };
    Some(format!("**{}** {answer}", question.ask))
}
