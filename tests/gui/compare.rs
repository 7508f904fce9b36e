//! Two trees side by side in the window: views of both, the gate, and the three columns.

use crate::harness::{
    SIZE, Window, click, described, finish, has, is_finished, open, open_with_graphics,
    over_picture, press, small, wait, wait_for,
};
use crate::support::scenes::{render_sized, scene, settings, tree_by};
use bspscope::measure::heat::{HeatImage, PixelCounts, RayFilter, heatmap};
use bspscope::measure::{DELTA, Measured, measure, parameter, ray_figures};
use bspscope::present::number::Digits;
use bspscope::progress::Progress;
use bspscope::structure::Method;
use bspscope::trace::{RayKind, RenderSettings, render_counted, thread_pool};
use egui::accesskit::Toggled;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::sync::Mutex;

const SCENE: &str = "balls:1";

fn render() -> RenderSettings {
    render_sized(&scene(SCENE), [SIZE, SIZE])
}

/// What the library measures of a method.
fn measured(method: &str, render: &RenderSettings) -> Measured {
    measure(&scene(SCENE), &settings(method), render, &Progress::new()).unwrap()
}

/// What the library counts in every pixel.
fn nodes(method: &str) -> HeatImage {
    let progress = Progress::new();
    let scene = scene(SCENE);
    let tree = tree_by(&scene, method);
    let counts = Mutex::new(PixelCounts::new(SIZE, SIZE));
    let pool = thread_pool(2).unwrap();
    render_counted(&scene, &tree, &render(), &pool, &progress, |part| {
        counts.lock().unwrap().add(&part);
    })
    .unwrap();
    let counts = counts.into_inner().unwrap();
    heatmap("N_NODES").unwrap().image(&counts, RayFilter::All)
}

/// A window that compares midpoint with sah-cut, the second in front.
fn comparing(graphics: bool) -> Window<'static> {
    let mut window = if graphics {
        open_with_graphics(small(SCENE))
    } else {
        open(small(SCENE))
    };
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait_for(&mut window, "Fair comparison");
    click(&mut window, "Bring B to the front");
    finish(&mut window);
    assert_eq!(methods(&window), ["midpoint", "sah-cut"]);
    window
}

/// The build methods of A and B.
fn methods(window: &Window<'_>) -> [&'static str; 2] {
    ["A", "B"].map(|side| {
        let name = format!("Build method of {side}");
        let list = window.get_by_label(&name);
        let name = list.accesskit_node().value().expect("a method");
        Method::named(&name).expect("a known method").name
    })
}

fn show_nodes(window: &mut Window<'_>) {
    click(window, "Show");
    window.get_by_label_contains("N_NODES · ").click();
    wait_for(window, "Legend from");
}

#[test]
fn three_columns_have_the_librarys_figures() {
    let window = comparing(false);
    let (a, b) = (
        measured("midpoint", &render()),
        measured("sah-cut", &render()),
    );
    for symbol in DELTA {
        let p = parameter(symbol);
        let [of_a, of_b] = [&a, &b].map(|side| p.value(&side.measurement));
        for text in [p.format(of_a), p.format(of_b)] {
            assert!(
                window.query_all_by_label(&text).next().is_some(),
                "{symbol} {text}"
            );
        }
        let change = p.change_text(of_a, of_b).expect("a change").text;
        assert!(has(&window, &change), "{symbol} {change}");
    }
}

#[test]
fn b_begins_with_another_method_and_is_remembered() {
    let mut start = small(SCENE);
    let sah_cut = Method::named("sah-cut").unwrap();
    start.setup.build.set_method(sah_cut);
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    wait_for(&mut window, "Fair comparison");
    assert_eq!(methods(&window), ["sah-cut", "midpoint"]);
    click(&mut window, "Build method of B");
    click(&mut window, "object-median");
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num1);
    finish(&mut window);
    assert!(!has(&window, "Build method of B"));
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    finish(&mut window);
    assert_eq!(methods(&window), ["sah-cut", "object-median"]);
}

