//! The bar at the top: scene, method, depth, the tasks, settings, and everything else in a menu.

use super::files::Files;
use super::tasks::TASKS;
use crate::gui::action::{shortcut, tip};
use crate::gui::document::Document;
use crate::gui::document::comparing::Which;
use crate::gui::edits::{Edits, Request};
use crate::gui::icons;
use crate::gui::theme::IconButton;
use crate::measure::parameter;
use crate::structure::{MaxDepth, Method};
use egui::containers::menu::MenuButton;

/// Below this width, in points, tasks become a menu and the slider is short.
const NARROW: f32 = 1100.0;

/// Shows the bar.
pub fn show(ui: &mut egui::Ui, doc: &mut Document, files: &mut Files, edits: &mut Edits) {
    let narrow = ui.available_width() < NARROW;
    ui.horizontal_centered(|ui| {
        files.menu(ui, doc);
        which(ui, doc);
        method(ui, doc);
        d_max(ui, doc, if narrow { 120.0 } else { 240.0 });
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

/// Which of two compared trees the settings are about.
fn which(ui: &mut egui::Ui, doc: &mut Document) {
    if doc.other.is_none() {
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

fn method(ui: &mut egui::Ui, doc: &mut Document) {
    let method = doc.wanted.build.method;
    egui::ComboBox::from_id_salt("method")
        .selected_text(format!("Method: {}", method.name))
        .width(150.0)
        .show_ui(ui, |ui| {
            for other in Method::all() {
                let item = ui.selectable_label(other == method, other.name);
                let item = item.on_hover_text(format!("{}\nSource: {}", other.about, other.source));
                if item.clicked() {
                    doc.wanted.build.set_method(other);
                }
            }
        })
        .response
        .accessible_name("Build method")
        .on_hover_text(tip(method.about, "window.next-method"));
}

fn d_max(ui: &mut egui::Ui, doc: &mut Document, width: f32) {
    let automatic = doc.wanted.build.d_max == MaxDepth::Automatic;
    let about = about("D_MAX", "window.deeper");
    ui.label("Depth").on_hover_text(&about);
    // While automatic, the number says what that came to in the tree on view.
    let resolved = doc
        .current
        .as_ref()
        .map_or(0, |c| c.shown.tree.depth_limit());
    let mut depth = match doc.wanted.build.d_max {
        MaxDepth::Fixed(depth) => depth,
        MaxDepth::Automatic => resolved,
    };
    ui.spacing_mut().slider_width = width;
    let slider = egui::Slider::new(&mut depth, 0..=MaxDepth::LIMIT);
    let changed = ui
        .name_inputs("D_MAX", |ui| ui.add_enabled(!automatic, slider))
        .on_hover_text(&about)
        .changed();
    if changed && !automatic {
        doc.wanted.build.d_max = MaxDepth::Fixed(depth);
    }
    let mut auto = automatic;
    ui.checkbox(&mut auto, "Auto").on_hover_text(tip(
        "D_MAX = 1.2 log2 N_O + 2, rounded.",
        "window.auto-depth",
    ));
    if auto != automatic {
        doc.toggle_automatic_depth();
    }
}

/// The tooltip of a setting that is one of the paper's parameters.
fn about(symbol: &str, action: &str) -> String {
    let p = parameter(symbol);
    tip(
        &format!(
            "{}: {}\n{}\nClass {:?} · {}",
            p.symbol,
            p.name,
            p.meaning,
            p.class,
            p.table.title()
        ),
        action,
    )
}
