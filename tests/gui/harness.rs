//! The window in a harness, for the tests of its parts: opening it, waiting, finding labels.
#![allow(dead_code)] // Each test file uses its part of this.

use bspscope::gui::{App, StartOptions};
use bspscope::scene::SceneRequest;
use bspscope::setup::Setup;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::time::{Duration, Instant};

/// Enough for two slow cores that do other things, too.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// Width and height of the pictures in pixels.
pub const SIZE: u32 = 48;

pub type Window<'a> = Harness<'a, App>;

/// A small picture of a scene; leaves the user's own settings folder alone.
pub fn small(scene: &str) -> StartOptions {
    let mut start = StartOptions {
        setup: Setup::new(SceneRequest::parse(scene)),
        remember: false,
        ..StartOptions::default()
    };
    start.setup.render.width = SIZE;
    start.setup.render.height = SIZE;
    start.setup.render.threads = 2;
    start
}

/// A window of this size in points; with the 3D view where `graphics`.
pub fn open_sized<'a>(start: StartOptions, size: [f32; 2], graphics: bool) -> Window<'a> {
    let builder = Harness::builder().with_size(size).with_max_steps(40);
    let builder = if graphics { builder.wgpu() } else { builder };
    builder.build_eframe(|cc| App::new(cc, start))
}

pub fn open<'a>(start: StartOptions) -> Window<'a> {
    open_sized(start, [1500.0, 1000.0], false)
}

pub fn open_with_graphics<'a>(start: StartOptions) -> Window<'a> {
    open_sized(start, [1500.0, 1000.0], true)
}

/// Runs the window until `done`.
pub fn wait(window: &mut Window<'_>, what: &str, done: impl Fn(&Window<'_>) -> bool) {
    let start = Instant::now();
    loop {
        window.run_steps(2);
        if done(window) {
            return;
        }
        assert!(start.elapsed() < PATIENCE, "still waiting for: {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Waits for a label that contains this.
pub fn wait_for(window: &mut Window<'_>, text: &str) {
    wait(window, text, |w| has(w, text));
}

/// Returns the text of the one label that contains this.
pub fn text_with(window: &Window<'_>, part: &str) -> String {
    let node = window.get_by_label_contains(part);
    let node = node.accesskit_node();
    node.label().or(node.value()).unwrap_or_default()
}

/// Moves the pointer over the middle of the picture.
pub fn over_picture(window: &mut Window<'_>) {
    let middle = window.get_by_label("Traced picture").rect().center();
    window.hover_at(middle);
    window.run_steps(2);
}

/// Whether a label contains this, or the description of the picture, which names its settings.
pub fn has(window: &Window<'_>, text: &str) -> bool {
    window.query_all_by_label_contains(text).next().is_some() || described(window).contains(text)
}

/// Returns the settings of the picture on view; empty without one.
pub fn described(window: &Window<'_>) -> String {
    let picture = window.query_by_label("Traced picture");
    let description = picture.and_then(|node| node.accesskit_node().description());
    description.unwrap_or_default()
}

/// Whether what is asked for is on view, with final figures.
pub fn is_finished(window: &Window<'_>) -> bool {
    window.state().is_finished()
        && !has(window, "visits: counted when")
        && !has(window, "counting visits")
}

pub fn finish(window: &mut Window<'_>) {
    wait(window, "finished", is_finished);
}

pub fn click(window: &mut Window<'_>, label: &str) {
    window.get_by_label(label).click();
    window.run_steps(3);
}

/// Opens a pane at the bottom: by its tab, or in the menu of those that the strip has no room for.
pub fn open_pane(window: &mut Window<'_>, title: &str) {
    if window.query_by_label(title).is_none() {
        click(window, "More panes");
    }
    click(window, title);
}

/// Types a path into the path field and enters it.
pub fn enter_path(window: &mut Window<'_>, path: &str) {
    press(window, egui::Modifiers::COMMAND, egui::Key::L);
    window.run_steps(3);
    window.get_by_label("Path of a scene").focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.get_by_label("Path of a scene").type_text(path);
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
}

/// Presses a key, wherever the pointer is.
pub fn press(window: &mut Window<'_>, modifiers: egui::Modifiers, key: egui::Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(2);
}

/// Types into the field with this name, in place of what is there.
pub fn type_into(window: &mut Window<'_>, name: &str, text: &str) {
    window.get_by_label(name).focus();
    window.run_steps(2);
    press(window, egui::Modifiers::COMMAND, egui::Key::A);
    window.get_by_label(name).type_text(text);
    window.run_steps(2);
    press(window, egui::Modifiers::NONE, egui::Key::Enter);
}

/// A whole number as people read it, in groups of three digits.
pub fn grouped(number: impl TryInto<u64>) -> String {
    let digits = number.try_into().ok().expect("a count").to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<_> = groups.map(String::from_utf8_lossy).collect();
    groups.join("\u{a0}")
}
