//! The list of lessons, as cards, and the way to a lesson of one's own.

use super::asked::Asked;
use crate::gui::theme;
use crate::lesson::{LESSONS, Lesson};
use egui::{Key, Label, Sense, UiBuilder};

/// The list, as it is while no lesson runs.
#[derive(Default)]
pub struct List {
    /// What is typed as the path of a lesson.
    path: String,
    /// Why a lesson could not be opened.
    pub failure: Option<String>,
}

impl List {
    /// Shows the list; returns what was asked for.
    pub fn show(&mut self, ui: &mut egui::Ui) -> Option<Asked> {
        let mut asked = None;
        egui::ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.label(theme::heading("Lessons"));
                let about = "Short guided tours. Each step asks for a prediction, then measures. \
                             Leaving a lesson brings back what was there before.";
                ui.add(Label::new(about).wrap());
                ui.add_space(4.0);
                for (place, known) in LESSONS.iter().enumerate() {
                    if card(ui, &known.read()) {
                        asked = Some(Asked::Begin(place));
                    }
                    ui.add_space(4.0);
                }
                if let Some(path) = self.own(ui) {
                    asked = Some(Asked::Open(path));
                }
            });
        asked
    }

    /// The field for a lesson of one's own; returns the path that was entered.
    fn own(&mut self, ui: &mut egui::Ui) -> Option<String> {
        let field = egui::TextEdit::singleline(&mut self.path)
            .hint_text("Your own lesson: path of its file, Enter")
            .desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name("Path of a lesson");
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        field.on_hover_text(
            "A lesson is a text file; assets/lessons/README.md explains how to write one. It can be \
             dropped onto the window, too.",
        );
        if let Some(failure) = &self.failure {
            let t = theme::tokens(ui);
            let text = egui::RichText::new(format!("Not opened: {failure}")).color(t.error);
            ui.add(Label::new(text).wrap());
        }
        let path = self.path.trim();
        (entered && !path.is_empty()).then(|| path.to_owned())
    }
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
