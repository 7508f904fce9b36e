//! The bar that goes through the build of the tree, and says what the current step does.

use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::document::RATES;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::name_widget;
use crate::gui::widgets::symbol::grouped;
use crate::structure::{Moment, NodeKind};

/// The build of the tree on view.
#[derive(Default)]
pub struct BuildPane;

impl Pane for BuildPane {
    const ID: &'static str = "build";
    const TITLE: &'static str = "Build steps";
    const ABOUT: &'static str = "The tree as it stood at any moment of its build.";
    const REVEALS: &'static [Fact] = &[Fact::Tree];
    const ACTIONS: &'static [PaneAction<Self>] = actions! {
        "build.show" Everywhere COMMAND [G] "Show the build of the tree step by step, or the finished tree" => |_, cx| {
            cx.doc.toggle_build();
            if cx.doc.inspect.build.on {
                cx.edits.request(Request::Show(Self::ID));
            }
        };
        "build.first" Everywhere ALT [Home] "Go to the first moment of the build" => |_, cx| cx.doc.go_in_build(0);
        "build.previous" Everywhere ALT [ArrowLeft] "Go one step of the build back" => |_, cx| cx.doc.step_build(-1);
        "build.next" Everywhere ALT [ArrowRight] "Go one step of the build forward" => |_, cx| cx.doc.step_build(1);
        "build.last" Everywhere ALT [End] "Go to the finished tree" => |_, cx| cx.doc.go_in_build(u32::MAX);
        "build.play" Everywhere ALT [P] "Play the build, or pause" => |_, cx| cx.doc.play_build(cx.ctx.input(|i| i.time));
        "build.by-node" Everywhere ALT [N] "Step through the build by nodes or by depths" => |_, cx| cx.doc.set_build_by_node(!cx.doc.inspect.build.by_node);
    };

    fn update(&mut self, cx: &mut Cx<'_>) {
        cx.doc.play_build_on(cx.ctx);
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        ui.horizontal_wrapped(|ui| {
            let doc = &mut *cx.doc;
            let mut on = doc.inspect.build.on;
            ui.checkbox(&mut on, "Build steps").on_hover_text(tip(
                "Show the tree as it stood at a moment of its build, in 3D, outline and icicle.",
                "build.show",
            ));
            if on != doc.inspect.build.on {
                doc.toggle_build();
            }
            if !doc.inspect.build.on || doc.current.is_none() {
                return;
            }
            by(ui, doc);
            ui.separator();
            moves(ui, cx);
            let doc = &mut *cx.doc;
            slider(ui, doc);
            let speed = egui::DragValue::new(&mut doc.inspect.build.rate)
                .range(RATES)
                .speed(0.5)
                .max_decimals(1)
                .suffix(" steps/s");
            let speed = ui
                .add(speed)
                .on_hover_text("How fast the build plays, in steps per second.");
            name_widget(ui, &speed, "Speed of the build");
            ui.separator();
            let text = sentence(doc, ui.ctx());
            ui.add(egui::Label::new(&text).truncate())
                .on_hover_text(&text);
        });
    }
}

/// By nodes or by depths.
fn by(ui: &mut egui::Ui, doc: &mut Document) {
    for (by_node, name, about) in [
        (
            true,
            "By node",
            "Node by node in the order of the build, depth first.",
        ),
        (
            false,
            "By depth",
            "Depth by depth, as if all cells of a level had been split together.",
        ),
    ] {
        let chosen = doc.inspect.build.by_node == by_node;
        let label = ui.selectable_label(chosen, name);
        if label.on_hover_text(tip(about, "build.by-node")).clicked() && !chosen {
            doc.set_build_by_node(by_node);
        }
    }
}

fn moves(ui: &mut egui::Ui, cx: &mut Cx<'_>) {
    let doc = &*cx.doc;
    let Some(current) = &doc.current else {
        return;
    };
    let build = &doc.inspect.build;
    let (at, last) = (build.position(), build.last(&current.shown.tree));
    let play = if build.is_playing() {
        "Pause build"
    } else {
        "Play build"
    };
    for (name, about, enabled, action) in [
        (
            "First moment",
            "Back to the root cell alone.",
            at > 0,
            "build.first",
        ),
        (
            "Step back",
            "One step of the build back.",
            at > 0,
            "build.previous",
        ),
        (
            "Step on",
            "One step of the build on.",
            at < last,
            "build.next",
        ),
        (
            "Last moment",
            "On to the finished tree.",
            at < last,
            "build.last",
        ),
        (
            play,
            "Let the build go on by itself, or stop it.",
            last > 0,
            "build.play",
        ),
    ] {
        let button = ui.add_enabled(enabled, egui::Button::new(name));
        if button.on_hover_text(tip(about, action)).clicked() {
            cx.edits.request(Request::Run(action));
        }
    }
}

fn slider(ui: &mut egui::Ui, doc: &mut Document) {
    let Some(current) = &doc.current else {
        return;
    };
    let build = &doc.inspect.build;
    let (at, last) = (build.position(), build.last(&current.shown.tree));
    let mut to = at;
    ui.spacing_mut().slider_width = 200.0;
    let slider = egui::Slider::new(&mut to, 0..=last.max(1)).show_value(false);
    let slider = ui
        .add_enabled(last > 0, slider)
        .on_hover_text("Drag through the build.");
    name_widget(ui, &slider, "Moment of the build");
    if to != at {
        doc.go_in_build(to);
    }
}

/// Where the build stands, and what happens next.
fn sentence(doc: &mut Document, ctx: &egui::Context) -> String {
    let (Some(current), Some(moment)) = (&doc.current, doc.inspect.build.moment()) else {
        return String::new();
    };
    let tree = &current.shown.tree;
    let nodes = tree.nodes().len() as u32;
    match moment {
        Moment::Depth(depth) => {
            let reached = tree.depth_reached();
            format!("built up to depth {depth} of {reached} (D_REACH)")
        }
        Moment::Node(next) if next >= nodes => {
            format!("all {} nodes are decided", grouped(nodes as usize))
        }
        Moment::Node(next) => {
            let [at, of] = [next, nodes].map(|n| grouped(n as usize));
            let what = match (tree.kind(next), tree.plane(next)) {
                (NodeKind::Inner { below, above, .. }, Some((axis, plane))) => {
                    let parts = doc.inspect.index(current, ctx).map(|index| {
                        [below, above].map(|child| grouped(index.of(child).objects as usize))
                    });
                    let parts = parts.map_or(String::new(), |[below, above]| {
                        format!(": {below} objects below, {above} above")
                    });
                    format!("is split at {axis} = {plane:.5}{parts}")
                }
                (NodeKind::Leaf { count, stop, .. }, _) => {
                    let count = grouped(count as usize);
                    format!("becomes a leaf of {count} objects: {}", stop.text())
                }
                _ => String::new(),
            };
            format!("node {at} of {of} {what}")
        }
    }
}
