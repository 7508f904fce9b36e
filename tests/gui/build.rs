//! The build of the tree step by step, and the cut through the 3D view, found by labels.

use crate::harness::{Window, click, finish, grouped, has, open_sized, press, small, wait};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::{Moment, NodeKind, Tree, TreeIndex, build};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// The tree on view, and facts of its nodes.
fn expected() -> (Tree, TreeIndex) {
    let start = small("balls:1");
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    let tree = build(&scene, &start.setup.build, &progress).unwrap();
    let index = TreeIndex::new(&tree, scene.objects().len());
    (tree, index)
}

fn open<'a>() -> Window<'a> {
    let mut window = open_sized(small("balls:1"), [1600.0, 1100.0], true);
    finish(&mut window);
    // All leaves, of the finished tree, too.
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.right_top() + egui::vec2(-20.0, 20.0));
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::X);
    window
}

/// What the 3D view says of a moment of the build.
fn check_boxes(window: &mut Window<'_>, tree: &Tree, moment: Moment) {
    let cells: Vec<_> = tree.cells_at(moment).collect();
    let undecided = cells.iter().filter(|(_, decided)| !decided).count();
    let [shown, leaves] = [cells.len() - undecided, tree.nodes().len() / 2 + 1].map(grouped);
    let shown = format!("{shown} of {leaves} leaves shown");
    wait(window, &shown, |w| has(w, &shown));
    let cells = if undecided == 1 { "cell" } else { "cells" };
    let dotted = format!("dotted white: {undecided} {cells} not decided yet");
    assert_eq!(has(window, &dotted), undecided > 0, "{dotted}");
}

#[test]
fn every_step_of_the_build_shows_the_node_that_is_decided() {
    let (tree, index) = expected();
    let mut window = open();
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    for node in 0..6 {
        let nodes = grouped(tree.nodes().len());
        let says = match tree.kind(node) {
            NodeKind::Inner => {
                let (axis, plane) = tree.plane(node).unwrap();
                let children = tree.child_nodes(node);
                let held: Vec<u32> = children.map(|child| index.of(child).objects).collect();
                let [below, above] = held[..] else {
                    panic!("an inner node of planes has two children");
                };
                format!(
                    "node {node} of {nodes} is split at {axis} = {plane:.5}: {below} objects \
                     below, {above} above"
                )
            }
            NodeKind::Leaf { count, stop, .. } => format!(
                "node {node} of {nodes} becomes a leaf of {count} objects: {}",
                stop.text()
            ),
        };
        assert!(has(&window, &says), "{says}");
        assert!(has(&window, &format!("thick box: selected node {node}, ")));
        check_boxes(&mut window, &tree, Moment::Node(node));
        press(&mut window, Modifiers::ALT, Key::ArrowRight);
    }
    press(&mut window, Modifiers::ALT, Key::ArrowLeft);
    check_boxes(&mut window, &tree, Moment::Node(5));
    // The slider is found by its name, and leads anywhere.
    let slider = window.get_by_label("Moment of the build").rect();
    window.drag_at(slider.left_center());
    window.drop_at(slider.left_center());
    window.run_steps(4);
    check_boxes(&mut window, &tree, Moment::Node(0));
    click(&mut window, "Last moment");
    assert!(has(&window, "nodes are decided"));
    check_boxes(&mut window, &tree, Moment::Depth(u32::MAX));
    click(&mut window, "First moment");
    check_boxes(&mut window, &tree, Moment::Node(0));
    click(&mut window, "Step through the build");
    check_boxes(&mut window, &tree, Moment::Depth(u32::MAX));
    assert!(!has(&window, "Play build"));
}

#[test]
fn the_outline_has_no_nodes_of_later_steps() {
    let (tree, _) = expected();
    let mut window = open();
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    click(&mut window, "Outline");
    let row = |w: &Window<'_>, node: u32| w.query_by_label(&format!("node {node}")).is_some();
    let mut inner = 0;
    for node in 0..6 {
        wait(&mut window, "the node", |w| row(w, node));
        assert!(has(&window, "not decided yet"));
        if let Some(below) = tree.child_nodes(node).next() {
            assert!(!row(&window, below));
            inner += 1;
        }
        press(&mut window, Modifiers::ALT, Key::ArrowRight);
    }
    assert!(inner > 0);
}

