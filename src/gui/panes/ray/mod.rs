//! One ray, completely: the steps of its traversal, played or stepped through.

mod bar;
mod walk;

use crate::gui::action::actions;
use crate::gui::document::walk::Go;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};

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
        "ray.previous-ray" Everywhere NONE [PageUp] "Select the previous ray of the picked pixel" => |_, cx| cx.doc.next_ray(-1);
        "ray.next-ray" Everywhere NONE [PageDown] "Select the next ray of the picked pixel" => |_, cx| cx.doc.next_ray(1);
        "ray.first-step" Everywhere SHIFT [Home] "Go to the first step of the ray" => |_, cx| cx.doc.go(Go::First);
        "ray.previous-step" Everywhere NONE [Comma] "Go one step back along the ray" => |_, cx| cx.doc.go(Go::Previous);
        "ray.next-step" Everywhere NONE [Period] "Go one step forward along the ray" => |_, cx| cx.doc.go(Go::Next);
        "ray.last-step" Everywhere SHIFT [End] "Go to the last step of the ray" => |_, cx| cx.doc.go(Go::Last);
        "ray.play" Everywhere NONE [Space] "Play the steps of the ray, or pause" => |_, cx| cx.doc.play_or_pause(cx.ctx.input(|i| i.time));
        "ray.leaves-only" Everywhere NONE [K] "Step through leaves only, or through inner nodes, too" => |_, cx| cx.doc.set_leaves_only(!cx.doc.walking.leaves_only);
    };

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        bar::show(ui, cx.doc);
        walk::show(ui, cx.doc);
    }
}
