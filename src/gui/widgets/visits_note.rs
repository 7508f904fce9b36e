//! How the counting of visits stands, where a pane waits for it.

use crate::gui::document::Current;
use crate::gui::document::picture_job::Progress;
use crate::gui::document::visits::VisitsJob;

/// Shows how counting stands, with a button that cancels or restarts it; nothing once visits are
/// counted. Returns whether the button was clicked.
#[must_use]
pub fn visits_note(ui: &mut egui::Ui, visits: &VisitsJob, current: &Current) -> bool {
    let Some(note) = visits.note(current) else {
        return false;
    };
    ui.label(note);
    let (name, about) = match visits.progress() {
        Progress::Running(_) => ("Cancel counting", "Stop counting visits."),
        Progress::Ended(_) => ("Count again", "Start counting visits again."),
        Progress::Waiting | Progress::Done => return false,
    };
    ui.button(name).on_hover_text(about).clicked()
}
