//! What the 3D view shows, the widgets above it, and what its keys do.

use super::View3d;
use super::cut::Cut;
use crate::geometry::{Axis, Vec3};
use crate::gui::build_bar;
use crate::gui::shortcuts::{Action, tip};
use crate::gui::state::{Current, State};
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
pub fn toolbar(view: &mut View3d, ui: &mut egui::Ui, state: &mut State) {
    let mut linked = view.settings.linked;
    ui.horizontal_wrapped(|ui| {
        let settings = &mut view.settings;
        ui.checkbox(&mut settings.scene, "Objects")
            .on_hover_text(tip("Show the scene's objects.", Action::ShowScene));
        ui.checkbox(&mut settings.boxes, "Leaf boxes")
            .on_hover_text(tip(
                "Show the cells of the tree's leaves.",
                Action::ShowBoxes,
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
            .on_hover_text(tip("What leaves are coloured by.", Action::NextColoring));
        let config =
            MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside);
        let (button, _) = MenuButton::new("Show …").config(config).ui(ui, |ui| {
            ui.reset_style();
            leaves_shown(ui, &mut view.settings, state);
            ui.separator();
            rays_and_camera(ui, view, &mut linked);
        });
        button.on_hover_text("Which leaves and rays are shown, and which camera.");
        build_bar::switch(ui, state);
        if let Some(current) = &state.current {
            let root = current.shown.tree.root_cell();
            view.settings.cut.controls(ui, &root);
        }
    });
    if linked != view.settings.linked {
        view.link(linked, state);
    }
}

/// Filters of the leaf boxes.
fn leaves_shown(ui: &mut egui::Ui, settings: &mut Settings, state: &State) {
    let tree = state.current.as_ref().map(|current| &current.shown.tree);
    let filter = &mut settings.filter;
    ui.strong("Leaves");
    ui.checkbox(&mut filter.full, "Full (solid)")
        .on_hover_text(tip(
            "Show leaves with objects; their edges are solid.",
            Action::ShowFull,
        ));
    ui.checkbox(&mut filter.empty, "Empty (dashed)")
        .on_hover_text(tip(
            "Show leaves without objects; their edges are dashed.",
            Action::ShowEmpty,
        ));
    for visited in Visited::ALL {
        ui.radio_value(&mut filter.visited, visited, visited.title())
            .on_hover_text(tip(
                "Show leaves by whether any ray of the picture visited them.",
                Action::VisitedOrNot,
            ));
    }
    ui.horizontal(|ui| depth_filter(filter, tree.map_or(0, |tree| tree.depth_reached()), ui));
    ui.checkbox(&mut settings.only_visited, "Only visited")
        .on_hover_text(tip(
            "Of all leaves, show only those that the picked pixel's ray visited.",
            Action::Shown,
        ));
}

fn rays_and_camera(ui: &mut egui::Ui, view: &mut View3d, linked: &mut bool) {
    ui.strong("Rays and camera");
    ui.checkbox(&mut view.settings.all_rays, "All rays")
        .on_hover_text(tip(
            "Show all rays of the picked pixel, or only the selected one.",
            Action::ShowRays,
        ));
    ui.checkbox(linked, "Linked").on_hover_text(tip(
        "One camera for this view and the picture. Unlinked, the picture's camera is drawn as a \
         frustum; linking again returns to it.",
        Action::Link,
    ));
    ui.checkbox(&mut view.camera.orthographic, "Orthographic")
        .on_hover_text(tip(
            "Parallel rays, in this view alone: pictures are always in perspective.",
            Action::Orthographic,
        ));
}

fn depth_filter(filter: &mut Filter, depth_reached: u32, ui: &mut egui::Ui) {
    let [lowest, highest] = filter.depth;
    let (mut from, mut to) = (lowest.min(depth_reached), highest.min(depth_reached));
    let about = tip(
        "Show leaves from this depth to that; the root has depth 0.",
        Action::AllDepths,
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

/// Does what a key asks for; says whether the camera moved.
pub fn act(view: &mut View3d, action: Action, state: &State, dt: f64) -> bool {
    const FLIGHT: f64 = 0.8;
    let by = FLIGHT * dt;
    let settings = &mut view.settings;
    let moved = match action {
        Action::FlyForward => Some(Vec3::new(by, 0.0, 0.0)),
        Action::FlyBack => Some(Vec3::new(-by, 0.0, 0.0)),
        Action::FlyRight => Some(Vec3::new(0.0, by, 0.0)),
        Action::FlyLeft => Some(Vec3::new(0.0, -by, 0.0)),
        Action::FlyUp => Some(Vec3::new(0.0, 0.0, by)),
        Action::FlyDown => Some(Vec3::new(0.0, 0.0, -by)),
        _ => None,
    };
    if let Some(by) = moved {
        view.camera.fly(by);
        return true;
    }
    match action {
        Action::FoldLegend => view.fold_legend(),
        Action::ShowScene => settings.scene ^= true,
        Action::ShowBoxes => settings.boxes ^= true,
        Action::ShowFull => settings.filter.full ^= true,
        Action::ShowEmpty => settings.filter.empty ^= true,
        Action::ShowRays => settings.all_rays ^= true,
        Action::Shown => settings.only_visited ^= true,
        Action::NextColoring => settings.next_coloring(),
        Action::VisitedOrNot => settings.next_visited(),
        Action::AllDepths => settings.filter.depth = Filter::default().depth,
        Action::Link => view.link(!view.settings.linked, state),
        Action::Orthographic => view.camera.orthographic ^= true,
        Action::FrameAll => {
            if let Some(current) = &state.current {
                view.camera.show(&current.shown.tree.root_cell());
                return true;
            }
        }
        Action::FrameSelection => {
            if let Some(bounds) = state.current.as_ref().and_then(framed) {
                view.camera.show(&bounds);
                return true;
            }
        }
        Action::Front => return look(view, Axis::Y),
        Action::Side => return look(view, Axis::X),
        Action::Top => return look(view, Axis::Z),
        action => settings.cut.act(action),
    }
    false
}

/// Looks along an axis; a second time from the other side.
fn look(view: &mut View3d, axis: Axis) -> bool {
    let direction = [-Vec3::X, Vec3::Y, -Vec3::Z][axis.index()];
    let up = if axis == Axis::Z { Vec3::Y } else { Vec3::Z };
    let [forward, ..] = view.camera.frame();
    let turned = if forward.dot(direction) > 0.999_999 {
        -direction
    } else {
        direction
    };
    view.camera.look(turned, up);
    true
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
