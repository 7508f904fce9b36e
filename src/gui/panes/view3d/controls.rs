//! The widgets in the title row of the 3D view.

use super::settings::{Cells, FIRST_DEPTH, Settings};
use super::view::View3d;
use crate::gui::action::tip;
use crate::gui::document::Document;
use crate::gui::icons;
use crate::present::overlay::{COLORINGS, Filter, Outside, Visited};
use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, PopupCloseBehavior, Ui};

/// Shows the widgets, from right to left; what is changed rarely is in menus, to leave room for the view.
pub fn show(view: &mut View3d, ui: &mut Ui, doc: &Document) {
    let config = || MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let more = Button::new(icons::DOTS);
    let (button, _) = MenuButton::from_button(more).config(config()).ui(ui, |ui| {
        objects_and_rays(ui, view);
        if let Some(current) = &doc.current {
            ui.separator();
            let root = current.shown.tree.root_cell();
            view.settings.cut.controls(ui, &root);
        }
    });
    button
        .on_hover_text("Which objects and rays are shown, and where the view is cut open.")
        .accessible_name("More about the 3D view");
    let linked = view.settings.linked;
    let same = ui.add(Button::selectable(linked, "Same camera"));
    let about = "Moving this view moves the picture's camera, which renders the picture again. \
                 Otherwise the view has its own camera.";
    if same.on_hover_text(tip(about, "view3d.link")).clicked() {
        view.link(!linked, doc);
    }
    let title = format!(
        "Cells: {} {}",
        view.settings.cells_in_words(),
        icons::CARET_DOWN
    );
    let (button, _) = MenuButton::new(title).config(config()).ui(ui, |ui| {
        cells(ui, &mut view.settings);
        ui.separator();
        outside(ui, &mut view.settings);
        ui.separator();
        coloring(ui, &mut view.settings);
        ui.separator();
        let reached = doc.current.as_ref();
        let reached = reached.map_or(0, |current| current.shown.tree.depth_reached());
        leaves_shown(ui, &mut view.settings.filter, reached);
    });
    button
        .on_hover_text("Which cells of the tree are shown, and their colors.")
        .accessible_name("Cells");
}

/// Which cells are drawn.
fn cells(ui: &mut Ui, settings: &mut Settings) {
    let cells = &mut settings.cells;
    ui.strong("Cells");
    ui.radio_value(cells, Cells::None, "None")
        .on_hover_text(tip("Show no cells.", "view3d.show-boxes"));
    ui.horizontal(|ui| {
        let mut depth = match *cells {
            Cells::ToDepth(depth) => depth,
            _ => FIRST_DEPTH,
        };
        let is_chosen = matches!(cells, Cells::ToDepth(_));
        let radio = ui.radio(is_chosen, "To depth").on_hover_text(
            "Show the cells at a depth, and leaves above it. A filter of leaves shows leaves instead.",
        );
        let edit = egui::DragValue::new(&mut depth).range(0..=30).speed(0.1);
        let edit = ui.add(edit).accessible_name("Depth of the cells shown");
        if radio.clicked() || edit.changed() {
            *cells = Cells::ToDepth(depth);
        }
    });
    ui.radio_value(cells, Cells::All, "All leaves")
        .on_hover_text(tip("Show all leaves.", "view3d.all-depths"));
    ui.radio_value(cells, Cells::Visited, "Visited by the ray")
        .on_hover_text(tip(
            "Show only the leaves that the selected ray visited.",
            "view3d.shown",
        ));
}

/// How the cells outside of the selected subtree are shown.
fn outside(ui: &mut Ui, settings: &mut Settings) {
    let about = tip(
        "Let the subtree of the selected inner node stand out, to tell apart boxes that overlap. A leaf that \
         is selected in it changes nothing.",
        "view3d.outside",
    );
    ui.strong("Outside of the selected subtree")
        .on_hover_text(&about);
    ui.horizontal(|ui| {
        for outside in Outside::ALL {
            ui.radio_value(&mut settings.outside, outside, outside.title())
                .on_hover_text(&about);
        }
    });
}

/// What decides the color of a cell.
fn coloring(ui: &mut Ui, settings: &mut Settings) {
    ui.strong("Color").on_hover_text(tip(
        "The property that decides the color of a cell.",
        "view3d.next-coloring",
    ));
    for coloring in COLORINGS {
        let is_chosen = coloring.name == settings.coloring.name;
        if ui.radio(is_chosen, coloring.title).clicked() {
            settings.coloring = coloring;
        }
    }
}

/// Filters of the leaves.
fn leaves_shown(ui: &mut Ui, filter: &mut Filter, depth_reached: u32) {
    ui.strong("Leaves");
    ui.checkbox(&mut filter.full, "Full (solid)")
        .on_hover_text(tip(
            "Show leaves with objects; their edges are solid.",
            "view3d.show-full",
        ));
    ui.checkbox(&mut filter.empty, "Empty (dashed)")
        .on_hover_text(tip(
            "Show leaves without objects; their edges are dashed.",
            "view3d.show-empty",
        ));
    for visited in Visited::ALL {
        ui.radio_value(&mut filter.visited, visited, visited.title())
            .on_hover_text(tip(
                "Show leaves by whether any ray of the picture visited them.",
                "view3d.visited-or-not",
            ));
    }
    ui.horizontal(|ui| depth_filter(filter, depth_reached, ui));
}

fn objects_and_rays(ui: &mut Ui, view: &mut View3d) {
    ui.checkbox(&mut view.settings.scene, "Objects")
        .on_hover_text(tip("Show the scene's objects.", "view3d.show-scene"));
    ui.checkbox(&mut view.settings.all_rays, "All rays")
        .on_hover_text(tip(
            "Show all rays of the picked pixel, or only the selected one.",
            "view3d.show-rays",
        ));
    ui.checkbox(&mut view.camera.orthographic, "Orthographic")
        .on_hover_text(tip(
            "Use parallel rays, in this view alone: pictures are always in perspective.",
            "view3d.orthographic",
        ));
}

fn depth_filter(filter: &mut Filter, depth_reached: u32, ui: &mut Ui) {
    let [lowest, highest] = filter.depth;
    let (mut from, mut to) = (lowest.min(depth_reached), highest.min(depth_reached));
    let about = tip(
        "Show leaves from this depth to that; the root has depth 0.",
        "view3d.all-depths",
    );
    let mut edit = |value: &mut u32, range, name: &str, prefix: &str, suffix: &str| {
        let edit = egui::DragValue::new(value).range(range).speed(0.1);
        ui.add(edit.prefix(prefix).suffix(suffix))
            .accessible_name(name)
            .on_hover_text(&about)
            .changed()
    };
    if edit(&mut from, 0..=to, "Least depth shown", "Depth ", "") {
        filter.depth[0] = from;
    }
    let all = from..=depth_reached;
    if edit(&mut to, all, "Greatest depth shown", "to ", " levels") {
        // At the tree's greatest depth nothing is cut off, also in the next tree.
        filter.depth[1] = if to == depth_reached { u32::MAX } else { to };
    }
}
