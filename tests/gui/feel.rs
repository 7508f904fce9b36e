//! What makes the window good to work with: a layout that is remembered, the command palette, names
//! for screen readers.

use crate::harness::{
    Window, click, has, open, open_sized, open_with_graphics, press, small, wait,
};
use bspscope::gui::StartOptions;
use egui::accesskit::Role;
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};

/// Waits for the picture, whichever panels are shown.
fn finish(window: &mut Window<'_>) {
    wait(window, "the picture", |w| {
        w.query_by_label("finished").is_some()
    });
}

/// Opens the palette and types.
fn search(window: &mut Window<'_>, query: &str) {
    press(window, egui::Modifiers::COMMAND, egui::Key::K);
    let field = window.get_by_role_and_label(Role::TextInput, "Search for a command");
    field.type_text(query);
    window.run_steps(2);
}

fn is_open(window: &Window<'_>) -> bool {
    window.query_by_label("Search for a command").is_some()
}

#[test]
fn the_palette_does_what_is_typed_and_chosen() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    search(&mut window, "next build");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the method", |w| has(w, "balls:1 · sah-cut"));
    assert!(!is_open(&window));
    search(&mut window, "method objectmedian");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the method", |w| has(w, "· object-median ·"));
    // The second of two, by an arrow key.
    search(&mut window, "bar on the");
    window.key_press(egui::Key::ArrowDown);
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the right bar to go", |w| {
        w.query_by_label("leaves").is_none()
    });
    search(&mut window, "heatmap none");
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
    assert!(!is_open(&window));
}

#[test]
fn the_palette_reaches_panes_without_the_pointer() {
    let mut window = open_with_graphics(small("balls:1"));
    finish(&mut window);
    window.remove_cursor();
    assert!(!has(&window, "Leaf boxes are not shown"));
    search(&mut window, "show leaf boxes");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "no boxes", |w| {
        has(w, "Leaf boxes are not shown")
    });
    // By a click; the pane comes to the front of its tabs.
    assert!(!has(&window, "leaves selected"));
    search(&mut window, "select all leaves again");
    window
        .get_by_label_contains("Leaf histograms: Select all leaves again")
        .click();
    wait(&mut window, "the histograms", |w| has(w, "leaves selected"));
    assert!(!is_open(&window));
    search(&mut window, "heatmap nodes");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the heatmap", |w| has(w, "Legend from"));
}

/// A window that keeps its layout in this folder.
fn kept(folder: &std::path::Path) -> StartOptions {
    StartOptions {
        remember: true,
        settings_folder: Some(folder.to_owned()),
        ..small("balls:1")
    }
}

#[test]
fn the_layout_is_remembered_and_reset() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    let left = |w: &Window<'_>| has(w, "spheres: 10");
    let outline = |w: &Window<'_>| has(w, "node 0");
    assert!(left(&window) && outline(&window));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::B);
    click(&mut window, "Icicle");
    wait(&mut window, "the bar to go", |w| !left(w));
    // The harness starts in the dark, whatever was kept.
    assert!(window.query_by_label("Light").is_some());
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::T);
    window.run_steps(3);
    drop(window);
    let file = folder.path().join("layout.json");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("\"dark\": false"), "{text}");

    let mut window = open(kept(folder.path()));
    finish(&mut window);
    assert!(!left(&window) && !outline(&window));
    assert!(window.query_by_label("Icicle of the tree").is_some());
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::D);
    wait(&mut window, "the bar", |w| left(w) && outline(w));
    drop(window);

    std::fs::write(&file, "{\"tiles\": 3").unwrap();
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    assert!(left(&window) && outline(&window));
}

#[test]
fn folded_panels_stay_folded() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    let header = "Λ  the times";
    assert!(window.query_by_label("build time").is_some());
    click(&mut window, header);
    wait(&mut window, "folding", |w| {
        w.query_by_label("build time").is_none()
    });
    drop(window);
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    assert!(window.query_by_label("build time").is_none());
}

/// Whatever has the keyboard's focus or takes a click must say what it is.
#[test]
fn every_widget_has_a_name() {
    let mut window = open_sized(small("balls:1"), [1500.0, 1900.0], true);
    finish(&mut window);
    click(&mut window, "Traced picture");
    wait(&mut window, "the object", |w| has(w, "Hits sphere "));
    click(&mut window, "All parameters (Tables 1 to 3)");
    click(&mut window, "node 0");
    let mut checked = named(&window, "outline");
    for pane in ["Leaf histograms", "Icicle", "Split cost"] {
        click(&mut window, pane);
        window.run_steps(20);
        checked += named(&window, pane);
    }
    search(&mut window, "heatmap nodes");
    checked += named(&window, "palette");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the heatmap", |w| has(w, "Legend from"));
    checked += named(&window, "heatmap");
    window.key_press(egui::Key::F1);
    window.run_steps(3);
    checked += named(&window, "shortcuts");
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    for menu in ["View", "Recent"] {
        click(&mut window, menu);
        checked += named(&window, menu);
        press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    }
    assert!(checked > 300, "{checked} widgets");
}

/// How many widgets there are; panics if one has no name.
fn named(window: &Window<'_>, place: &str) -> usize {
    const WIDGETS: [Role; 9] = [
        Role::Button,
        Role::CheckBox,
        Role::ComboBox,
        Role::DisclosureTriangle,
        Role::Link,
        Role::RadioButton,
        Role::Slider,
        Role::SpinButton,
        Role::TextInput,
    ];
    let widgets: Vec<_> = window
        .query_all(By::new().recursive(true))
        .filter(|node| WIDGETS.contains(&node.accesskit_node().role()))
        .collect();
    let nameless: Vec<String> = widgets
        .iter()
        .map(|node| (node.rect(), node.accesskit_node()))
        .filter(|(_, node)| {
            let name = node.label().unwrap_or_default();
            // A number's unit does not say what the number is.
            let words = node.value().unwrap_or_default();
            let is_unit = node.role() == Role::SpinButton
                && name.split_whitespace().all(|word| words.contains(word));
            name.trim().is_empty() || is_unit
        })
        .map(|(rect, node)| format!("{:?} {:?} at {rect:?}", node.role(), node.value()))
        .collect();
    assert!(nameless.is_empty(), "{place}: {nameless:#?}");
    widgets.len()
}

#[test]
fn what_is_typed_and_entered_within_a_frame_is_no_shortcut() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let outlines = |window: &Window<'_>| {
        let node = window.get_by_label("Selection");
        node.accesskit_node().toggled()
    };
    let key = |key| egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: egui::Modifiers::NONE,
    };
    let before = outlines(&window);
    let picture = window.get_by_label("Traced picture").rect();
    window.hover_at(picture.center());
    window.run_steps(2);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::L);
    window.run_steps(2);
    let text = egui::Event::Text("s".to_owned());
    let events = [key(egui::Key::S), text, key(egui::Key::Enter)];
    window.input_mut().events.extend(events);
    window.run_steps(3);
    assert_eq!(outlines(&window), before);
    // Where nothing is typed, the same key does it.
    window.key_press(egui::Key::S);
    window.run_steps(2);
    assert_ne!(outlines(&window), before);
}
