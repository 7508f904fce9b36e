//! The window without a window: widgets found by their labels, pictures through a software adapter.

use crate::harness::{
    PATIENCE, Window, click, finish, has, is_finished, open, open_pane, open_with_graphics,
    over_picture, press, small, wait,
};
use egui_kittest::SnapshotOptions;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::time::Instant;

/// The figure with this name: below it on a card, or at the right end of its row.
fn figure(window: &Window<'_>, name: &str) -> String {
    let label = window
        .get_all_by_label(name)
        .next()
        .expect("a figure")
        .rect();
    let text = |node: &egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        node.label().or(node.value()).unwrap_or_default()
    };
    let mut values: Vec<(bool, f32, String)> = window
        .query_all_by_label_contains("")
        .filter_map(|node| {
            let rect = node.rect();
            let is_below = (rect.left() - label.left()).abs() < 2.0
                && rect.top() > label.top() + 4.0
                && rect.top() < label.bottom() + 12.0;
            let is_beside = (rect.center().y - label.center().y).abs() < 3.0
                && rect.left() > label.right()
                && !text(&node).contains('_');
            (is_below || is_beside).then(|| (is_below, rect.left(), text(&node)))
        })
        .collect();
    values.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    values.first().expect("a value").2.clone()
}

/// Covers what depends on the machine.
fn masked(window: &mut Window<'_>) -> SnapshotOptions {
    for name in ["Build time", "Render time", "Time spent traversing"] {
        for rect in window
            .query_all_by_label(name)
            .map(|node| node.rect())
            .collect::<Vec<_>>()
        {
            let mut numbers = rect.expand2(egui::vec2(0.0, 6.0));
            (numbers.min.x, numbers.max.x) =
                (rect.right() + 4.0, window.ctx.content_rect().right());
            window.mask(numbers);
            // On a card the value stands below its name.
            let below = egui::vec2(0.0, 60.0);
            window.mask(egui::Rect::from_min_max(
                rect.left_bottom(),
                numbers.max + below,
            ));
        }
    }
    // Other versions of the software driver draw edges a little differently.
    SnapshotOptions::new()
        .threshold(2.0)
        .max_failed_pixels(3000_usize)
}

#[test]
fn opens_a_small_scene_and_finishes() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    assert!(has(&window, "balls:1 · midpoint · depth 20 · leaf size 1"));
    open_pane(&mut window, "Scene");
    assert!(has(&window, "spheres: 10"));
    for symbol in bspscope::measure::DELTA {
        assert!(window.query_by_label(symbol).is_some(), "{symbol}");
    }
    assert_ne!(figure(&window, "Leaves"), "–");
    assert!(figure(&window, "Build time").ends_with('s'));
    // Speed and memory are shown at the right end of the bottom strip.
    window.hover_at(egui::pos2(1400.0, 985.0));
    window.run_steps(60);
    assert!(has(&window, "rays/s") && has(&window, "MiB"));
}

#[test]
fn another_method_changes_figures_and_picture_as_one() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = figure(&window, "Leaves");
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    let start = Instant::now();
    loop {
        // Figures, and the settings named over the picture, always belong to the same method.
        let leaves = figure(&window, "Leaves");
        if has(&window, "balls:1 · midpoint") {
            assert_eq!(leaves, before);
        } else {
            assert!(has(&window, "balls:1 · sah-cut"));
        }
        if is_finished(&window) {
            assert_ne!(leaves, before);
            break;
        }
        assert!(start.elapsed() < PATIENCE);
        window.run_steps(1);
    }
    assert!(has(&window, "balls:1 · sah-cut"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::I);
    assert!(has(&window, "Gap fraction"));
}

#[test]
fn a_method_is_chosen_by_its_list() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    window
        .get_by_role_and_label(egui::accesskit::Role::ComboBox, "Method")
        .click();
    window.run_steps(3);
    window.get_by_label("object-median").click();
    wait(&mut window, "the method", |w| has(w, "· object-median ·"));
    finish(&mut window);
}

