//! The bar that goes through the build of the tree, and says what the current step does.

use super::build_view::RATES;
use super::name_widget;
use super::shortcuts::{Action, tip};
use super::state::State;
use super::symbol::grouped;
use crate::structure::{Moment, NodeKind};

/// The switch that shows the bar.
pub fn switch(ui: &mut egui::Ui, state: &mut State) {
    let mut on = state.inspect.build.on;
    ui.checkbox(&mut on, "Build steps").on_hover_text(tip(
        "Show the tree as it stood at a moment of its build, in 3D, outline and icicle.",
        Action::ShowBuild,
    ));
    if on != state.inspect.build.on {
        state.toggle_build();
    }
}

/// Shows the bar while the build is gone through.
pub fn show(ui: &mut egui::Ui, state: &mut State) {
    state.play_build_on(ui.ctx());
    if !state.inspect.build.on || state.current.is_none() {
        return;
    }
    egui::Panel::bottom("build bar").show(ui, |ui| {
        ui.horizontal(|ui| {
            by(ui, state);
            ui.separator();
            moves(ui, state);
            slider(ui, state);
            let speed = egui::DragValue::new(&mut state.inspect.build.rate)
                .range(RATES)
                .speed(0.5)
                .max_decimals(1)
                .suffix(" steps/s");
            let speed = ui
                .add(speed)
                .on_hover_text("How fast the build plays, in steps a second.");
            name_widget(ui, &speed, "Speed of the build");
            ui.separator();
            let text = sentence(state, ui.ctx());
            ui.add(egui::Label::new(&text).truncate())
                .on_hover_text(&text);
        });
    });
}

/// Does what a key asks for.
pub fn act(action: Action, state: &mut State, now: f64) {
    if action == Action::ShowBuild {
        state.toggle_build();
    }
    if !state.inspect.build.on {
        return;
    }
    match action {
        Action::BuildFirst => state.go_in_build(0),
        Action::BuildPrevious => state.step_build(-1),
        Action::BuildNext => state.step_build(1),
        Action::BuildLast => state.go_in_build(u32::MAX),
        Action::PlayBuild => state.play_build(now),
        Action::BuildByNode => state.set_build_by_node(!state.inspect.build.by_node),
        _ => {}
    }
}

/// By nodes or by depths.
fn by(ui: &mut egui::Ui, state: &mut State) {
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
        let chosen = state.inspect.build.by_node == by_node;
        let label = ui.selectable_label(chosen, name);
        if label
            .on_hover_text(tip(about, Action::BuildByNode))
            .clicked()
            && !chosen
        {
            state.set_build_by_node(by_node);
        }
    }
}

fn moves(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        return;
    };
    let build = &state.inspect.build;
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
            Action::BuildFirst,
        ),
        (
            "Step back",
            "One step of the build back.",
            at > 0,
            Action::BuildPrevious,
        ),
        (
            "Step on",
            "One step of the build on.",
            at < last,
            Action::BuildNext,
        ),
        (
            "Last moment",
            "On to the finished tree.",
            at < last,
            Action::BuildLast,
        ),
        (
            play,
            "Let the build go on by itself, or stop it.",
            last > 0,
            Action::PlayBuild,
        ),
    ] {
        let button = ui.add_enabled(enabled, egui::Button::new(name));
        if button.on_hover_text(tip(about, action)).clicked() {
            act(action, state, ui.input(|i| i.time));
        }
    }
}

fn slider(ui: &mut egui::Ui, state: &mut State) {
    let Some(current) = &state.current else {
        return;
    };
    let build = &state.inspect.build;
    let (at, last) = (build.position(), build.last(&current.shown.tree));
    let mut to = at;
    ui.spacing_mut().slider_width = 200.0;
    let slider = egui::Slider::new(&mut to, 0..=last.max(1)).show_value(false);
    let slider = ui
        .add_enabled(last > 0, slider)
        .on_hover_text("Drag through the build.");
    name_widget(ui, &slider, "Moment of the build");
    if to != at {
        state.go_in_build(to);
    }
}

/// Where the build stands, and what happens next.
fn sentence(state: &mut State, ctx: &egui::Context) -> String {
    let (Some(current), Some(moment)) = (&state.current, state.inspect.build.moment()) else {
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
                    let parts = state.inspect.index(current, ctx).map(|index| {
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
