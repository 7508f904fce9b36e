//! The row above two compared pictures: how they are shown, and what their keys do.

use crate::gui::action::tip;
use crate::gui::document::comparing::View;
use crate::gui::document::{Document, Fact};
use crate::gui::widgets::hidden::HIDDEN;
use crate::gui::widgets::symbol::grouped;

/// How far a key moves the wipe's line, of the picture's width.
const STEP: f32 = 0.05;

/// Shows the row; `picture` says that no heatmap is shown.
pub fn show(ui: &mut egui::Ui, doc: &mut Document, picture: bool) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for view in View::ALL {
            ui.selectable_value(&mut doc.comparing.view, view, view.name())
                .on_hover_text(tip(view.about(), "picture.next-view"));
        }
        match doc.comparing.view {
            View::Difference if picture => {
                let told = !doc.hides(&[Fact::Difference]);
                let verdict = told.then(|| doc.verdict(ui.ctx()));
                let text = match verdict.flatten() {
                    None if !told => HIDDEN.to_owned(),
                    None => "waits for both pictures".to_owned(),
                    Some(verdict) if verdict.pixels.is_empty() => "equal in every pixel".to_owned(),
                    Some(verdict) => {
                        format!(
                            "bright: the {} pixels that differ",
                            grouped(verdict.pixels.len())
                        )
                    }
                };
                ui.label(text);
            }
            view => {
                // It stays in its place for every view, so that the picture does.
                let mut percent = doc.comparing.split * 100.0;
                let edit = egui::DragValue::new(&mut percent)
                    .range(0.0..=100.0)
                    .fixed_decimals(0);
                ui.name_inputs("Wipe", |ui| ui.add_enabled(view == View::Wipe, edit));
                ui.label("%");
                doc.comparing.split = percent / 100.0;
            }
        }
    });
}

/// Moves the wipe's line by steps, to the right if positive.
pub fn shift(doc: &mut Document, steps: f32) {
    let split = &mut doc.comparing.split;
    *split = (*split + steps * STEP).clamp(0.0, 1.0);
}
