//! What the panel shows: the list of lessons, or the step that is taken.

use super::LessonPane;
use super::running::Running;
use crate::gui::action::tip;
use crate::gui::pane::Cx;
use crate::lesson::{Answer, LESSONS, Question};
use egui::{Key, RichText};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};

/// What was asked for in the panel.
#[derive(Clone, Copy)]
enum Asked {
    Back,
    Reveal,
    Next,
    SetUp,
    Leave,
    Begin(usize),
}

pub fn show(pane: &mut LessonPane, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
    let Some(running) = &mut pane.running else {
        list(pane, ui, cx);
        return;
    };
    let asked = step(running, &mut pane.markdown, ui, cx);
    match (asked, &mut pane.running) {
        (Some(Asked::Back), Some(running)) => running.back(cx),
        (Some(Asked::Reveal), Some(running)) => running.reveal(cx),
        (Some(Asked::Next), Some(running)) => running.next(cx),
        (Some(Asked::SetUp), Some(running)) => running.set_up(cx),
        (Some(Asked::Leave), _) => pane.leave(cx),
        (Some(Asked::Begin(place)), _) => {
            cx.doc.next_lesson = LESSONS.get(place).map(|known| known.read())
        }
        _ => {}
    }
}

/// All lessons, and a way to one's own.
fn list(pane: &mut LessonPane, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
    ui.heading("Lessons");
    egui::ScrollArea::vertical().show(ui, |ui| {
        ui.label(
            "Short guided tours. Each step asks for a prediction before it shows the figures. \
             Leaving a lesson brings back what was there before.",
        );
        for (place, known) in LESSONS.iter().enumerate() {
            ui.add_space(8.0);
            let lesson = known.read();
            if ui.button(RichText::new(&lesson.title).strong()).clicked() {
                cx.doc.next_lesson = LESSONS.get(place).map(|known| known.read());
            }
            let steps = lesson.steps.len();
            ui.add(egui::Label::new(format!("{} ({steps} steps)", lesson.about)).wrap());
        }
        ui.add_space(8.0);
        ui.separator();
        let field = egui::TextEdit::singleline(&mut pane.path)
            .hint_text("path of a lesson's file, Enter")
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path of a lesson");
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        field.on_hover_text(
            "A lesson of your own: a text file; assets/lessons/README.md tells how to write one. \
             It can be dropped onto the window, too.",
        );
        let path = pane.path.trim().to_owned();
        if entered && !path.is_empty() {
            pane.open(&path, cx.doc);
        }
        if let Some(failure) = &pane.failure {
            ui.add(egui::Label::new(format!("Not opened: {failure}")).wrap());
        }
    });
}

/// The step that is taken.
fn step(
    running: &mut Running,
    markdown: &mut CommonMarkCache,
    ui: &mut egui::Ui,
    cx: &Cx<'_>,
) -> Option<Asked> {
    let mut asked = None;
    head(running, ui, &mut asked);
    let below = egui::Panel::bottom("lesson's way").show_separator_line(true);
    below.show(ui, |ui| way(running, ui, &mut asked));
    egui::ScrollArea::vertical()
        .id_salt(("lesson", running.at))
        .auto_shrink(false)
        .show(ui, |ui| {
            if running.is_changed(cx.doc) {
                ui.horizontal_wrapped(|ui| {
                    ui.label("The settings are no longer the step's.");
                    if ui
                        .button("Set them again")
                        .on_hover_text("Scene, trees and picture as the step has them.")
                        .clicked()
                    {
                        asked = Some(Asked::SetUp);
                    }
                });
                ui.separator();
            }
            let figures = running.now().figures.clone();
            let mut text = |ui: &mut egui::Ui, prose: &crate::lesson::Prose| {
                CommonMarkViewer::new().show(ui, markdown, &prose.fill(figures.as_ref()));
            };
            text(ui, &running.step().before);
            let Some(question) = running.step().question.clone() else {
                return;
            };
            ui.separator();
            ui.add_space(4.0);
            ui.add(egui::Label::new(RichText::new(&question.ask).strong()).wrap());
            ui.add_space(4.0);
            if running.asks() {
                ask(running, &question, ui, &mut asked);
            } else if let Some(verdict) = &running.now().verdict {
                let word = match verdict.is_right() {
                    true => "Right",
                    false => "Not so",
                };
                let told = format!(
                    "{word}. You predicted: {}. It is: {}.",
                    verdict.predicted, verdict.truth
                );
                ui.add(egui::Label::new(told).wrap());
                ui.separator();
                text(ui, &running.step().after);
            }
        });
    asked
}

