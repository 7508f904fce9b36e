//! How the tree is built: root cell, overlap, memory, and the method's own constants.

use super::{Panel, Side};
use crate::gui::setting_widget::{Around, rows};
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::State;
use crate::setup::{Group, SETTINGS};
use crate::structure::BuildSettings;

pub(super) const PANEL: Panel = Panel {
    title: "Tree",
    side: Side::Left,
    open: true,
    show,
};

/// Settings whose widgets stand in the bar at the top.
pub(super) const IN_TOP_BAR: [&str; 4] = ["method", "d-max", "n-oilf", "d-arec"];

fn show(ui: &mut egui::Ui, state: &mut State) {
    let setup = &mut state.wanted;
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
    ui.label(method.title)
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
            Action::ResetMethod,
        ))
        .clicked()
    {
        *build = paper;
    }
}
