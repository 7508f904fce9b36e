//! The card of the first start.

use crate::harness::{Window, click, has, open, open_sized, press, small, wait};
use bspscope::gui::StartOptions;
use bspscope::lesson::LESSONS;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

const CARD: &str = "See how a kd-tree makes ray tracing fast";

/// A start that remembers in this folder.
fn start(folder: &tempfile::TempDir) -> StartOptions {
    StartOptions {
        remember: true,
        settings_folder: Some(folder.path().to_owned()),
        ..small("balls:1")
    }
}

fn shows(window: &mut Window<'_>) -> bool {
    window.run_steps(3);
    has(window, CARD)
}

#[test]
fn the_card_comes_until_it_is_closed_and_never_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = open(start(&folder));
    assert!(shows(&mut window));
    // Looked at, but not closed.
    drop(window);
    let mut window = open(start(&folder));
    assert!(shows(&mut window));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!shows(&mut window));
    drop(window);
    assert!(!shows(&mut open(start(&folder))), "Esc closes it for good");
    // Nothing is remembered: the card could not be closed for good, so there is none.
    assert!(!shows(&mut open(small("balls:1"))));
}

#[test]
fn each_way_leads_where_it_says() {
    type Check = fn(&Window<'_>) -> bool;
    let ways: [(&str, Check); 3] = [
        ("Take the tour", |w| {
            has(w, &LESSONS[0].read().steps[0].title)
        }),
        ("Follow a ray", |w| {
            let mut lists = w.query_all_by_role(Role::ComboBox);
            lists.any(|list| {
                let value = list.accesskit_node().value().unwrap_or_default();
                value.contains("primary ray, sphere")
            })
        }),
        ("Use my scene", |w| {
            w.query_by_label("Path of a scene").is_some()
        }),
    ];
    for (name, is_there) in ways {
        let folder = tempfile::tempdir().unwrap();
        let mut window = open(start(&folder));
        assert!(shows(&mut window));
        click(&mut window, name);
        wait(&mut window, name, is_there);
        assert!(!has(&window, CARD));
        drop(window);
        assert!(!shows(&mut open(start(&folder))), "{name}");
    }
}

#[test]
fn the_card_has_its_size_in_both_windows() {
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        let folder = tempfile::tempdir().unwrap();
        let mut window = open_sized(start(&folder), size, false);
        assert!(shows(&mut window));
        let [left, right] = ["Take the tour", "Use my scene"].map(|name| {
            let rect = window.get_by_label(name).rect();
            assert_eq!(rect.size(), egui::vec2(216.0, 112.0), "{name}");
            rect
        });
        // Side by side, in the middle of the window.
        assert_eq!(left.top(), right.top());
        let middle = (left.left() + right.right()) / 2.0;
        assert!((middle - size[0] / 2.0).abs() < 3.0, "{middle}");
    }
}
