//! A step's question: the prediction, and what became of it.

use super::asked::Asked;
use super::running::Running;
use super::scale;
use crate::gui::action::tip;
use crate::gui::icons;
use crate::gui::theme;
use crate::lesson::{Answer, Choice, Grade, Question, Verdict};
use egui::{Button, Key, Label, RichText, vec2};

/// Shows the field or the choices of a prediction, and the button that checks it.
pub fn prediction(
    running: &mut Running,
    question: &Question,
    ui: &mut egui::Ui,
    asked: &mut Option<Asked>,
) {
    let is_new = std::mem::take(&mut running.is_new);
    match &question.answer {
        Answer::Number { within, .. } => {
            ui.horizontal(|ui| {
                let about = format!("A number. Close is no further off than {within}.");
                let field = egui::TextEdit::singleline(&mut running.now_mut().typed)
                    .hint_text("a number")
                    .font(theme::named(theme::LESSON))
                    .desired_width(112.0);
                let field = ui.add(field).accessible_name("Your prediction");
                if is_new {
                    field.request_focus();
                }
                if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
                    *asked = Some(Asked::Check);
                }
                field.on_hover_text(about);
                check(running, ui, asked);
            });
        }
        Answer::Choice(choices) => {
            for (place, choice) in choices.iter().enumerate() {
                let chosen = running.now().chosen == Some(place);
                let radio = ui.radio(chosen, theme::lesson(&choice.text));
                if is_new && place == 0 {
                    radio.request_focus();
                }
                if radio.clicked() {
                    running.now_mut().chosen = Some(place);
                }
            }
            ui.horizontal(|ui| check(running, ui, asked));
        }
    }
}

/// The button that checks the prediction, and why it does not yet.
fn check(running: &Running, ui: &mut egui::Ui, asked: &mut Option<Asked>) {
    let ready = running.now().figures.is_some();
    let predicted = running.prediction().is_some();
    let t = theme::tokens(ui);
    let text = RichText::new("Check").color(t.on_accent);
    let button = Button::new(text).fill(t.accent).min_size(vec2(96.0, 32.0));
    let button = ui.add_enabled(ready && predicted, button);
    let about = match (predicted, ready) {
        (false, _) => "Make your prediction first.",
        (true, false) => "Measuring is still in progress.",
        (true, true) => "Compare your prediction with what was measured.",
    };
    let tip = tip(about, "lesson.check");
    let button = button.on_hover_text(&tip).on_disabled_hover_text(&tip);
    if button.clicked() {
        *asked = Some(Asked::Check);
    }
    if !ready {
        ui.label(theme::hint("measuring…"));
    }
}

/// Shows what became of the prediction.
pub fn outcome(running: &Running, question: &Question, verdict: &Verdict, ui: &mut egui::Ui) {
    let t = theme::tokens(ui);
    let (icon, color) = match verdict.grade {
        Grade::Exact | Grade::Close => (icons::CHECK, t.better),
        Grade::Off => (icons::CLOSE, t.worse),
    };
    if let Some(scale) = &verdict.scale {
        scale::show(ui, scale, verdict);
    }
    if let Answer::Choice(choices) = &question.answer {
        chosen(running, choices, verdict, ui);
    }
    ui.horizontal_top(|ui| {
        ui.label(RichText::new(icon).size(18.0).color(color));
        let text = theme::lesson(verdict.text()).family(theme::semibold());
        ui.add(Label::new(text.color(color)).wrap());
    });
}

/// The choices as they were: the right one, and the one that was chosen.
fn chosen(running: &Running, choices: &[Choice], verdict: &Verdict, ui: &mut egui::Ui) {
    let t = theme::tokens(ui);
    for (place, choice) in choices.iter().enumerate() {
        let is_right = choice.text == verdict.truth;
        let was_chosen = running.now().chosen == Some(place);
        ui.horizontal_top(|ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(20.0, 26.0), egui::Sense::hover());
            let mark = match (is_right, was_chosen) {
                (true, _) => Some((icons::CHECK, t.better)),
                (false, true) => Some((icons::CLOSE, t.worse)),
                (false, false) => None,
            };
            if let Some((icon, color)) = mark {
                let font = egui::FontId::proportional(18.0);
                let middle = egui::Align2::CENTER_CENTER;
                ui.painter().text(rect.center(), middle, icon, font, color);
            }
            let text = theme::lesson(&choice.text);
            let text = if is_right { text } else { text.color(t.hint) };
            ui.add(Label::new(text).wrap());
        });
    }
}
