//! What the 3D view shows, the widgets above it, and what its keys do.

use super::View3d;
use super::cut::Cut;
use super::export;
use crate::geometry::{Axis, Vec3};
use crate::gui::action::{actions, tip};
use crate::gui::document::{Current, Document};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, PaneAction};
use crate::present::overlay::{COLORINGS, Coloring, Filter, Visited};
use egui::containers::menu::{MenuButton, MenuConfig};

/// What the 3D view shows.
#[derive(Clone, Copy)]
pub struct Settings {
    pub scene: bool,
    pub boxes: bool,
    pub coloring: &'static Coloring,
    pub filter: Filter,
    /// What is hidden of objects and leaf boxes.
    pub cut: Cut,
    /// Whether the picture's camera is this view's.
    pub linked: bool,
    /// Of all leaves, only those that the picked ray visited.
    pub only_visited: bool,
    /// Of the picked pixel, all rays rather than the selected one.
    pub all_rays: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            scene: true,
            boxes: true,
            coloring: &COLORINGS[0],
            filter: Filter::default(),
            cut: Cut::default(),
            linked: true,
            only_visited: false,
            all_rays: true,
        }
    }
}

impl Settings {
    fn next_visited(&mut self) {
        let visited = &mut self.filter.visited;
        let at = Visited::ALL.iter().position(|v| v == visited);
        *visited = Visited::ALL[(at.unwrap_or(0) + 1) % Visited::ALL.len()];
    }

    fn next_coloring(&mut self) {
        let at = COLORINGS.iter().position(|c| c.name == self.coloring.name);
        self.coloring = &COLORINGS[(at.unwrap_or(0) + 1) % COLORINGS.len()];
    }
}

/// The row of widgets above the view; what is turned rarely is in a menu, to leave room for the view.
pub fn toolbar(view: &mut View3d, ui: &mut egui::Ui, doc: &mut Document) {
    let mut linked = view.settings.linked;
    ui.horizontal_wrapped(|ui| {
        let settings = &mut view.settings;
        ui.checkbox(&mut settings.scene, "Objects")
            .on_hover_text(tip("Show the scene's objects.", "view3d.show-scene"));
        ui.checkbox(&mut settings.boxes, "Leaf boxes")
            .on_hover_text(tip(
                "Show the cells of the tree's leaves.",
                "view3d.show-boxes",
            ));
        egui::ComboBox::from_id_salt("coloring")
            .selected_text(format!("Colour: {}", settings.coloring.title))
            .width(100.0)
            .show_ui(ui, |ui| {
                for coloring in COLORINGS {
                    let chosen = coloring.name == settings.coloring.name;
                    if ui.selectable_label(chosen, coloring.title).clicked() {
                        settings.coloring = coloring;
                    }
                }
            })
            .response
            .accessible_name("Colour of leaves")
            .on_hover_text(tip("What leaves are coloured by.", "view3d.next-coloring"));
        let config =
            MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let (button, _) = MenuButton::new("Show …").config(config).ui(ui, |ui| {
            ui.reset_style();
            leaves_shown(ui, &mut view.settings, doc);
            ui.separator();
            rays_and_camera(ui, view, &mut linked);
        });
        button.on_hover_text("Which leaves and rays are shown, and which camera.");
        if let Some(current) = &doc.current {
            let root = current.shown.tree.root_cell();
            view.settings.cut.controls(ui, &root);
        }
    });
    if linked != view.settings.linked {
        view.link(linked, doc);
    }
}

/// Filters of the leaf boxes.
fn leaves_shown(ui: &mut egui::Ui, settings: &mut Settings, doc: &Document) {
    let tree = doc.current.as_ref().map(|current| &current.shown.tree);
    let filter = &mut settings.filter;
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
    ui.horizontal(|ui| depth_filter(filter, tree.map_or(0, |tree| tree.depth_reached()), ui));
    ui.checkbox(&mut settings.only_visited, "Only visited")
        .on_hover_text(tip(
            "Of all leaves, show only those that the picked pixel's ray visited.",
            "view3d.shown",
        ));
}

fn rays_and_camera(ui: &mut egui::Ui, view: &mut View3d, linked: &mut bool) {
    ui.strong("Rays and camera");
    ui.checkbox(&mut view.settings.all_rays, "All rays")
        .on_hover_text(tip(
            "Show all rays of the picked pixel, or only the selected one.",
            "view3d.show-rays",
        ));
    ui.checkbox(linked, "Linked").on_hover_text(tip(
        "One camera for this view and the picture. Unlinked, the picture's camera is drawn as a \
         frustum; linking again returns to it.",
        "view3d.link",
    ));
    ui.checkbox(&mut view.camera.orthographic, "Orthographic")
        .on_hover_text(tip(
            "Parallel rays, in this view alone: pictures are always in perspective.",
            "view3d.orthographic",
        ));
}

