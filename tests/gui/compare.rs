//! Two trees side by side in the window: views of both, the gate, and the three columns.

use crate::harness::{
    SIZE, Window, click, finish, has, open, open_with_graphics, over_picture, press, small, wait,
    wait_for,
};
use crate::support::scenes::{render_sized, scene, settings, tree_by};
use bspscope::measure::heat::{HeatImage, PixelCounts, RayFilter, heatmap};
use bspscope::measure::{DELTA, Measured, change, measure, parameter, ray_figures};
use bspscope::progress::Progress;
use bspscope::trace::{RayKind, RenderSettings, render_counted, thread_pool};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
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
    wait_for(&mut window, "May be compared");
    click(&mut window, "Tree B");
    press(&mut window, Modifiers::COMMAND, Key::M);
    wait(&mut window, "both", |w| {
        has(w, "B: balls:1 · sah-cut") && has(w, "May be compared")
    });
    finish(&mut window);
    window
}

fn show_nodes(window: &mut Window<'_>) {
    window
        .query_all_by_role(egui::accesskit::Role::ComboBox)
        .find(|node| node.value().is_some_and(|v| v.starts_with("Show:")))
        .expect("the list of heatmaps")
        .click();
    window.run_steps(3);
    window.get_by_label_contains("N_NODES · ").click();
    wait_for(window, "Legend from");
}

#[test]
fn three_columns_have_the_librarys_figures() {
    let window = comparing(false);
    assert!(has(&window, "A: balls:1 · midpoint"));
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
        let change = change(p.unit, of_a, of_b).expect("a ratio").to_string();
        assert!(
            window.query_all_by_label(&change).next().is_some(),
            "{symbol} {change}"
        );
    }
}

#[test]
fn either_tree_comes_to_the_front_and_the_pixel_stays_picked() {
    let mut window = comparing(false);
    window.get_by_label("Traced picture").click();
    wait_for(&mut window, "Pixel 24, 24 (");
    let leaves = |method| {
        let p = parameter("N_LS");
        p.format(p.value(&measured(method, &render()).measurement))
    };
    assert!(has(&window, "gap-fraction"), "sah-cut is in front");
    press(&mut window, Modifiers::NONE, Key::J);
    wait(&mut window, "midpoint", |w| !has(w, "gap-fraction"));
    wait_for(&mut window, "Pixel 24, 24 (");
    assert!(window.query_all_by_label(&leaves("midpoint")).count() >= 2);
    // Nothing is traced again.
    assert!(has(&window, "ready"));
    press(&mut window, Modifiers::NONE, Key::J);
    wait_for(&mut window, "gap-fraction");
    // The tree in front is the one that stays.
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run_steps(3);
    assert!(has(&window, "gap-fraction"));
    assert!(!has(&window, "A: balls:1"));
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    wait_for(&mut window, "A: balls:1 · midpoint");
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
    for view in ["wipe", "side by side", "one"] {
        click(&mut window, view);
        window.get_by_label("Traced picture").click();
        window.run_steps(4);
        let pixel = (0..SIZE * SIZE)
            .map(|i| [i % SIZE, i / SIZE])
            .find(|[x, y]| has(&window, &format!("Pixel {x}, {y}: ")));
        let Some([x, y]) = pixel else {
            // Between two pictures side by side there is none.
            assert_eq!(view, "side by side");
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
    click(&mut window, "difference");
    wait_for(&mut window, "B − A");
    wait_for(&mut window, "Legend from -");
    let difference = nodes("sah-cut").difference(&nodes("midpoint")).unwrap();
    let found = difference.statistics().unwrap();
    let most = found.lowest.abs().max(found.highest.abs());
    assert!(
        found.lowest < 0.0 && found.highest > 0.0,
        "nothing is tested"
    );
    wait_for(&mut window, &format!("Legend from -{most} to {most} nodes"));
    window.get_by_label("Traced picture").click();
    let value = difference.get(SIZE / 2, SIZE / 2).unwrap();
    wait_for(&mut window, &format!("Picked: {value:+} nodes per pixel"));
}

#[test]
fn unequal_conditions_are_refused_and_the_pixels_shown() {
    let mut window = comparing(false);
    for _ in 0..4 {
        press(&mut window, Modifiers::COMMAND, Key::PageDown);
    }
    wait_for(&mut window, "May not be compared");
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
    let count = bspscope::present::number::grouped(differing as f64);
    assert!(has(&window, &format!("{differing} pixels differ: ")));
    click(&mut window, "Show the pixels");
    wait_for(
        &mut window,
        &format!("bright: the {count} pixels that differ"),
    );
    // No ratio stands where there is no comparison.
    assert_eq!(window.query_all_by_label_contains(" points").count(), 0);
    click(&mut window, "Make conditions equal");
    wait_for(&mut window, "May be compared");
    wait_for(&mut window, "equal in every pixel");
}

#[test]
fn wipe_and_flip_show_the_other_picture() {
    let mut window = comparing(true);
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
    click(&mut window, "one");
    over_picture(&mut window);
    let one = picture(&mut window);
    window.key_down(Key::F);
    window.run_steps(3);
    let flipped = picture(&mut window);
    window.key_up(Key::F);
    window.run_steps(3);
    let middle = width / 2 + 60;
    assert!(column(&one, middle) == column(&all_b, middle));
    assert!(column(&flipped, middle) == column(&all_a, middle));
    assert!(column(&picture(&mut window), middle) == column(&all_b, middle));
}

#[test]
fn what_each_kind_of_ray_did_is_listed_on_request() {
    let mut window = comparing(false);
    assert!(!has(&window, "nodes per ray, maximum"));
    click(&mut window, "per kind of ray");
    let [a, b] = ["midpoint", "sah-cut"].map(|method| measured(method, &render()).measurement);
    for figure in ray_figures() {
        for kind in [RayKind::Primary, RayKind::Shadow] {
            let values = [&a, &b].map(|m| figure.of(m, kind));
            let change = change(figure.unit, values[0], values[1]).map(|c| c.to_string());
            let texts = values.map(|value| value.map(|value| figure.unit.number(value)));
            for text in texts.into_iter().chain([change]).flatten() {
                assert!(has(&window, &text), "{}: {text}", figure.key);
            }
        }
    }
    assert!(window.query_by_label("shadow rays").is_some());
    assert!(window.query_by_label("refracted rays").is_none());
}

#[test]
fn a_comparison_that_ends_while_the_other_tree_is_rendered_leaves_nothing_running() {
    let mut start = small(SCENE);
    start.setup.render.samples = 200;
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait_for(&mut window, "May be compared");
    press(&mut window, Modifiers::NONE, Key::J);
    // With the same method, the tree behind would take the finished picture of the one in front.
    press(&mut window, Modifiers::COMMAND, Key::M);
    press(&mut window, Modifiers::COMMAND, Key::PageDown);
    wait_for(&mut window, "May not be compared");
    // From here on the tree behind is rendered with other settings.
    click(&mut window, "Make conditions equal");
    wait(&mut window, "the tree behind", |w| has(w, "A: sample"));
    press(&mut window, Modifiers::COMMAND, Key::E);
    wait(&mut window, "rest", |w| has(w, "ready"));
    finish(&mut window);
}
