//! The part of a toolbar that shows how a study stands.

use crate::gui::action::tip;
use crate::gui::document::study::Study;
use crate::jobs::{End, Job, Standing};
use crate::present::number::Digits;

/// Shows a button that cancels the study, its progress, and `waiting` while other work comes first. Returns
/// whether a study runs; shows nothing if not.
pub fn running<J: Job, F: Clone>(
    ui: &mut egui::Ui,
    study: &mut Study<J, F>,
    [cancel, about, waiting]: [&str; 3],
) -> bool {
    let Some(status) = study.status() else {
        return false;
    };
    let cancel = ui.button(cancel).on_hover_text(tip(about, "window.cancel"));
    if cancel.clicked() {
        study.cancel();
    }
    ui.label(Digits::Three.percent(status.fraction));
    ui.weak(match status.standing {
        Standing::Running => "measuring…",
        Standing::Waiting | Standing::Paused => waiting,
    });
    ui.ctx().request_repaint_after_secs(0.2);
    true
}

/// Says how the last study ended if it was not completed.
pub fn ended<J: Job, F: Clone>(ui: &mut egui::Ui, study: &Study<J, F>, cancelled: &str) {
    match study.end() {
        Some(End::Cancelled) => {
            ui.label(cancelled);
        }
        Some(End::Failed(why)) => {
            ui.label(format!("failed: {why}"));
        }
        Some(End::Done(()) | End::Replaced) | None => {}
    }
}
