//! The pane of the paper's tables, found by its labels.

use crate::harness::{Window, click, finish, has, open, open_pane, open_sized, press, small, wait};
use egui_kittest::kittest::Queryable as _;

/// A window on the pane, with one scene chosen.
fn with_pane<'a>(scene: &str) -> Window<'a> {
    let mut window = open(small("tetra:2"));
    finish(&mut window);
    open_pane(&mut window, "Paper's tables");
    for other in ["balls", "rings", "tetra", "fluid", "m-fluid", "room"] {
        if other != scene {
            click(&mut window, other);
        }
    }
    window
}

#[test]
fn the_experiment_runs_beside_the_window_and_shows_printed_beside_computed() {
    let mut window = with_pane("tetra");
    assert!(has(&window, "balls: not measured yet"));
    click(&mut window, "Repeat the experiment");
    wait(&mut window, "both methods", |w| has(w, "125.49 % ~"));
    wait(&mut window, "the end", |w| {
        w.query_by_label("Repeat the experiment").is_some()
    });
    // Method 1 is the paper's to the integer; the printed figure stands below.
    assert!(window.query_by_label("96056  =").is_some());
    assert!(window.query_by_label("96056 ").is_some());
    assert!(window.query_by_label("11540  ~").is_some());
    assert!(has(&window, "equal after rounding"));
}

#[test]
fn begun_by_its_shortcut_it_is_brought_into_view() {
    let mut window = open_sized(small("tetra:2"), [1280.0, 400.0], false);
    finish(&mut window);
    assert!(window.query_by_label("Cancel the experiment").is_none());
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::U);
    wait(&mut window, "its pane", |w| {
        let button = w.query_by_label("Cancel the experiment");
        button.is_some_and(|b| egui::Rangef::new(0.0, 400.0).contains(b.rect().bottom()))
    });
}

#[test]
fn a_cancelled_experiment_keeps_what_it_has() {
    let mut window = with_pane("tetra");
    for later in ["fluid", "m-fluid", "room"] {
        click(&mut window, later);
    }
    click(&mut window, "Repeat the experiment");
    wait(&mut window, "method 1", |w| has(w, "96056  ="));
    click(&mut window, "Cancel the experiment");
    assert!(has(&window, "Cancelled; what was measured stays."));
    click(&mut window, "show tetra");
    assert!(window.query_by_label("96056  =").is_some());
    click(&mut window, "show room");
    assert!(has(&window, "room: not measured yet"));
    assert!(window.query_by_label("Repeat the experiment").is_some());
}