#[test]
fn the_kernel_is_chosen_by_its_list_and_named_beside_the_times() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    assert!(has(&window, "Timed kernel: scalar"));
    let tests = figure(&window, "Tests per hit");
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::I);
    window
        .query_all_by_role(egui::accesskit::Role::ComboBox)
        .find(|node| node.value().is_some_and(|v| v == "scalar"))
        .expect("the list of kernels")
        .click();
    window.run_steps(3);
    click(&mut window, "stream");
    wait(&mut window, "the other kernel's times", |w| {
        is_finished(w) && has(w, "Timed kernel: stream")
    });
    assert_eq!(figure(&window, "Tests per hit"), tests);
}

#[test]
fn depth_and_leaf_size_follow_their_keys() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = figure(&window, "Leaves");
    for _ in 0..14 {
        press(&mut window, egui::Modifiers::COMMAND, egui::Key::ArrowDown);
    }
    wait(&mut window, "depth 6", |w| has(w, "· depth 6 ·"));
    finish(&mut window);
    assert_ne!(figure(&window, "Leaves"), before);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::ArrowRight);
    wait(&mut window, "leaf size 2", |w| has(w, "· leaf size 2 ·"));
    window.get_by_label("Auto").click();
    wait(&mut window, "automatic", |w| has(w, "(automatic)"));
    finish(&mut window);
}

#[test]
fn a_load_that_fails_keeps_the_scene_and_says_why() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = figure(&window, "Leaves");
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::L);
    window.run_steps(3);
    let field = window.get_by_role_and_label(egui::accesskit::Role::TextInput, "Path of a scene");
    field.focus();
    field.type_text("/there/is/no.nff");
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the message", |w| {
        has(w, "could not be opened")
    });
    assert!(has(&window, "Reason: /there/is/no.nff"));
    finish(&mut window);
    assert!(has(&window, "balls:1 · midpoint"));
    assert_eq!(figure(&window, "Leaves"), before);
    window.get_by_label("Dismiss").click();
    window.run_steps(3);
    assert!(!has(&window, "could not be opened"));
    // Later changes are changes of the scene that stayed.
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    wait(&mut window, "the method", |w| has(w, "balls:1 · sah-cut"));
}

#[test]
fn a_file_with_a_mistake_is_told_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wrong.nff");
    std::fs::write(&file, "b 0 0 0\nnonsense\n").unwrap();
    let mut window = open(small(file.to_str().unwrap()));
    wait(&mut window, "the message", |w| {
        has(w, "could not be opened")
    });
    assert!(has(&window, "wrong.nff:2"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num2);
    assert!(has(&window, "No picture yet"));
}

/// A file as the window system drops it.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &std::path::Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn a_dropped_file_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("one-ball.nff");
    let text = "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 32 32\n\
                b 0 0 0\nl 5 -5 5\nf 1 0 0 1 0 0 0 1\ns 0 0 0 1\n";
    std::fs::write(&file, text).unwrap();
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let dropped = std::sync::Arc::new(Dropped(file));
    window.input_mut().dropped_files.push(dropped);
    wait(&mut window, "the file's scene", |w| {
        has(w, "one-ball · midpoint")
    });
    finish(&mut window);
    open_pane(&mut window, "Scene");
    assert!(has(&window, "spheres: 1"));
}

#[test]
fn a_click_names_the_object_and_lists_the_leaves() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num2);
    assert!(has(&window, "Click a pixel of the picture"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num1);
    window.get_by_label("Traced picture").click();
    wait(&mut window, "the object", |w| has(w, "Hits sphere "));
    assert!(has(&window, "at a distance of"));
    assert!(has(&window, "Kd "));
    assert!(has(&window, "The primary ray visits"));
    // Arrow keys go on to other pixels while the pointer is over the picture.
    assert!(has(&window, "Pixel 24, 24"));
    over_picture(&mut window);
    press(&mut window, egui::Modifiers::NONE, egui::Key::ArrowLeft);
    wait(&mut window, "the pixel beside", |w| has(w, "Pixel 23, 24"));
    // The pixel stays picked in another tree.
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    wait(&mut window, "the method", |w| has(w, "balls:1 · sah-cut"));
    wait(&mut window, "its rays", |w| has(w, "Pixel 23, 24"));
}

