//! How the tree is built: root cell, overlap, memory, and the method's own constants.

use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::widgets::setting_widget::{Around, rows};
use crate::setup::{Group, SETTINGS};
use crate::structure::BuildSettings;

/// Settings whose widgets stand in the bar at the top.
pub(super) const IN_TOP_BAR: [&str; 2] = ["method", "d-max"];

pub fn show(ui: &mut egui::Ui, doc: &mut Document) {
    let setup = &mut doc.wanted;
    let around = Around {
        largest: 0,
        camera: None,
        note: &|_, _| None,
    };
    let is_of_method = |name: &str| SETTINGS.iter().all(|s| s.name != name);
    let of_tree = |setup: &crate::setup::Setup, own: bool| {
        let settings = setup.settings().filter(|s| s.group == Group::Structure);
        settings.filter(move |s| !IN_TOP_BAR.contains(&s.name) && is_of_method(s.name) == own)
    };
    let general = of_tree(setup, false);
    rows(ui, "build settings", general, setup, &around);
    let method = setup.build.method;
    ui.add_space(4.0);
    ui.label(method.name)
        .on_hover_text(format!("{}\nSource: {}", method.about, method.source));
    if method.constants.is_empty() {
        ui.weak("This method has no settings of its own.");
    } else {
        let own = of_tree(setup, true);
        rows(ui, "constants", own, setup, &around);
    }
    let build = &mut setup.build;
    let paper = BuildSettings::for_method(method);
    if ui
        .add_enabled(*build != paper, egui::Button::new("Reset to the paper's"))
        .on_hover_text(tip(
            "All settings of the tree as in the paper, D_MAX and N_OILF too.",
            "window.reset-method",
        ))
        .clicked()
    {
        *build = paper;
    }
}
