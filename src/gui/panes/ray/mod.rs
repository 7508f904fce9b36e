//! One ray, completely: the steps of its traversal, one by one or played.

mod bar;
mod details;
mod steps;
mod strip;

use crate::gui::action::actions;
use crate::gui::document::walk::Go;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::rest_of;
use egui::{Layout, Ui, vec2};

/// In a pane of this width, in points, the details of a step stand beside the list.
const WIDE: f32 = 800.0;

/// The share of a wide pane that the list takes.
const LIST: f32 = 0.58;

/// The traversal of the selected ray.
#[derive(Default)]
pub struct RayPane;

impl Pane for RayPane {
    const ID: &'static str = "ray";
    const TITLE: &'static str = "Steps of the ray";
    const ALIASES: &'static [&'static str] = &["Walk of the ray"];
    const ABOUT: &'static str = "Every node that the selected ray visits, in order, and why.";
    const REVEALS: &'static [Fact] = &[Fact::Rays, Fact::Steps];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "ray.previous-ray" Everywhere NONE [PageUp] "Select the previous ray of the picked pixel" => |_, cx| cx.edits.add(|doc| doc.next_ray(-1));
        "ray.next-ray" Everywhere NONE [PageDown] "Select the next ray of the picked pixel" => |_, cx| cx.edits.add(|doc| doc.next_ray(1));
        "ray.first-step" Everywhere SHIFT [Home] "Go to the first step of the ray" => |_, cx| cx.edits.add(|doc| doc.go(Go::First));
        "ray.previous-step" Everywhere NONE [Comma] "Go one step back along the ray" => |_, cx| cx.edits.add(|doc| doc.go(Go::Previous));
        "ray.next-step" Everywhere NONE [Period] "Go one step forward along the ray" => |_, cx| cx.edits.add(|doc| doc.go(Go::Next));
        "ray.last-step" Everywhere SHIFT [End] "Go to the last step of the ray" => |_, cx| cx.edits.add(|doc| doc.go(Go::Last));
        "ray.play" Everywhere NONE [Space] "Play the steps of the ray, or pause" => |_, cx| {
            let now = cx.ctx.input(|i| i.time);
            cx.edits.add(move |doc| doc.play_or_pause(now));
        };
        "ray.leaves-only" Everywhere NONE [K] "Step through leaves only, or through inner nodes, too" => |_, cx| cx.edits.add(|doc| doc.set_leaves_only(!doc.walking.leaves_only));
    };

    fn ui(&mut self, ui: &mut Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        ui.spacing_mut().item_spacing.y = 0.0;
        let is_wide = ui.available_width() >= WIDE;
        bar::buttons(ui, doc, cx.edits, is_wide);
        let picked = doc.current.as_ref().and_then(|c| c.picked.as_ref());
        let path = picked.map(|picked| picked.path());
        let step = picked.map_or(0, |picked| picked.step);
        if let Some(step) = strip::show(ui, path, step, doc.walking.leaves_only) {
            cx.edits.add(move |doc| steps::go_to(doc, step));
        }
        bar::sentence(ui, doc, is_wide);
        let room = rest_of(ui);
        if !is_wide {
            steps::show(ui, doc, cx.edits, room.y);
            return;
        }
        ui.allocate_ui_with_layout(room, Layout::left_to_right(egui::Align::Min), |ui| {
            let size = vec2(LIST * room.x, room.y);
            ui.allocate_ui_with_layout(size, Layout::top_down(egui::Align::Min), |ui| {
                ui.set_min_size(size);
                steps::show(ui, doc, cx.edits, room.y);
            });
            let size = vec2(ui.available_width(), room.y);
            ui.allocate_ui_with_layout(size, Layout::top_down(egui::Align::Min), |ui| {
                ui.set_min_size(size);
                details::show(ui, doc, room.y);
            });
        });
    }
}