/// The title and how far the lesson is.
fn head(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    ui.horizontal(|ui| {
        ui.add(egui::Label::new(RichText::new(&running.lesson.title).weak()).truncate());
    });
    let (at, of) = (running.at + 1, running.lesson.steps.len());
    ui.horizontal(|ui| {
        let leave = ui.button("Leave the lesson");
        if leave
            .on_hover_text(tip(
                "End the lesson; all is as it was before it.",
                "lesson.open",
            ))
            .clicked()
        {
            *asked = Some(Asked::Leave);
        }
        ui.add(egui::ProgressBar::new(at as f32 / of as f32).text(format!("step {at} of {of}")));
    });
    ui.heading(&running.step().title);
}

/// The prediction, and the button that tells the answer.
fn ask(running: &mut Running, question: &Question, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    let is_new = std::mem::take(&mut running.is_new);
    match &question.answer {
        Answer::Number { within, .. } => {
            let about = format!("A number; right if it is no further off than {within}.");
            let field = egui::TextEdit::singleline(&mut running.now_mut().typed)
                .hint_text("a number")
                .desired_width(120.0);
            let field = ui.add(field).accessible_name("Your prediction");
            if is_new {
                field.request_focus();
            }
            if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
                *asked = Some(Asked::Reveal);
            }
            field.on_hover_text(about);
        }
        Answer::Choice(choices) => {
            for (place, choice) in choices.iter().enumerate() {
                let chosen = running.now().chosen == Some(place);
                let radio = ui.radio(chosen, &choice.text);
                if is_new && place == 0 {
                    radio.request_focus();
                }
                if radio.clicked() {
                    running.now_mut().chosen = Some(place);
                }
            }
        }
    }
    let (ready, predicted) = (
        running.now().figures.is_some(),
        running.prediction().is_some(),
    );
    ui.add_space(4.0);
    let reveal = ui.add_enabled(ready && predicted, egui::Button::new("Reveal"));
    let about = match (predicted, ready) {
        (false, _) => "Make your prediction first.",
        (true, false) => "Measuring goes on.",
        (true, true) => "Show the figures.",
    };
    let tip = tip(about, "lesson.check");
    if reveal
        .on_hover_text(&tip)
        .on_disabled_hover_text(&tip)
        .clicked()
    {
        *asked = Some(Asked::Reveal);
    }
    if !ready {
        ui.weak("measuring …");
    }
}

/// Back and on, and at the end what became of the predictions.
fn way(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    ui.add_space(4.0);
    let is_end = running.at + 1 == running.lesson.steps.len() && !running.asks();
    if is_end {
        let (right, of) = running.score();
        ui.label(format!("The end: {right} of {of} predictions were right."));
        let all: Vec<_> = LESSONS.iter().map(|known| known.read()).collect();
        let here = all.iter().position(|l| l.name == running.lesson.name);
        if let Some(next) = here.map(|place| place + 1)
            && let Some(lesson) = all.get(next)
            && ui
                .button(format!("Next lesson: {}", lesson.title))
                .clicked()
        {
            *asked = Some(Asked::Begin(next));
        }
    }
    ui.horizontal(|ui| {
        let back = ui.add_enabled(running.at > 0, egui::Button::new("Go back"));
        if back
            .on_hover_text(tip("The step before.", "lesson.back"))
            .clicked()
        {
            *asked = Some(Asked::Back);
        }
        let next = ui.add_enabled(running.may_go_on(), egui::Button::new("Go on"));
        let about = tip("The next step.", "lesson.next");
        if next
            .on_hover_text(&about)
            .on_disabled_hover_text(format!("{about}\nReveal this one first."))
            .clicked()
        {
            *asked = Some(Asked::Next);
        }
    });
    ui.add_space(4.0);
}
