//! The step that is taken: text, question, outcome, and the way through the lesson.

use super::ask;
use super::asked::Asked;
use super::running::Running;
use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::icons;
use crate::gui::theme;
use crate::gui::widgets::markdown;
use crate::lesson::LESSONS;
use egui::{Align, Button, Label, Layout, ScrollArea, vec2};

/// Shows the step that is on view; returns what was asked for.
pub fn show(running: &mut Running, ui: &mut egui::Ui, doc: &Document) -> Option<Asked> {
    let mut asked = None;
    contents(running, ui, doc, &mut asked);
    asked
}

fn contents(running: &mut Running, ui: &mut egui::Ui, doc: &Document, asked: &mut Option<Asked>) {
    head(running, ui, asked);
    let frame = egui::Frame::new().inner_margin(egui::Margin::symmetric(0, 8));
    egui::Panel::bottom("lesson's way")
        .frame(frame)
        .show(ui, |ui| way(running, ui, asked));
    ScrollArea::vertical()
        .id_salt(("lesson", running.at))
        .auto_shrink(false)
        .show(ui, |ui| {
            if running.is_changed(doc) {
                changed(ui, asked);
            }
            let figures = running.now().figures.clone();
            ui.scope(|ui| markdown::show(ui, &running.step().before.fill(figures.as_ref())));
            let Some(question) = running.step().question.clone() else {
                return;
            };
            ui.add_space(12.0);
            let ask = theme::lesson(&question.ask).family(theme::semibold());
            ui.add(Label::new(ask).wrap());
            ui.add_space(8.0);
            match running.now().verdict.clone() {
                None => ask::prediction(running, &question, ui, asked),
                Some(verdict) => {
                    ask::outcome(running, &question, &verdict, ui);
                    ui.add_space(12.0);
                    let after = running.step().after.fill(figures.as_ref());
                    ui.scope(|ui| markdown::show(ui, &after));
                }
            }
        });
}

/// Says that other settings than the step's are on view.
fn changed(ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    theme::card(ui).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.label("You changed the settings of this step.");
        let set = ui.button("Restore the step's settings");
        let about = "Scene, trees and picture as the step has them.";
        if set.on_hover_text(about).clicked() {
            *asked = Some(Asked::SetUp);
        }
    });
    ui.add_space(8.0);
}

/// How far the lesson is, and the title of the step.
fn head(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    let (at, of) = (running.at + 1, running.lesson.steps.len());
    ui.horizontal(|ui| {
        ui.label(format!("{at} of {of}"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let leave = ui.button("Exit lesson");
            let about = tip(
                "End the lesson; everything is as it was before it.",
                "lesson.open",
            );
            if leave.on_hover_text(about).clicked() {
                *asked = Some(Asked::Leave);
            }
            let title = Label::new(theme::hint(&running.lesson.title)).truncate();
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(title));
        });
    });
    let (bar, _) = ui.allocate_exact_size(vec2(ui.available_width(), 4.0), egui::Sense::hover());
    let t = theme::tokens(ui);
    let mut done = bar;
    done.set_width(bar.width() * at as f32 / of as f32);
    ui.painter().rect_filled(bar, 2.0, t.divider);
    ui.painter().rect_filled(done, 2.0, t.accent);
    ui.add_space(8.0);
    ui.add(Label::new(theme::heading(&running.step().title)).wrap());
    ui.add_space(8.0);
}

/// Back and next, and at the end what became of the predictions.
fn way(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    let is_end = running.at + 1 == running.lesson.steps.len() && !running.asks();
    if is_end {
        end(running, ui, asked);
    }
    ui.horizontal(|ui| {
        let size = vec2(104.0, 32.0);
        let back = Button::new(format!("{} Back", icons::CARET_LEFT)).min_size(size);
        let back = ui.add_enabled(running.at > 0, back);
        let back = back.on_hover_text(tip("Go to the previous step.", "lesson.back"));
        if back.accessible_name("Back").clicked() {
            *asked = Some(Asked::Back);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let next = Button::new(format!("Next {}", icons::CARET_RIGHT)).min_size(size);
            let next = ui.add_enabled(running.may_go_on(), next);
            let about = tip("Go to the next step.", "lesson.next");
            let next = next
                .on_hover_text(&about)
                .on_disabled_hover_text(format!("{about}\nCheck your prediction first."));
            if next.accessible_name("Next").clicked() {
                *asked = Some(Asked::Next);
            }
        });
    });
}

/// The score, and the way to the next lesson.
fn end(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    let (right, of) = running.score();
    ui.label(format!("The end: {right} of {of} predictions were right."));
    let all: Vec<_> = LESSONS.iter().map(|known| known.read()).collect();
    let here = all.iter().position(|l| l.name == running.lesson.name);
    if let Some(next) = here.map(|place| place + 1)
        && let Some(lesson) = all.get(next)
    {
        let name = format!("Next lesson: {}", lesson.title);
        if ui.add(Button::new(name).wrap()).clicked() {
            *asked = Some(Asked::Begin(next));
        }
    }
    ui.add_space(4.0);
}
