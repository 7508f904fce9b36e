//! Presenting: what is shown, how large, and that all comes back.

use crate::harness::{Window, click, has, open_sized, press, small, wait};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

fn finish(window: &mut Window<'_>) {
    wait(window, "the picture", |w| w.state().is_finished());
}

fn is_bar_shown(window: &Window<'_>) -> bool {
    window.query_by_label("Explore").is_some()
}

#[test]
fn picture_and_3d_view_stand_over_four_figures() {
    let mut window = open_sized(small("balls:1"), [1600.0, 1000.0], true);
    finish(&mut window);
    let before = window.get_by_label("Traced picture").rect();
    press(&mut window, Modifiers::NONE, Key::F11);
    window.run_steps(5);
    assert_eq!(window.ctx.zoom_factor(), 1.25);
    let all = window.ctx.content_rect();
    let picture = window.get_by_label("Traced picture").rect();
    let tree = window.get_by_label("3D view of scene and tree").rect();
    assert!(tree.left() > picture.right());
    assert!((picture.width() - tree.width()).abs() < 1.0);
    assert!(picture.width() + tree.width() > 0.97 * all.width());
    // Half of the window each, as the window counts without presenting.
    assert!((picture.width() * 1.25 - 796.0).abs() < 2.0, "{picture:?}");
    for words in ["tests per hit", "nodes per ray", "leaves", "rendering time"] {
        let rect = window.get_by_label(words).rect();
        assert!(rect.top() > picture.bottom(), "{words} {rect:?}");
    }
    // No bars, tabs or status.
    assert!(!is_bar_shown(&window) && !has(&window, "More panes"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(5);
    assert_eq!(window.ctx.zoom_factor(), 1.0);
    assert!(is_bar_shown(&window) && has(&window, "More panes"));
    assert_eq!(window.get_by_label("Traced picture").rect(), before);
}

#[test]
fn the_bar_slides_in_at_the_upper_edge() {
    let mut window = open_sized(small("balls:1"), [1600.0, 1000.0], false);
    finish(&mut window);
    press(&mut window, Modifiers::NONE, Key::F11);
    window.hover_at(egui::pos2(600.0, 500.0));
    window.run_steps(30);
    assert!(!is_bar_shown(&window));
    window.hover_at(egui::pos2(600.0, 1.0));
    window.run_steps(30);
    assert!(is_bar_shown(&window));
    // Over the bar it stays.
    window.hover_at(egui::pos2(600.0, 30.0));
    window.run_steps(30);
    assert!(is_bar_shown(&window));
    window.hover_at(egui::pos2(600.0, 300.0));
    window.run_steps(30);
    assert!(!is_bar_shown(&window));
}

#[test]
fn a_lesson_keeps_its_column() {
    let mut start = small("balls:1");
    start.lesson = Some(bspscope::lesson::LESSONS[0].read());
    let mut window = open_sized(start, [1600.0, 1000.0], false);
    window.run_steps(3);
    press(&mut window, Modifiers::NONE, Key::F11);
    window.run_steps(5);
    assert!(has(&window, "Exit lesson") && has(&window, "Traced picture"));
    assert!(!is_bar_shown(&window) && !has(&window, "tests per hit"));
    click(&mut window, "Exit lesson");
    wait(&mut window, "the figures", |w| has(w, "tests per hit"));
}
