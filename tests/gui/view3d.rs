//! What the 3D view shows, what its legend says of it, and whose camera it moves.

use crate::harness::{
    Window, click, finish, grouped, has, open_sized, open_with_graphics, press, small, wait,
};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::{Moment, Tree, build};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

fn tree() -> Tree {
    let start = small("balls:1");
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    build(&scene, &start.setup.build, &progress).unwrap()
}

fn leaves(tree: &Tree) -> String {
    grouped(tree.nodes().len() / 2 + 1)
}

/// Moves the pointer over the view, beside its legend.
fn over_view(window: &mut Window<'_>) {
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.right_top() + egui::vec2(-4.0, 4.0));
    window.run_steps(2);
}

#[test]
fn cells_are_shown_to_depth_6_at_first() {
    let tree = tree();
    let (leaves, mut window) = (leaves(&tree), open_with_graphics(small("balls:1")));
    finish(&mut window);
    assert!(tree.depth_reached() > 6);
    let cells: Vec<_> = tree.cells_at(Moment::Depth(6)).collect();
    let split = cells.iter().filter(|(_, decided)| !decided).count();
    let others = cells.len() - split;
    assert!(split > 0 && cells.len() <= 64);
    let text =
        format!("{split} cells at depth 6 that are split further, {others} of {leaves} leaves");
    assert!(has(&window, &text), "{text}");
    click(&mut window, "Cells");
    click(&mut window, "All leaves");
    assert!(has(&window, &format!("{leaves} of {leaves} leaves shown")));
    click(&mut window, "None");
    assert!(has(&window, "Leaf boxes are not shown"));
    click(&mut window, "To depth");
    assert!(has(&window, &text), "{text}");
}

#[test]
fn the_legend_says_what_is_drawn() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    over_view(&mut window);
    // Without a ray there are no leaves that it visited: cells are drawn as at first.
    press(&mut window, Modifiers::NONE, Key::V);
    assert!(!has(&window, "Leaf boxes are not shown"));
    assert!(has(&window, "cells at depth 6"));
    assert!(has(&window, "Depth (levels"));
    press(&mut window, Modifiers::COMMAND, Key::Num2);
    window.get_by_label("Traced picture").click();
    wait(&mut window, "the ray", |w| {
        has(w, "Leaves visited by the selected ray")
    });
    assert!(!has(&window, "leaves shown") && !has(&window, "Leaf boxes are not shown"));
}

#[test]
fn filters_say_how_many_leaves_are_shown() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    let leaves = leaves(&tree());
    over_view(&mut window);
    press(&mut window, Modifiers::NONE, Key::X);
    assert!(has(&window, &format!("{leaves} of {leaves} leaves shown")));
    click(&mut window, "Cells");
    window.get_by_label("Empty (dashed)").click();
    window.run_steps(3);
    assert!(!has(&window, &format!("{leaves} of {leaves} leaves shown")));
    assert!(has(&window, &format!("of {leaves} leaves shown")));
    window.get_by_label("Full (solid)").click();
    window.run_steps(3);
    assert!(has(&window, &format!("0 of {leaves} leaves shown")));
    window.get_by_label("None").click();
    window.run_steps(3);
    assert!(has(&window, "Leaf boxes are not shown"));
}

#[test]
fn in_a_small_view_the_legend_is_folded_until_it_is_asked_for() {
    let mut window = open_sized(small("balls:1"), [1280.0, 720.0], true);
    finish(&mut window);
    wait(&mut window, "the colors", |w| has(w, "Depth (levels"));
    let unfolded = |w: &Window<'_>| has(w, "leaves shown");
    if unfolded(&window) {
        click(&mut window, "Fold the legend");
    }
    assert!(!unfolded(&window));
    click(&mut window, "Unfold the legend");
    assert!(unfolded(&window));
    let view = window.get_by_label("3D view of scene and tree").rect();
    let top = window.get_by_label("Fold the legend").rect();
    assert!(view.contains_rect(top), "{top} in {view}");
    over_view(&mut window);
    press(&mut window, Modifiers::NONE, Key::I);
    assert!(!unfolded(&window) && has(&window, "Depth (levels"));
}

fn orbit(window: &mut Window<'_>) {
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.drag_at(view.center());
    window.run_steps(2);
    window.hover_at(view.center() + egui::vec2(60.0, 10.0));
    window.run_steps(2);
    window.drop_at(view.center() + egui::vec2(60.0, 10.0));
    window.run_steps(1);
}

#[test]
fn orbiting_renders_the_picture_again_only_with_the_same_camera() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    orbit(&mut window);
    assert!(window.state().is_finished());
    assert!(has(&window, "the picture's camera"));
    window.run_steps(5);
    assert!(window.state().is_finished());
    click(&mut window, "Same camera");
    assert!(!has(&window, "the picture's camera"), "it went to that one");
    orbit(&mut window);
    assert!(!window.state().is_finished());
    finish(&mut window);
    // Undone, the view returns with the picture.
    assert!(!has(&window, "the picture's camera"));
}
