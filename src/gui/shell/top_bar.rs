//! The bar at the top: scene, method, depth, the tasks, settings, and everything else in a menu.

use super::files::Files;
use super::tasks::TASKS;
use crate::gui::action::{shortcut, tip};
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::edits::{Edits, Request};
use crate::gui::icons;
use crate::gui::theme::IconButton;
use crate::gui::widgets::setting_widget::{self, Around};
use crate::setup::SETTINGS;
use egui::containers::menu::MenuButton;

/// Below this width, in points, tasks become a menu and the slider is short.
const NARROW: f32 = 1100.0;

/// The width of the buttons of two trees, in points.
const TREES: f32 = 190.0;

/// The width of the list of methods, in points.
const METHOD: f32 = 150.0;

/// Shows the bar.
pub fn show(ui: &mut egui::Ui, doc: &mut Document, files: &mut Files, edits: &mut Edits) {
    let room = if names_trees(doc) { TREES } else { 0.0 };
    let narrow = ui.available_width() < NARROW + room;
    ui.horizontal_centered(|ui| {
        files.menu(ui, doc);
        which(ui, doc);
        // Wide enough for every method: nothing moves when another one is chosen.
        ui.spacing_mut().combo_width = METHOD;
        let slider = if narrow { 120.0 } else { 240.0 };
        setting(ui, "method", doc, edits, slider);
        setting(ui, "d-max", doc, edits, slider);
        ui.separator();
        if narrow {
            let title = super::tasks::task(doc.task).title;
            ui.menu_button(title, |ui| tasks(ui, doc, edits));
        } else {
            tasks(ui, doc, edits);
        }
        let to_the_left = egui::Layout::right_to_left(egui::Align::Center);
        ui.with_layout(to_the_left, |ui| {
            more(ui, edits);
            let about = tip("All settings of tree and picture.", "window.settings");
            let settings = IconButton::new(icons::GEAR, "Settings").tip(&about);
            if ui.add(settings).clicked() {
                edits.request(Request::Run("window.settings"));
            }
        });
    });
}

fn tasks(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
    for task in &TASKS {
        let tab = egui::Button::selectable(doc.task == task.id, task.title);
        if ui
            .add(tab)
            .on_hover_text(tip(task.about, task.action))
            .clicked()
        {
            edits.request(Request::Task(task.id));
        }
    }
}

/// All that is not needed at once.
fn more(ui: &mut egui::Ui, edits: &mut Edits) {
    let items = [
        ("Search for a command…", "window.palette"),
        ("Save workspace", "window.save-workspace"),
        ("Save workspace as…", "window.save-workspace-as"),
        ("Copy as command", "window.copy-command"),
        ("Export picture…", "picture.export"),
        ("Export heatmap…", "picture.export-heatmap"),
        ("Export 3D view…", "view3d.export"),
        ("Export figures…", "figures.export"),
        ("Export leaf boxes…", "view3d.export-leaves"),
        ("Export report…", "figures.export-report"),
        ("Reset the layout", "window.reset-layout"),
        ("Present", "window.present"),
        ("Light or dark", "window.theme"),
        ("Shortcuts", "window.help"),
    ];
    let dots = egui::Button::new(icons::DOTS).min_size(egui::vec2(28.0, 28.0));
    let (menu, _) = MenuButton::from_button(dots).ui(ui, |ui| {
        for (name, action) in items {
            let item = egui::Button::new(name).shortcut_text(shortcut(action));
            if ui.add(item).clicked() {
                edits.request(Request::Run(action));
                ui.close();
            }
        }
    });
    menu.on_hover_text("Save, export, layout, help")
        .accessible_name("More");
}

/// From dark to light and back.
pub fn toggle_theme(ctx: &egui::Context) {
    set_theme(ctx, ctx.theme() == egui::Theme::Light);
}

pub fn set_theme(ctx: &egui::Context, dark: bool) {
    ctx.set_theme(if dark {
        egui::ThemePreference::Dark
    } else {
        egui::ThemePreference::Light
    });
}

/// Whether there are two trees, and no pane tells which of them the settings are about.
fn names_trees(doc: &Document) -> bool {
    doc.other.is_some() && doc.task != "compare"
}

/// Which of two trees the settings are about, where no pane tells.
fn which(ui: &mut egui::Ui, doc: &mut Document) {
    if !names_trees(doc) {
        return;
    }
    for which in Which::BOTH {
        let about = format!(
            "Bring tree {} to the front: settings and panes are about it.",
            which.name()
        );
        let name = format!("Tree {}", which.name());
        if ui
            .add(egui::Button::new(name).selected(doc.which == which))
            .on_hover_text(tip(&about, "window.other-tree"))
            .clicked()
        {
            doc.show(which);
        }
    }
}

/// A setting of the tree in front, without its row.
fn setting(ui: &mut egui::Ui, name: &str, doc: &Document, edits: &mut Edits, slider: f32) {
    let around = Around {
        largest: 0,
        camera: None,
        depth_limit: doc.current.as_ref().map(|c| c.shown.tree.depth_limit()),
        root_margin: doc.current.as_ref().map(|c| c.shown.tree.root_margin()),
        slider: Some(slider),
        note: &|_, _| None,
    };
    let mut known = SETTINGS.iter();
    if let Some(setting) = known.find(|setting| setting.name == name) {
        ui.label(setting.label)
            .on_hover_text(setting_widget::about(setting, &doc.wanted));
        setting_widget::show(ui, setting, &doc.wanted, &around, edits);
    }
}
