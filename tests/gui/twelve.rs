//! Twelve things that people want to do, each within its number of clicks, drags, keys and entries.

use crate::harness::{SIZE, Window, click, finish, has, open_sized, press, small, wait, wait_for};
use bspscope::gui::StartOptions;
use bspscope::lesson::LESSONS;
use bspscope::structure::MaxDepth;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

/// A finished picture of balls in a large window.
fn ready<'a>() -> Window<'a> {
    let mut window = open_sized(small("balls:1"), [1600.0, 1000.0], false);
    finish(&mut window);
    window
}

/// Types an entry and confirms it.
fn enter(window: &mut Window<'_>, field: &str, text: &str) {
    let field = |window: &Window<'_>, act: &dyn Fn(&egui_kittest::Node<'_>)| {
        act(&window.get_by_role_and_label(Role::TextInput, field));
    };
    field(window, &|node| node.focus());
    window.run_steps(2);
    press(window, Modifiers::COMMAND, Key::A);
    field(window, &|node| node.type_text(text));
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
}

#[test]
fn the_tour_starts_with_one_click() {
    let folder = tempfile::tempdir().unwrap();
    let start = StartOptions {
        remember: true,
        settings_folder: Some(folder.path().to_owned()),
        ..small("balls:1")
    };
    let mut window = open_sized(start, [1280.0, 720.0], false);
    window.run_steps(3);
    click(&mut window, "Take the tour");
    wait_for(&mut window, &LESSONS[0].read().steps[0].title);
}

#[test]
fn another_method_shows_its_effect_after_two_clicks() {
    let mut window = ready();
    let method = window.state().setup().build.method;
    let list = window.get_by_role_and_label(Role::ComboBox, "Method");
    list.click();
    window.run_steps(3);
    click(&mut window, "sah-cut");
    finish(&mut window);
    assert_ne!(window.state().setup().build.method, method);
    assert!(has(&window, "fewer, was") || has(&window, "more, was"));
}

#[test]
fn a_depth_is_set_with_one_entry() {
    let mut window = ready();
    window
        .get_by_role_and_label(Role::SpinButton, "Depth")
        .set_value_accesskit(12.0);
    window.run_steps(3);
    assert_eq!(window.state().setup().build.d_max, MaxDepth::Fixed(12));
}

#[test]
fn a_click_names_what_a_pixel_hits() {
    let mut window = ready();
    window.get_by_label("Traced picture").click();
    wait_for(&mut window, "Hits sphere");
}

#[test]
fn the_first_leaf_of_the_costliest_pixel_is_four_actions_away() {
    let mut window = ready();
    let middle = window.get_by_label("Traced picture").rect().center();
    window.hover_at(middle);
    window.run_steps(2);
    // The next heatmap, its costliest pixel, the steps of its ray, leaves only.
    press(&mut window, Modifiers::NONE, Key::H);
    window.run_steps(20);
    press(&mut window, Modifiers::NONE, Key::N);
    window.run_steps(20);
    press(&mut window, Modifiers::COMMAND, Key::Num2);
    press(&mut window, Modifiers::NONE, Key::K);
    wait(&mut window, "a leaf's step", |w| has(w, ": leaf "));
}

#[test]
fn a_heatmap_of_tests_is_two_clicks_away() {
    let mut window = ready();
    click(&mut window, "Show");
    window.get_by_label_contains("N_IT · ").click();
    window.run_steps(3);
    wait_for(&mut window, "tests");
}

#[test]
fn two_methods_stand_side_by_side_after_one_key() {
    let mut window = ready();
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    finish(&mut window);
    for side in ["A", "B"] {
        window.get_by_label(&format!("Build method of {side}"));
    }
    wait_for(&mut window, "Fair comparison");
}

#[test]
fn an_unfair_comparison_becomes_fair_with_one_click() {
    let mut window = ready();
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::PageDown);
    finish(&mut window);
    wait_for(&mut window, "Not comparable");
    click(&mut window, "Use same conditions");
    finish(&mut window);
    wait_for(&mut window, "Fair comparison");
}

#[test]
fn an_obj_file_gets_its_best_tree_in_five_actions() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.obj");
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
    std::fs::write(&file, mesh).unwrap();
    let mut window = ready();
    press(&mut window, Modifiers::COMMAND, Key::L);
    window.run_steps(3);
    enter(&mut window, "Path of a scene", &file.to_string_lossy());
    finish(&mut window);
    assert!(
        window
            .state()
            .setup()
            .scene
            .source
            .to_string()
            .ends_with("mine.obj")
    );
    press(&mut window, Modifiers::COMMAND, Key::Num4);
    click(&mut window, "Find the best tree");
    wait(&mut window, "the end", |w| {
        w.query_by_label("Stop").is_none() && has(w, "Use this: ")
    });
    let before = window.state().setup().build.clone();
    let button = window.query_all_by_label_contains("Use this: ").next();
    button.expect("a row").click_accesskit();
    window.run_steps(3);
    assert_ne!(window.state().setup().build, before);
}

#[test]
fn the_command_is_copied_with_one_key() {
    let mut window = ready();
    let events = [true, false].map(|pressed| egui::Event::Key {
        key: Key::C,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::COMMAND | Modifiers::SHIFT,
    });
    window.input_mut().events.extend(events);
    let copied = (0..3).find_map(|_| {
        window.step();
        let commands = &window.output().platform_output.commands;
        commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
    });
    let copied = copied.expect("a command");
    assert!(copied.starts_with("bspscope measure balls:1"), "{copied}");
    assert!(copied.contains(&format!("{SIZE}x{SIZE}")), "{copied}");
    // It is said only once the system has it.
    assert!(!has(&window, "Copied"));
    window.event(egui::Event::Paste(copied));
    window.run_steps(2);
    assert!(has(&window, "Copied: bspscope measure balls:1"));
}

#[test]
fn a_maximized_picture_is_presented_with_two_keys() {
    let mut window = ready();
    let before = window.get_by_label("Traced picture").rect();
    window.hover_at(before.center());
    window.run_steps(2);
    press(&mut window, Modifiers::NONE, Key::Z);
    press(&mut window, Modifiers::NONE, Key::F11);
    window.run_steps(6);
    let after = window.get_by_label("Traced picture").rect();
    let share = after.area() / window.ctx.content_rect().area();
    assert!(share > 0.5, "{share}");
}

#[test]
fn a_workspace_of_another_scene_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("first.bspscope");
    let mut window = ready();
    press(&mut window, Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    enter(&mut window, "Path to save to", &file.to_string_lossy());
    wait(&mut window, "the file", |_| file.exists());
    let saved = std::fs::read(&file).unwrap();
    press(&mut window, Modifiers::COMMAND, Key::L);
    window.run_steps(3);
    enter(&mut window, "Path of a scene", "tetra:1");
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    window.run_steps(3);
    assert!(
        window.query_by_label("Path to save to").is_some(),
        "it asks"
    );
    assert_eq!(std::fs::read(&file).unwrap(), saved);
}
