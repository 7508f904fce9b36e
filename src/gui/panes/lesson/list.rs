//! The list of lessons, as cards, and the way to a lesson of one's own.

use super::LessonPane;
use crate::gui::edits::Edits;
use crate::gui::theme;
use crate::lesson::{LESSONS, Lesson};
use egui::{Key, Label, Sense, UiBuilder};

pub fn show(pane: &mut LessonPane, ui: &mut egui::Ui, edits: &mut Edits) {
    egui::ScrollArea::vertical()
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.label(theme::heading("Lessons"));
            ui.add(
                Label::new(
                    "Short guided tours. Each step asks for a prediction, then measures. Leaving a \
                     lesson brings back what was there before.",
                )
                .wrap(),
            );
            ui.add_space(4.0);
            for (place, known) in LESSONS.iter().enumerate() {
                if card(ui, &known.read()) {
                    super::start(place, edits);
                }
                ui.add_space(4.0);
            }
            own(pane, ui, edits);
        });
}

/// A card that starts a lesson; whether it was clicked.
fn card(ui: &mut egui::Ui, lesson: &Lesson) -> bool {
    let builder = UiBuilder::new().id_salt(&lesson.name).sense(Sense::click());
    let name = format!("Lesson: {}", lesson.title);
    let card = ui.scope_builder(builder, |ui| {
        let response = ui.response();
        let visuals = ui.style().interact(&response);
        let mut frame = theme::card(ui);
        if response.hovered() || response.has_focus() {
            frame = frame.fill(visuals.bg_fill).stroke(visuals.bg_stroke);
        }
        // A click on the text is one on the card.
        ui.style_mut().interaction.selectable_labels = false;
        frame.show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.add(Label::new(theme::strong(&lesson.title)).wrap());
            ui.add(Label::new(&lesson.about).wrap());
            ui.label(theme::hint(format!("{} steps", lesson.steps.len())));
        });
    });
    let response = card.response;
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
    response.clicked()
}

/// A lesson of one's own, by its path.
fn own(pane: &mut LessonPane, ui: &mut egui::Ui, edits: &mut Edits) {
    let field = egui::TextEdit::singleline(&mut pane.path)
        .hint_text("Your own lesson: path of its file, Enter")
        .desired_width(f32::INFINITY);
    let field = ui.add(field).accessible_name("Path of a lesson");
    let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
    field.on_hover_text(
        "A lesson is a text file; assets/lessons/README.md explains how to write one. It can be dropped \
         onto the window, too.",
    );
    let path = pane.path.trim().to_owned();
    if entered && !path.is_empty() {
        pane.open(&path, edits);
    }
    if let Some(failure) = &pane.failure {
        let t = theme::tokens(ui);
        let text = egui::RichText::new(format!("Not opened: {failure}")).color(t.error);
        ui.add(Label::new(text).wrap());
    }
}
