//! What makes the window good to work with: a layout that is remembered, the command palette, names
//! for screen readers.

use crate::harness::{
    Window, described, has, open, open_pane, open_sized, open_with_graphics, press, small, wait,
};
use bspscope::gui::StartOptions;
use egui::accesskit::Role;
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};

/// Waits for the picture.
fn finish(window: &mut Window<'_>) {
    wait(window, "the picture", |w| w.state().is_finished());
}

/// Opens the palette and types.
fn search(window: &mut Window<'_>, query: &str) {
    press(window, egui::Modifiers::COMMAND, egui::Key::K);
    assert!(is_open(window), "the palette for {query}");
    let field = window.get_by_role_and_label(Role::TextInput, "Search for a command");
    field.type_text(query);
    window.run_steps(2);
}

fn is_open(window: &Window<'_>) -> bool {
    window.query_by_label("Search for a command").is_some()
}

/// The depth that the slider in the top bar says.
fn depth(window: &Window<'_>) -> f64 {
    let mut sliders = window.query_all_by_role(Role::Slider);
    let slider = sliders.next().expect("the slider of the depth");
    slider.accesskit_node().numeric_value().expect("a number")
}

#[test]
fn the_palette_does_what_is_typed_and_chosen() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    let before = described(&window);
    search(&mut window, "next build");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the method", |w| described(w) != before);
    assert!(!is_open(&window));
    // The second of two, by an arrow key, undoes what the first one does.
    let before = depth(&window);
    search(&mut window, "depth: one level");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the depth", |w| depth(w) != before);
    search(&mut window, "depth: one level");
    window.key_press(egui::Key::ArrowDown);
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    wait(&mut window, "the depth", |w| depth(w) == before);
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
        .get_by_label_contains("Histograms: Select all leaves again")
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
    // This is not the first start.
    std::fs::write(folder.path().join("hint.json"), "true").unwrap();
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    let drawer = |w: &Window<'_>| has(w, "Root margin");
    let icicle = |w: &Window<'_>| w.query_by_label("Icicle of the tree").is_some();
    assert!(!drawer(&window) && !icicle(&window));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::I);
    search(&mut window, "icicle");
    window.key_press(egui::Key::Enter);
    wait(&mut window, "both", |w| drawer(w) && icicle(w));
    // The harness starts in the dark, whatever was kept.
    assert!(window.ctx.theme() == egui::Theme::Dark);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::T);
    window.run_steps(3);
    drop(window);
    let file = folder.path().join("layout.json");
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(text.contains("\"dark\": false"), "{text}");

    let mut window = open(kept(folder.path()));
    finish(&mut window);
    assert!(drawer(&window) && icicle(&window));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::D);
    wait(&mut window, "neither", |w| !drawer(w) && !icicle(w));
    drop(window);

    std::fs::write(&file, "{\"tiles\": 3").unwrap();
    let mut window = open(kept(folder.path()));
    finish(&mut window);
    assert!(!drawer(&window) && !icicle(&window));
}

/// Whatever has the keyboard's focus or takes a click must say what it is.
#[test]
fn every_widget_has_a_name() {
    let mut window = open_sized(small("balls:1"), [1600.0, 1000.0], true);
    finish(&mut window);
    let mut checked = 0;
    for key in [
        egui::Key::Num2,
        egui::Key::Num3,
        egui::Key::Num4,
        egui::Key::Num5,
        egui::Key::Num1,
    ] {
        press(&mut window, egui::Modifiers::COMMAND, key);
        finish(&mut window);
        window.run_steps(5);
        checked += named(&window, &format!("{key:?}"));
    }
    let panes = [
        "Outline",
        "Histograms",
        "Icicle",
        "Split cost",
        "All figures",
    ];
    for pane in panes {
        open_pane(&mut window, pane);
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
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::L);
    window.run_steps(3);
    checked += named(&window, "scenes");
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
    let heatmap = |window: &Window<'_>| has(window, "Legend from");
    let key = |key| egui::Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: egui::Modifiers::NONE,
    };
    let picture = window.get_by_label("Traced picture").rect();
    window.hover_at(picture.center());
    window.run_steps(2);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::L);
    window.run_steps(2);
    let text = egui::Event::Text("h".to_owned());
    let events = [key(egui::Key::H), text, key(egui::Key::Enter)];
    window.input_mut().events.extend(events);
    window.run_steps(3);
    assert!(!heatmap(&window));
    // Where nothing is typed, the same key shows a heatmap.
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    window.hover_at(picture.center());
    window.run_steps(2);
    window.key_press(egui::Key::H);
    wait(&mut window, "the heatmap", heatmap);
}

#[test]
fn escape_closes_an_open_menu_and_nothing_else() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num2);
    let stays = |window: &Window<'_>| window.query_by_label("Steps along the ray").is_some();
    for (menu, item) in [
        ("Scene: balls:1", "Generated scenes"),
        ("Method", "object-median"),
        ("Show", "Picture"),
        ("More", "Copy as command"),
    ] {
        let roles = [Role::Button, Role::ComboBox];
        let mut named = window.query_all_by_label(menu);
        let button = named.find(|node| roles.contains(&node.accesskit_node().role()));
        button.expect(menu).click();
        drop(named);
        window.run_steps(3);
        assert!(has(&window, item), "{menu} is open");
        press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
        window.run_steps(10);
        assert!(!egui::Popup::is_any_open(&window.ctx), "{menu} is closed");
        assert!(stays(&window), "{menu}");
    }
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    window.run_steps(2);
    assert!(!stays(&window));
}
