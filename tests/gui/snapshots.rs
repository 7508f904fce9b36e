//! How every task looks, on a small screen. What depends on the machine is covered.

use crate::harness::{Window, click, finish, has, open_sized, press, small, type_into, wait};
use crate::painted::texts_in;
use bspscope::gui::StartOptions;
use bspscope::lesson::LESSONS;
use bspscope::structure::Method;
use egui::{Key, Modifiers, Rect, pos2};
use egui_kittest::SnapshotOptions;
use egui_kittest::kittest::Queryable as _;

/// The smaller reference size, in points.
const SIZE: [f32; 2] = [1280.0, 720.0];

/// A window with a finished picture and the 3D view.
fn opened<'a>(start: StartOptions) -> Window<'a> {
    let mut window = open_sized(start, SIZE, true);
    finish(&mut window);
    window
}

/// Switches to the task with this key.
fn task<'a>(key: Key) -> Window<'a> {
    let mut window = opened(small("balls:1"));
    press(&mut window, Modifiers::COMMAND, key);
    finish(&mut window);
    window
}

/// Whether a text is a time.
fn tells_time(text: &str) -> bool {
    let is_time = |unit: &str| {
        let number = text.strip_suffix(unit).map(|number| number.trim_end());
        number.is_some_and(|number| number.ends_with(|c: char| c.is_ascii_digit()))
    };
    ["ns", "µs", "ms", "s"].into_iter().any(is_time)
}

/// Covers a text. Sides at multiples of 32 points cover the same for times of other lengths.
fn cover(window: &mut Window<'_>, text: Rect) {
    const STEP: f32 = 32.0;
    let left = STEP * (text.left() / STEP).floor();
    let right = STEP * (text.right() / STEP).ceil();
    let rows = text.expand(2.0);
    window.mask(Rect::from_min_max(
        pos2(left, rows.top()),
        pos2(right, rows.bottom()),
    ));
}

/// Compares the window with its picture, without times.
fn look(window: &mut Window<'_>, name: &str) {
    look_without(window, name, |_| Vec::new());
}

/// Compares the window with its picture, without times and what else is `covered`.
fn look_without(window: &mut Window<'_>, name: &str, covered: impl Fn(&Window<'_>) -> Vec<Rect>) {
    window.remove_cursor();
    window.run_steps(60);
    // What is covered is forgotten with the next frame.
    for rect in covered(window) {
        window.mask(rect);
    }
    for text in texts_in(window, window.ctx.content_rect()) {
        if tells_time(&text.rows.concat()) {
            cover(window, text.rect);
        }
    }
    // Other versions of the software driver draw edges a little differently.
    let options = SnapshotOptions::new()
        .threshold(2.0)
        .max_failed_pixels(3000_usize);
    window.snapshot_options(name, &options);
}

/// Where the values of a figure are in its row, up to the right end of the window.
fn values_of(window: &Window<'_>, name: &str) -> Rect {
    let all = window.ctx.content_rect();
    let texts = texts_in(window, all).into_iter();
    let names: Vec<_> = texts
        .filter(|t| t.rows.concat().starts_with(name))
        .collect();
    assert_eq!(names.len(), 1, "{name}");
    let name = names[0].rect.expand(2.0);
    Rect::from_min_max(
        pos2(name.right(), name.top()),
        // A row can have two lines.
        pos2(all.right(), name.bottom() + 12.0),
    )
}

#[test]
fn explore_looks_as_it_did() {
    let mut window = task(Key::Num1);
    look(&mut window, "explore");
    press(&mut window, Modifiers::COMMAND, Key::T);
    look(&mut window, "explore_light");
}

#[test]
fn ray_looks_as_it_did() {
    let mut window = task(Key::Num2);
    window.get_by_label("Traced picture").click();
    window.run_steps(3);
    finish(&mut window);
    look(&mut window, "ray");
}

#[test]
fn compare_looks_as_it_did() {
    let mut window = task(Key::Num3);
    wait(&mut window, "the gate", |w| has(w, "Fair comparison"));
    look_without(&mut window, "compare", |window| {
        let names = ["Build time", "Render time", "Time spent traversing"];
        names.map(|name| values_of(window, name)).into()
    });
}

#[test]
fn the_study_of_measures_looks_as_it_did() {
    let mut window = task(Key::Num4);
    click(&mut window, "Measures and time");
    type_into(&mut window, "Rays per set", "64");
    click(&mut window, "Study measures");
    wait(&mut window, "the end", |w| has(w, "by rank correlation"));
    // Every figure depends on times, and so does the order.
    look_without(&mut window, "measures", |window| {
        let conditions = texts_in(window, window.ctx.content_rect()).into_iter();
        let conditions = conditions.map(|text| (text.rows.concat(), text.rect));
        let spread = conditions.filter(|(text, _)| text.contains(" from round to round"));
        let spread: Vec<_> = spread.map(|(_, rect)| rect).collect();
        assert_eq!(spread.len(), 1);
        let below = window.get_by_label("structures").rect().bottom() + 2.0;
        let strip = window.get_by_label("Outline").rect().center().y - 16.0;
        let right = window.ctx.content_rect().right();
        let rows = Rect::from_min_max(pos2(spread[0].left(), below), pos2(right, strip));
        [spread, vec![rows]].concat()
    });
}

