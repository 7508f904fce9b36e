//! What the user wrote down, and pixels to come back to; both are saved in a workspace.

use super::{Panel, Side};
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::{Current, State};

pub(super) const PANEL: Panel = Panel {
    title: "Notes",
    side: Side::Left,
    open: false,
    show,
};

fn show(ui: &mut egui::Ui, state: &mut State) {
    let field = egui::TextEdit::multiline(&mut state.notes)
        .hint_text("Notes, saved with the workspace")
        .desired_rows(4)
        .desired_width(f32::INFINITY);
    ui.add(field).accessible_name("Text of the notes");
    let picked = state.current.as_ref().and_then(Current::picked_pixel);
    let is_pinned = picked.is_some_and(|pixel| state.pinned.contains(&pixel));
    let name = if is_pinned {
        "Unpin the picked pixel"
    } else {
        "Pin the picked pixel"
    };
    if ui
        .add_enabled(picked.is_some(), egui::Button::new(name))
        .on_hover_text(tip(
            "Mark the picked pixel in the picture and in this list, to come back to it.",
            Action::Pin,
        ))
        .clicked()
    {
        state.pin_or_unpin();
    }
    let mut chosen = None;
    for (i, &[x, y]) in state.pinned.iter().enumerate() {
        let name = format!("{}: pixel {x}, {y}", i + 1);
        let is_picked = picked == Some([x, y]);
        if ui.selectable_label(is_picked, name).clicked() {
            chosen = Some([x, y]);
        }
    }
    if let (Some(pixel), Some(current)) = (chosen, &mut state.current) {
        current.pick(pixel);
    }
}