#[test]
fn either_tree_comes_to_the_front_and_the_pixel_stays_picked() {
    let mut window = comparing(false);
    click(&mut window, "Wipe");
    window.get_by_label("Traced picture").click();
    if window.query_by_label("Rays of the pixel").is_none() {
        click(&mut window, "More panes");
    }
    click(&mut window, "Rays of the pixel");
    wait_for(&mut window, "Pixel 24, 24 (");
    assert!(described(&window).starts_with("balls:1 · sah-cut"));
    press(&mut window, Modifiers::NONE, Key::J);
    wait_for(&mut window, "balls:1 · midpoint");
    // Nothing is traced again.
    assert!(is_finished(&window));
    wait_for(&mut window, "Pixel 24, 24 (");
    press(&mut window, Modifiers::NONE, Key::J);
    wait_for(&mut window, "balls:1 · sah-cut");
    // The tree in front is the one that stays.
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run_steps(3);
    assert!(has(&window, "balls:1 · sah-cut"));
    assert!(!has(&window, "Build method of A"));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    wait_for(&mut window, "balls:1 · midpoint");
}

#[test]
fn both_pictures_share_range_pointer_and_pick() {
    let mut window = comparing(false);
    show_nodes(&mut window);
    wait_for(&mut window, "range of A and B together");
    let [a, b] = ["midpoint", "sah-cut"].map(nodes);
    let both = [&a, &b].map(|image| image.statistics().unwrap());
    let [lowest, highest] = [
        both[0].lowest.min(both[1].lowest),
        both[0].highest.max(both[1].highest),
    ]
    .map(bspscope::present::number::grouped);
    wait_for(
        &mut window,
        &format!("Legend from {lowest} to {highest} nodes"),
    );
    for view in ["Wipe", "Side by side", "One"] {
        click(&mut window, view);
        window.get_by_label("Traced picture").click();
        window.run_steps(4);
        let pixel = (0..SIZE * SIZE)
            .map(|i| [i % SIZE, i / SIZE])
            .find(|[x, y]| has(&window, &format!("Pixel {x}, {y}: ")));
        let Some([x, y]) = pixel else {
            // Between two pictures side by side there is none.
            assert_eq!(view, "Side by side");
            continue;
        };
        let [of_a, of_b] = [&a, &b].map(|image| image.get(x, y).unwrap());
        wait_for(&mut window, &format!("N_NODES A {of_a} · B {of_b} nodes"));
    }
}

#[test]
fn the_difference_is_signed() {
    let mut window = comparing(false);
    show_nodes(&mut window);
    click(&mut window, "Difference");
    wait_for(&mut window, "B − A");
    wait_for(&mut window, "Legend from −");
    let difference = nodes("sah-cut").difference(&nodes("midpoint")).unwrap();
    let found = difference.statistics().unwrap();
    let most = found.lowest.abs().max(found.highest.abs());
    assert!(
        found.lowest < 0.0 && found.highest > 0.0,
        "nothing is tested"
    );
    wait_for(&mut window, &format!("Legend from −{most} to {most} nodes"));
    window.get_by_label("Traced picture").click();
    let value = difference.get(SIZE / 2, SIZE / 2).unwrap();
    let value = format!("{value:+}").replace('-', "−");
    wait_for(&mut window, &format!("Picked: {value} nodes per pixel"));
}

#[test]
fn unequal_conditions_are_refused_and_the_pixels_shown() {
    let mut window = comparing(false);
    for _ in 0..4 {
        press(&mut window, Modifiers::COMMAND, Key::PageDown);
    }
    wait_for(&mut window, "Not comparable");
    wait_for(&mut window, "D_AREC (");
    let flat = RenderSettings {
        d_arec: 0,
        ..render()
    };
    let [a, b] = [
        measured("midpoint", &render()).picture,
        measured("sah-cut", &flat).picture,
    ];
    let differing = bspscope::measure::differing_pixels(&a, &b).len();
    assert!(differing > 0, "nothing is tested");
    assert!(has(&window, &format!("{differing} pixels differ: ")));
    click(&mut window, "Show the pixels");
    let count = bspscope::present::number::counted(differing, "pixel");
    wait(&mut window, "the difference", |w| {
        w.query_by_label(&format!("{count} differ")).is_some()
    });
    // No ratio stands where there is no comparison.
    assert_eq!(window.query_all_by_label_contains(" points").count(), 0);
    click(&mut window, "Use same conditions");
    wait_for(&mut window, "Fair comparison");
    wait_for(&mut window, "Equal in every pixel");
}