#[test]
fn tune_looks_as_it_did() {
    let mut window = task(Key::Num4);
    for method in Method::all().filter(|m| m.name != "midpoint") {
        click(&mut window, method.name);
    }
    // The order does not depend on times: no two trees of one method need as much memory.
    click(&mut window, "Least memory");
    click(&mut window, "Find the best tree");
    wait(&mut window, "the end", |w| {
        w.query_by_label("Stop").is_none()
    });
    look_without(&mut window, "tune", |window| {
        let end = window.get_by_label("Depth & leaf size").rect().top() - 36.0;
        let bars = window.query_all_by_label_contains("Time of ");
        let bars = bars.map(|bar| bar.rect()).filter(|bar| bar.top() < end);
        let bars: Vec<Rect> = bars.collect();
        assert!(bars.len() > 2);
        bars
    });
}

#[test]
fn lessons_look_as_they_did() {
    let mut window = task(Key::Num5);
    look(&mut window, "lessons");
}

#[test]
fn a_lesson_looks_as_it_did() {
    let mut start = small("balls:1");
    start.lesson = Some(LESSONS[0].read());
    let mut window = open_sized(start, SIZE, true);
    wait(&mut window, "the picture", |w| w.state().is_finished());
    look(&mut window, "lesson");
}

#[test]
fn present_looks_as_it_did() {
    let mut window = task(Key::Num1);
    press(&mut window, Modifiers::NONE, Key::F11);
    look(&mut window, "present");
}

#[test]
fn the_first_start_looks_as_it_did() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = opened(StartOptions {
        remember: true,
        settings_folder: Some(folder.path().to_owned()),
        ..small("balls:1")
    });
    look(&mut window, "first_start");
}

#[test]
fn the_menu_of_scenes_looks_as_it_did() {
    let mut window = task(Key::Num1);
    click(&mut window, "Scene: balls:1");
    look(&mut window, "scenes");
}

/// A window with a hierarchy.
fn with_boxes<'a>(key: Key) -> Window<'a> {
    let mut start = small("balls:1");
    start
        .setup
        .build
        .set_method(Method::named("bvh-sweep").unwrap());
    let mut window = opened(start);
    press(&mut window, Modifiers::COMMAND, key);
    finish(&mut window);
    window
}

#[test]
fn boxes_look_as_they_did_in_explore() {
    let mut window = with_boxes(Key::Num1);
    click(&mut window, "Outline");
    click(&mut window, "Unfold node 2");
    click(&mut window, "node 3");
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.center());
    press(&mut window, Modifiers::NONE, Key::H);
    look(&mut window, "boxes_explore");
    click(&mut window, "Split cost");
    look(&mut window, "boxes_cost");
    press(&mut window, Modifiers::COMMAND, Key::G);
    press(&mut window, Modifiers::ALT, Key::ArrowRight);
    press(&mut window, Modifiers::ALT, Key::ArrowRight);
    look(&mut window, "boxes_build");
}

#[test]
fn boxes_look_as_they_did_beside_a_ray() {
    let mut start = small("teaching");
    start
        .setup
        .build
        .set_method(Method::named("bvh-sweep").unwrap());
    let mut window = opened(start);
    press(&mut window, Modifiers::COMMAND, Key::Num2);
    window.get_by_label("Traced picture").click();
    window.run_steps(3);
    finish(&mut window);
    look(&mut window, "boxes_ray");
    // After the first hit, a node is culled, and another one is visited because boxes overlap.
    for _ in 0..6 {
        press(&mut window, Modifiers::NONE, Key::Period);
    }
    look(&mut window, "boxes_ray_culled");
}

#[test]
fn boxes_look_as_they_did_beside_planes() {
    let mut window = with_boxes(Key::Num3);
    wait(&mut window, "the gate", |w| has(w, "Fair comparison"));
    look_without(&mut window, "boxes_compare", |window| {
        let names = ["Build time", "Render time", "Time spent traversing"];
        names.map(|name| values_of(window, name)).into()
    });
}

#[test]
fn the_list_of_methods_looks_as_it_did() {
    let mut window = with_boxes(Key::Num1);
    window
        .get_by_role_and_label(egui::accesskit::Role::ComboBox, "Method")
        .click();
    window.run_steps(3);
    look(&mut window, "methods");
}

#[test]
fn a_lesson_on_boxes_looks_as_it_did() {
    let mut start = small("balls:1");
    let lesson = LESSONS
        .iter()
        .find(|lesson| lesson.name == "planes-or-boxes");
    start.lesson = Some(lesson.unwrap().read());
    let mut window = open_sized(start, SIZE, true);
    wait(&mut window, "the picture", |w| w.state().is_finished());
    look(&mut window, "boxes_lesson");
}
