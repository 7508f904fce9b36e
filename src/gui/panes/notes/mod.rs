//! What the user wrote down, and pixels to come back to; both are saved in a workspace.

use crate::gui::action::tip;
use crate::gui::document::{Current, Document};
use crate::gui::edits::Edits;
use crate::gui::pane::{Cx, Fact, Pane};

#[derive(Default)]
pub struct NotesPane;

impl Pane for NotesPane {
    const ID: &'static str = "notes";
    const TITLE: &'static str = "Notes";
    const ABOUT: &'static str = "Your notes and pinned pixels, saved with the workspace.";
    const REVEALS: &'static [Fact] = &[];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        text(ui, doc, cx.edits);
        pins(ui, doc, cx.edits);
    }
}

fn text(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let mut notes = doc.notes.clone();
    let field = egui::TextEdit::multiline(&mut notes)
        .hint_text("Notes, saved with the workspace")
        .desired_rows(4)
        .desired_width(f32::INFINITY);
    let field = ui.add(field).accessible_name("Text of the notes");
    if field.changed() {
        edits.add(move |doc| doc.notes = notes);
    }
}

/// The pinned pixels, and the button that pins the picked one.
fn pins(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let picked = doc.current.as_ref().and_then(Current::picked_pixel);
    let is_pinned = picked.is_some_and(|pixel| doc.pinned.contains(&pixel));
    let name = if is_pinned {
        "Unpin the picked pixel"
    } else {
        "Pin the picked pixel"
    };
    if ui
        .add_enabled(picked.is_some(), egui::Button::new(name))
        .on_hover_text(tip(
            "Mark the picked pixel in the picture and in this list, to come back to it.",
            "picture.pin",
        ))
        .on_disabled_hover_text("Pick a pixel first: click one in the picture.")
        .clicked()
    {
        edits.add(|doc| doc.pin_or_unpin());
    }
    for (i, &[x, y]) in doc.pinned.iter().enumerate() {
        let name = format!("{}: pixel {x}, {y}", i + 1);
        let is_picked = picked == Some([x, y]);
        if ui.selectable_label(is_picked, name).clicked() {
            edits.add(move |doc| {
                if let Some(current) = &mut doc.current {
                    current.pick([x, y]);
                }
            });
        }
    }
}