#[test]
fn the_build_goes_on_depth_by_depth_to_the_finished_tree() {
    let (tree, _) = expected();
    let mut window = open();
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    click(&mut window, "By depth");
    let reached = tree.depth_reached();
    for depth in 0..=reached {
        assert!(has(
            &window,
            &format!("built up to depth {depth} of {reached} (D_REACH)")
        ));
        check_boxes(&mut window, &tree, Moment::Depth(depth));
        press(&mut window, Modifiers::ALT, Key::ArrowRight);
    }
    assert!(
        window
            .get_by_label("Step forward")
            .accesskit_node()
            .is_disabled()
    );
}

#[test]
fn the_build_plays_to_its_end_and_stops() {
    let (tree, _) = expected();
    let mut window = open();
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    click(&mut window, "By depth");
    click(&mut window, "Play build");
    assert!(has(&window, "Pause build"));
    wait(&mut window, "the end", |w| has(w, "Play build"));
    let reached = tree.depth_reached();
    assert!(has(&window, &format!("built up to depth {reached} of")));
}

#[test]
fn a_cut_hides_one_side_of_the_view() {
    let mut window = open();
    let view = window.get_by_label("3D view of scene and tree").rect();
    // A place without widgets over the view.
    window.hover_at(view.right_top() + egui::vec2(-20.0, 80.0));
    window.run_steps(2);
    let picture = |window: &mut Window<'_>| {
        let image = window.render().unwrap();
        // Below the controls of the cut, above the legend, and to the left of the pointer.
        let (left, top) = (view.left() as u32 + 2, view.top() as u32 + 70);
        let (width, height) = (view.width() as u32 - 60, view.height() as u32 / 3);
        image::imageops::crop_imm(&image, left, top, width, height).to_image()
    };
    let whole = picture(&mut window);
    window.key_press(Key::T);
    window.run_steps(3);
    assert!(has(&window, "cut at x = "));
    assert!(has(&window, "greater x is hidden"));
    let one_side = picture(&mut window);
    window.key_press(Key::U);
    window.run_steps(3);
    assert!(has(&window, "less x is hidden"));
    let other_side = picture(&mut window);
    assert!(other_side != one_side);
    window.key_press(Key::Y);
    window.run_steps(3);
    assert!(has(&window, "cut at y = "));
    click(&mut window, "More about the 3D view");
    assert!(window.query_by_label("Place of the cut").is_some());
    click(&mut window, "More about the 3D view");
    window.hover_at(view.right_top() + egui::vec2(-20.0, 20.0));
    window.run_steps(2);
    let before = cut_text(&window);
    window.key_press(Key::CloseBracket);
    window.run_steps(3);
    assert_ne!(cut_text(&window), before);
    window.key_press(Key::T);
    window.run_steps(3);
    assert!(!has(&window, "cut at"));
    assert!(picture(&mut window) == whole);
}

/// Where the legend says that the view is cut.
fn cut_text(window: &Window<'_>) -> String {
    let node = window.get_by_label_contains("cut at ");
    let node = node.accesskit_node();
    node.label().or(node.value()).unwrap_or_default()
}

#[test]
fn the_icicle_shows_the_nodes_of_the_moment() {
    let mut window = open();
    click(&mut window, "Icicle");
    let drawn = |w: &Window<'_>| {
        let mut labels = w.query_all_by_label_contains("nodes drawn");
        labels.next().and_then(|node| {
            let text = node.accesskit_node().label().or(node.value())?;
            text.split(' ').next()?.parse::<u32>().ok()
        })
    };
    wait(&mut window, "the icicle", |w| drawn(w).is_some());
    assert!(drawn(&window) > Some(3));
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    click(&mut window, "Icicle");
    assert_eq!(drawn(&window), Some(1));
    press(&mut window, Modifiers::ALT, Key::ArrowRight);
    window.run_steps(2);
    assert_eq!(drawn(&window), Some(3));
}