fn depth_filter(filter: &mut Filter, depth_reached: u32, ui: &mut egui::Ui) {
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

/// The actions of the view.
pub const ACTIONS: &[PaneAction<View3d>] = actions! {
    "view3d.export" Everywhere ALT [Num3] "Export the 3D view: PNG" => |view, cx| {
        let export = export::screen(view, cx.ctx);
        cx.edits.request(Request::Export(Box::new(export)));
    };
    "view3d.export-leaves" Everywhere ALT [Num5] "Export the leaf boxes shown: OBJ or PLY" => |view, cx| {
        let export = export::leaves(view, cx.doc);
        cx.edits.request(Request::Export(Box::new(export)));
    };
    "view3d.frame-selection" Here NONE [F] "Frame the selection" => |view, cx| {
        if let Some(bounds) = cx.doc.current.as_ref().and_then(framed) {
            view.camera.show(&bounds);
            view.keyed = true;
        }
    };
    "view3d.frame-all" Here NONE [Home] "Frame everything" => |view, cx| {
        if let Some(current) = &cx.doc.current {
            view.camera.show(&current.shown.tree.root_cell());
            view.keyed = true;
        }
    };
    "view3d.front" Here NONE [Num1] "Look along the y axis" => |view, _| look(view, Axis::Y);
    "view3d.side" Here NONE [Num3] "Look along the x axis" => |view, _| look(view, Axis::X);
    "view3d.top" Here NONE [Num7] "Look along the z axis" => |view, _| look(view, Axis::Z);
    "view3d.orthographic" Here NONE [Num5] "Switch between orthographic and perspective" => |view, _| view.camera.orthographic ^= true;
    "view3d.link" Here NONE [L] "Use the same camera as the picture, or not" => |view, cx| view.link(!view.settings.linked, cx.doc);
    "view3d.show-scene" Here NONE [M] "Show the scene's objects, or not" => |view, _| view.settings.scene ^= true;
    "view3d.show-boxes" Here NONE [B] "Show leaf boxes, or not" => |view, _| view.settings.boxes ^= true;
    "view3d.show-rays" Here NONE [R] "Show all rays of the picked pixel, or only the selected one" => |view, _| view.settings.all_rays ^= true;
    "view3d.next-coloring" Here NONE [C] "Color leaves by the next property" => |view, _| view.settings.next_coloring();
    "view3d.show-full" Here NONE [O] "Show full leaves, or not" => |view, _| view.settings.filter.full ^= true;
    "view3d.show-empty" Here NONE [P] "Show empty leaves, or not" => |view, _| view.settings.filter.empty ^= true;
    "view3d.shown" Here NONE [V] "Show only the leaves that the picked ray visited, or all" => |view, _| view.settings.only_visited ^= true;
    "view3d.all-depths" Here NONE [X] "Show all depths" => |view, _| view.settings.filter.depth = Filter::default().depth;
    "view3d.visited-or-not" Here NONE [N] "Show leaves that the picture's rays visited, never visited, or all" => |view, _| view.settings.next_visited();
    "view3d.cut" Here NONE [T] "Cut the view open, or not" => |view, _| view.settings.cut.toggle();
    "view3d.cut-axis" Here NONE [Y] "Cut across the next axis" => |view, _| view.settings.cut.turn();
    "view3d.cut-side" Here NONE [U] "Hide the other side of the cut" => |view, _| view.settings.cut.flip();
    "view3d.cut-less" Here NONE [OpenBracket] "Move the cut down its axis" => |view, _| view.settings.cut.shift(-1.0);
    "view3d.cut-more" Here NONE [CloseBracket] "Move the cut up its axis" => |view, _| view.settings.cut.shift(1.0);
    "view3d.fold-legend" Here NONE [I] "Fold the legend to its colors, or unfold it" => |view, _| view.fold_legend();
    "view3d.fly-forward" Here NONE [W] "Fly forward" held => |view, cx| fly(view, Vec3::X, cx);
    "view3d.fly-back" Here NONE [S] "Fly back" held => |view, cx| fly(view, -Vec3::X, cx);
    "view3d.fly-left" Here NONE [A] "Fly to the left" held => |view, cx| fly(view, -Vec3::Y, cx);
    "view3d.fly-right" Here NONE [D] "Fly to the right" held => |view, cx| fly(view, Vec3::Y, cx);
    "view3d.fly-down" Here NONE [Q] "Fly down" held => |view, cx| fly(view, -Vec3::Z, cx);
    "view3d.fly-up" Here NONE [E] "Fly up" held => |view, cx| fly(view, Vec3::Z, cx);
};

/// Moves the camera forward, to the right and up while a key is held.
fn fly(view: &mut View3d, direction: Vec3, cx: &mut Cx<'_>) {
    /// Orbited distances per second.
    const SPEED: f64 = 0.8;
    let dt = cx.ctx.input(|i| f64::from(i.stable_dt)).min(0.1);
    view.camera.fly(direction * (SPEED * dt));
    view.keyed = true;
}

/// Looks along an axis; a second time from the other side.
fn look(view: &mut View3d, axis: Axis) {
    let direction = [-Vec3::X, Vec3::Y, -Vec3::Z][axis.index()];
    let up = if axis == Axis::Z { Vec3::Y } else { Vec3::Z };
    let [forward, ..] = view.camera.frame();
    let turned = if forward.dot(direction) > 0.999_999 {
        -direction
    } else {
        direction
    };
    view.camera.look(turned, up);
    view.keyed = true;
}

/// What F shows: the selected node's cell, or else what is picked.
fn framed(current: &Current) -> Option<crate::geometry::Aabb> {
    match current.selection.node {
        Some(node) => Some(current.shown.tree.cell_of(node).bounds),
        None => selection(current),
    }
}

/// The box of what is picked: the object hit, or else the leaves visited.
pub fn selection(current: &Current) -> Option<crate::geometry::Aabb> {
    use crate::primitive::Shape;
    let path = current.picked.as_ref()?.path();
    if path.hit.is_hit() {
        return Some(current.shown.scene.objects()[path.hit.object as usize].bounds());
    }
    path.leaves()
        .map(|leaf| leaf.bounds)
        .reduce(|a, b| a.union(&b))
}