#[test]
fn changes_of_settings_are_undone_and_redone() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = figure(&window, "Leaves");
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    finish(&mut window);
    let after = figure(&window, "Leaves");
    assert_ne!(before, after);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    finish(&mut window);
    assert_eq!(figure(&window, "Leaves"), before);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Y);
    finish(&mut window);
    assert_eq!(figure(&window, "Leaves"), after);
}

#[test]
fn undo_says_what_comes_back_and_an_empty_scene_is_told() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    assert!(!has(&window, "has no objects"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::ArrowDown);
    window.run_steps(60);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
    assert!(has(&window, " 19 back to 20"));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("nothing.nff");
    let text =
        "v\nfrom 0 -4 0\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 32 32\nb 0 0 0\n";
    std::fs::write(&file, text).unwrap();
    let dropped = std::sync::Arc::new(Dropped(file));
    window.input_mut().dropped_files.push(dropped);
    wait(&mut window, "the empty scene", |w| {
        has(w, "nothing has no objects")
    });
}

#[test]
fn the_list_of_shortcuts_opens_and_closes() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    window.key_press(egui::Key::Questionmark);
    window.run_steps(4);
    assert!(has(&window, "Frame the selection"));
    window.key_press(egui::Key::Escape);
    window.run_steps(4);
    assert!(!has(&window, "Frame the selection"));
}

#[test]
fn cancelling_stops_and_resuming_finishes() {
    let mut start = small("balls:4");
    start.setup.render.width = 1024;
    start.setup.render.height = 1024;
    start.setup.render.samples = 500;
    let mut window = open(start);
    wait(&mut window, "a picture", |w| has(w, "balls:4 · midpoint"));
    window.key_press(egui::Key::Escape);
    wait(&mut window, "the stop", |w| has(w, "Stopped"));
    assert!(has(&window, "balls:4 · midpoint"), "what is shown stays");
    assert!(!is_finished(&window));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::R);
    wait(&mut window, "new work", |w| !has(w, "Stopped"));
}

#[test]
fn without_graphics_all_but_the_3d_view_works() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    assert!(window.query_by_label("3D view of scene and tree").is_some());
}

#[test]
fn keys_of_the_3d_view_count_while_the_pointer_is_over_it() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    // Elsewhere they do nothing.
    press(&mut window, egui::Modifiers::NONE, egui::Key::B);
    assert!(!has(&window, "Leaf boxes are not shown"));
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.center());
    window.run_steps(2);
    press(&mut window, egui::Modifiers::NONE, egui::Key::B);
    assert!(has(&window, "Leaf boxes are not shown"));
    press(&mut window, egui::Modifiers::NONE, egui::Key::B);
    press(&mut window, egui::Modifiers::NONE, egui::Key::C);
    assert!(has(&window, "Objects (objects in a leaf)"));
    press(&mut window, egui::Modifiers::NONE, egui::Key::C);
    assert!(has(&window, "Leaves by emptiness"));
    for key in [egui::Key::Num7, egui::Key::Num5, egui::Key::Home] {
        press(&mut window, egui::Modifiers::NONE, key);
    }
    assert!(has(&window, "the picture's camera"));
    // The view has a camera of its own: the picture stays as it is.
    assert!(is_finished(&window));
    let options = masked(&mut window);
    window.snapshot_options("from_above", &options);
}

/// How the whole window looks, with boxes and the leaves of one ray. Numbers that depend on the
/// machine are covered.
#[test]
fn the_window_looks_as_it_did() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    window.get_by_label("Traced picture").click();
    wait(&mut window, "the object", |w| has(w, "Hits sphere "));
    wait(&mut window, "the boxes", |w| {
        has(w, "Leaves visited by the selected ray")
    });
    window.remove_cursor();
    window.run_steps(5);
    let options = masked(&mut window);
    window.snapshot_options("window", &options);
}
