//! The row above two compared pictures: how they are shown, and what their keys do.

use super::comparing::View;
use super::shortcuts::{Action, tip};
use super::state::State;
use super::symbol::grouped;

/// How far a key moves the wipe's line, of the picture's width.
const STEP: f32 = 0.05;

/// Shows the row; `picture` says that no heatmap is shown.
pub fn show(ui: &mut egui::Ui, state: &mut State, picture: bool) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for view in View::ALL {
            ui.selectable_value(&mut state.comparing.view, view, view.name())
                .on_hover_text(tip(view.about(), Action::NextView));
        }
        match state.comparing.view {
            View::Difference if picture => {
                let text = match state.verdict(ui.ctx()) {
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
                let mut percent = state.comparing.split * 100.0;
                let edit = egui::DragValue::new(&mut percent)
                    .range(0.0..=100.0)
                    .fixed_decimals(0);
                ui.name_inputs("Wipe", |ui| ui.add_enabled(view == View::Wipe, edit));
                ui.label("%");
                state.comparing.split = percent / 100.0;
            }
        }
    });
}

/// Does what a key asks for, if it is about two pictures.
pub fn act(action: Action, state: &mut State) -> bool {
    let comparing = &mut state.comparing;
    match action {
        Action::NextView => comparing.view = comparing.view.next(),
        Action::Flip => comparing.flipped = true,
        Action::WipeLeft => comparing.split = (comparing.split - STEP).max(0.0),
        Action::WipeRight => comparing.split = (comparing.split + STEP).min(1.0),
        _ => return false,
    }
    true
}
