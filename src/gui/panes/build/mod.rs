//! The build of the tree, step by step: buttons, and a sentence about the current step.

use crate::geometry::Aabb;
use crate::gui::action::{actions, tip};
use crate::gui::document::Document;
use crate::gui::document::RATES;
use crate::gui::edits::{Edits, Request};
use crate::gui::pane::{Cx, Fact, Pane, PaneAction};
use crate::gui::widgets::common::name_widget;
use crate::gui::widgets::symbol::grouped;
use crate::gui::widgets::transport::{self, Button, Transport};
use crate::present::number::Digits;
use crate::present::overlay::overlap_share;
use crate::structure::{Moment, NodeKind, Tree};

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
            if !cx.doc.inspect.build.on {
                cx.edits.request(Request::Show(Self::ID));
            }
            cx.edits.add(Document::toggle_build);
        };
        "build.first" Everywhere ALT [Home] "Go to the first moment of the build" => |_, cx| cx.edits.add(|doc| doc.go_in_build(0));
        "build.previous" Everywhere ALT [ArrowLeft] "Go one step of the build back" => |_, cx| cx.edits.add(|doc| doc.step_build(-1));
        "build.next" Everywhere ALT [ArrowRight] "Go one step of the build forward" => |_, cx| cx.edits.add(|doc| doc.step_build(1));
        "build.last" Everywhere ALT [End] "Go to the finished tree" => |_, cx| cx.edits.add(|doc| doc.go_in_build(u32::MAX));
        "build.play" Everywhere ALT [P] "Play the build, or pause" => |_, cx| {
            let now = cx.ctx.input(|i| i.time);
            cx.edits.add(move |doc| doc.play_build(now));
        };
        "build.by-node" Everywhere ALT [N] "Step through the build by nodes or by depths" => |_, cx| cx.edits.add(|doc| doc.set_build_by_node(!doc.inspect.build.by_node));
    };

    fn update(&mut self, cx: &mut Cx<'_>) {
        if cx.doc.inspect.build.is_playing() {
            let ctx = cx.ctx.clone();
            cx.edits.add(move |doc| doc.play_build_on(&ctx));
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        ui.horizontal(|ui| {
            ui.set_min_height(transport::HEIGHT);
            let mut on = doc.inspect.build.on;
            let check = ui.checkbox(&mut on, "Step through the build").on_hover_text(tip(
                "Show the tree as it stood at a moment of its build, in 3D, outline and icicle.",
                "build.show",
            ));
            if check.changed() {
                cx.edits.add(Document::toggle_build);
            }
            let Some(current) = &doc.current else {
                return;
            };
            let build = &doc.inspect.build;
            if !build.on {
                return;
            }
            by(ui, doc, cx.edits);
            let (at, last) = (build.position(), build.last(&current.shown.tree));
            ui.scope(|ui| {
                if let Some(action) = moves(build.is_playing(), at, last).show(ui) {
                    cx.edits.request(Request::Run(action));
                }
            });
            slider(ui, at, last, cx.edits);
            speed(ui, build.rate, cx.edits);
        });
        if doc.inspect.build.on {
            let text = sentence(doc, ui.ctx());
            ui.add(egui::Label::new(&text).truncate())
                .on_hover_text(&text);
        }
    }
}

/// By nodes or by depths.
fn by(ui: &mut egui::Ui, doc: &Document, edits: &mut Edits) {
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
        let is_chosen = doc.inspect.build.by_node == by_node;
        let label = ui.selectable_label(is_chosen, name);
        if label.on_hover_text(tip(about, "build.by-node")).clicked() && !is_chosen {
            edits.add(move |doc| doc.set_build_by_node(by_node));
        }
    }
}

fn moves(is_playing: bool, at: u32, last: u32) -> Transport {
    Transport {
        first: Button {
            name: "First moment",
            about: "Go back to the root cell alone.",
            action: "build.first",
            enabled: at > 0,
        },
        previous: Button {
            name: "Step back",
            about: "Go one step of the build back.",
            action: "build.previous",
            enabled: at > 0,
        },
        play: Button {
            name: if is_playing {
                "Pause build"
            } else {
                "Play build"
            },
            about: "Play the build, or pause.",
            action: "build.play",
            enabled: last > 0,
        },
        next: Button {
            name: "Step forward",
            about: "Go one step of the build forward.",
            action: "build.next",
            enabled: at < last,
        },
        last: Button {
            name: "Last moment",
            about: "Go to the finished tree.",
            action: "build.last",
            enabled: at < last,
        },
        is_playing,
    }
}

fn slider(ui: &mut egui::Ui, at: u32, last: u32, edits: &mut Edits) {
    let mut to = at;
    ui.spacing_mut().slider_width = 200.0;
    let slider = egui::Slider::new(&mut to, 0..=last.max(1)).show_value(false);
    let slider = ui
        .add_enabled(last > 0, slider)
        .on_hover_text("Drag through the build.");
    name_widget(ui, &slider, "Moment of the build");
    if to != at {
        edits.add(move |doc| doc.go_in_build(to));
    }
}

fn speed(ui: &mut egui::Ui, rate: f64, edits: &mut Edits) {
    let mut new = rate;
    let speed = egui::DragValue::new(&mut new)
        .range(RATES)
        .speed(0.5)
        .max_decimals(1)
        .suffix(" steps per second");
    let speed = ui.add(speed).on_hover_text("How fast the build is played.");
    name_widget(ui, &speed, "Speed of the build");
    if new != rate {
        edits.add(move |doc| doc.inspect.build.rate = new);
    }
}

/// Where the build stands, and what happens next.
fn sentence(doc: &Document, ctx: &egui::Context) -> String {
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
                (NodeKind::Inner, plane) => {
                    let index = doc.inspect.index(current, ctx);
                    let parts: Option<Vec<String>> = index.map(|index| {
                        let children = tree.child_nodes(next);
                        children
                            .map(|child| grouped(index.of(child).objects as usize))
                            .collect()
                    });
                    match (plane, parts.as_deref()) {
                        (Some((axis, plane)), Some([below, above])) => format!(
                            "is split at {axis} = {plane:.5}: {below} objects below, {above} above"
                        ),
                        (Some((axis, plane)), _) => format!("is split at {axis} = {plane:.5}"),
                        (None, Some(parts)) => format!(
                            "is divided into boxes of {} objects{}",
                            parts.join(" + "),
                            overlap(tree, next)
                        ),
                        (None, None) => "is divided".to_owned(),
                    }
                }
                (NodeKind::Leaf { count, stop, .. }, _) => {
                    let count = grouped(count as usize);
                    format!("becomes a leaf of {count} objects: {}", stop.text())
                }
            };
            format!("node {at} of {of} {what}")
        }
    }
}

/// How much the boxes of a node's children overlap, to end a sentence.
fn overlap(tree: &Tree, node: u32) -> String {
    let cell = tree.cell_of(node);
    let boxes: Vec<Aabb> = tree.children(&cell).map(|child| child.bounds).collect();
    match overlap_share(&cell.bounds, &boxes) {
        Some(share) if share > 0.0 => format!(
            ", which overlap in {} of its volume",
            Digits::Three.percent(share)
        ),
        Some(_) => ", which do not overlap".to_owned(),
        None => String::new(),
    }
}