#[test]
fn wipe_and_flip_show_the_other_picture() {
    let mut window = comparing(true);
    click(&mut window, "Wipe");
    show_nodes(&mut window);
    wait_for(&mut window, "range of A and B together");
    let wipe = |window: &mut Window<'_>, percent: f64| {
        window
            .get_by_role_and_label(egui::accesskit::Role::SpinButton, "Wipe")
            .set_value_accesskit(percent);
        window.run_steps(4);
    };
    let picture = |window: &mut Window<'_>| {
        // The pointer is elsewhere, so that the legend does not change.
        let rect = window.get_by_label("Traced picture").rect().shrink(30.0);
        let image = window.render().expect("a picture");
        let [x, y, w, h] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|v| v as u32);
        image::imageops::crop_imm(&image, x, y, w, h).to_image()
    };
    wipe(&mut window, 100.0);
    let all_a = picture(&mut window);
    wipe(&mut window, 0.0);
    let all_b = picture(&mut window);
    wipe(&mut window, 50.0);
    let half = picture(&mut window);
    assert!(all_a != all_b, "the heatmaps differ");
    let column = |image: &image::RgbaImage, x: u32| -> Vec<_> {
        (0..image.height())
            .map(|y| *image.get_pixel(x, y))
            .collect()
    };
    let width = half.width();
    for x in [width / 4, width / 3] {
        assert!(column(&half, x) == column(&all_a, x), "A is on the left");
    }
    for x in [width * 2 / 3, width * 3 / 4] {
        assert!(column(&half, x) == column(&all_b, x), "B is on the right");
    }
    // One picture, B's, and A's while the key is held.
    click(&mut window, "One");
    // The tooltip of what was clicked lies over the picture for a moment.
    over_picture(&mut window);
    window.run_steps(30);
    let one = picture(&mut window);
    window.key_down(Key::F);
    window.run_steps(3);
    let flipped = picture(&mut window);
    window.key_up(Key::F);
    window.run_steps(3);
    // Away from the pointer, which is drawn, too.
    let middle = width * 2 / 3;
    assert!(column(&one, middle) == column(&all_b, middle));
    assert!(column(&flipped, middle) == column(&all_a, middle));
    assert!(column(&picture(&mut window), middle) == column(&all_b, middle));
}

#[test]
fn what_each_kind_of_ray_did_is_listed_on_request() {
    let mut window = comparing(false);
    assert!(!has(&window, "Nodes per ray, maximum"));
    click(&mut window, "Per kind of ray");
    let [a, b] = ["midpoint", "sah-cut"].map(|method| measured(method, &render()).measurement);
    for figure in ray_figures() {
        for kind in [RayKind::Primary, RayKind::Shadow] {
            let values = [&a, &b].map(|m| figure.of(m, kind));
            let change = figure.change_text(values[0], values[1]).map(|c| c.text);
            let texts = values.map(|value| Some(figure.text(value, Digits::Four)));
            for text in texts.into_iter().chain([change]).flatten() {
                assert!(has(&window, &text), "{}: {text}", figure.key);
            }
        }
    }
    assert!(window.query_by_label("Shadow rays").is_some());
    assert!(window.query_by_label("Refracted rays").is_none());
}

#[test]
fn a_comparison_that_ends_while_the_other_tree_is_rendered_leaves_nothing_running() {
    let mut start = small(SCENE);
    start.setup.render.samples = 400;
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait_for(&mut window, "Fair comparison");
    press(&mut window, Modifiers::NONE, Key::J);
    // With the same method, the tree behind would take the finished picture of the one in front.
    press(&mut window, Modifiers::COMMAND, Key::M);
    press(&mut window, Modifiers::COMMAND, Key::PageDown);
    wait_for(&mut window, "Not comparable");
    // From here on the tree behind is rendered with other settings.
    click(&mut window, "Use same conditions");
    wait(&mut window, "the tree behind", |w| has(w, "Tracing A"));
    press(&mut window, Modifiers::COMMAND, Key::E);
    finish(&mut window);
}

#[test]
fn undo_and_redo_change_the_task_with_the_second_tree() {
    let mut window = open(small(SCENE));
    finish(&mut window);
    let shows = |window: &Window<'_>, task: &str| {
        let node = window.get_by_label(task).accesskit_node();
        node.toggled() == Some(Toggled::True)
    };
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    wait_for(&mut window, "Fair comparison");
    window.run_steps(60);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    window.run_steps(2);
    assert!(shows(&window, "Explore") && !shows(&window, "Compare"));
    assert!(window.query_by_label("Build method of B").is_none());
    press(&mut window, Modifiers::COMMAND, Key::Y);
    wait_for(&mut window, "Fair comparison");
    assert!(shows(&window, "Compare"));
}
