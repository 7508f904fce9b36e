//! All settings of the experiment, made from the registry of settings.

mod build;
mod picture;

use crate::gui::pane::{Cx, Fact, Pane};

/// The settings of the tree in front.
#[derive(Default)]
pub struct SettingsPane;

impl Pane for SettingsPane {
    const ID: &'static str = "settings";
    const TITLE: &'static str = "Settings";
    const ALIASES: &'static [&'static str] = &["Tree"];
    const ABOUT: &'static str = "How the tree is built and how the picture is rendered.";
    const REVEALS: &'static [Fact] = &[];

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        ui.strong("Tree");
        build::show(ui, cx.doc);
        ui.add_space(12.0);
        ui.strong("Picture");
        picture::show(ui, cx.doc);
    }
}
