//! The build methods of A and B, and which of the two is in front.

use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::edits::Edits;
use crate::gui::theme::{hint, strong, tokens};
use crate::gui::widgets::choice_list;
use crate::setup::Setup;
use crate::structure::Method;

/// Shows both.
pub fn show(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    let wanted = doc.all_wanted();
    let Some(b) = &wanted.b else {
        return;
    };
    for (which, setup, other) in [(Which::A, &wanted.a, b), (Which::B, b, &wanted.a)] {
        ui.horizontal(|ui| {
            side(ui, doc, which, edits);
            method(ui, doc, which, setup, edits);
        });
        let differences = differences(setup, other);
        if !differences.is_empty() {
            ui.add(egui::Label::new(hint(differences)).wrap());
        }
    }
}

/// The letter; a click brings its tree to the front.
fn side(ui: &mut egui::Ui, doc: &Document, which: Which, edits: &mut Edits) {
    let t = tokens(ui);
    let color = match which {
        Which::A => t.a,
        Which::B => t.b,
    };
    let is_in_front = doc.which == which;
    let text = strong(which.name());
    // Only plain text can be read on the color of what is selected.
    let text = if is_in_front { text } else { text.color(color) };
    let button = egui::Button::new(text)
        .selected(is_in_front)
        .min_size(egui::vec2(36.0, 0.0));
    let about = tip(
        "Bring this tree to the front: settings and panes are about it.",
        "window.other-tree",
    );
    let name = format!("Bring {} to the front", which.name());
    let response = ui.add(button).on_hover_text(about).accessible_name(name);
    if response.clicked() {
        edits.add(move |doc| doc.show(which));
    }
}

fn method(ui: &mut egui::Ui, doc: &Document, which: Which, setup: &Setup, edits: &mut Edits) {
    let method = setup.build.method;
    let is_in_front = doc.which == which;
    egui::ComboBox::from_id_salt(("method of", which.name()))
        .selected_text(method.name)
        .width(ui.available_width() - 16.0)
        // Without scrolling: a list that hides its last item hides that there is one.
        .height(f32::INFINITY)
        .show_ui(ui, |ui| {
            choice_list::close_together(ui);
            for (family, methods) in Method::families() {
                choice_list::group(ui, family);
                for other in methods {
                    let item = choice_list::item(ui, other == method, other.name, other.summary);
                    let about = format!("{}\nSource: {}", other.about, other.source);
                    let item = item.on_hover_text(about).accessible_name(other.name);
                    if item.clicked() {
                        ui.close();
                        edits.add(move |doc| {
                            let behind = doc.other.as_mut().filter(|_| !is_in_front);
                            let wanted = behind.map_or(&mut doc.wanted, |other| &mut other.wanted);
                            wanted.build.set_method(other);
                        });
                    }
                }
            }
        })
        .response
        .on_hover_text(method.about)
        .accessible_name(format!("Build method of {}", which.name()));
}

/// The settings in which a setup differs from another one, besides the method.
fn differences(setup: &Setup, other: &Setup) -> String {
    let is_other = |s: &crate::setup::Setting| {
        let known = other.settings().any(|known| known.name == s.name);
        known && s.name != "method" && s.value(setup) != s.value(other)
    };
    let different = setup.settings().filter(is_other);
    let texts = different.map(|s| format!("{} {}", s.label, s.text(setup)));
    texts.collect::<Vec<_>>().join(" · ")
}
