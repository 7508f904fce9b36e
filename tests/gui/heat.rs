//! Heatmaps in the window: found by their labels, compared with the library's values.

use crate::harness::{SIZE, Window, finish, has, open, over_picture, wait, wait_for};
use crate::support::scenes::{render_sized, scene, tree_by};
use bspscope::measure::heat::{HeatImage, Heatmap, PixelCounts, RayFilter, heatmap, heatmaps};
use bspscope::progress::Progress;
use bspscope::scene::SceneRequest;
use bspscope::trace::{render_counted, thread_pool};
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::sync::Mutex;

fn small() -> bspscope::gui::StartOptions {
    crate::harness::small("balls:1")
}

/// Presses a key over the middle of the picture.
fn press(window: &mut Window<'_>, modifiers: egui::Modifiers, key: egui::Key) {
    over_picture(window);
    crate::harness::press(window, modifiers, key);
}

fn plain(window: &mut Window<'_>, key: egui::Key) {
    press(window, egui::Modifiers::NONE, key);
}

/// Clicks an entry of the list above the picture.
fn choose(window: &mut Window<'_>, entry: &str) {
    window.get_by_label("Show").click();
    window.run_steps(3);
    // The legend has the name of the heatmap, too.
    let is_choice = |role| matches!(role, Role::RadioButton | Role::CheckBox);
    window
        .query_all_by_label(entry)
        .find(|node| is_choice(node.accesskit_node().role()))
        .expect("an entry of the menu")
        .click();
    window.run_steps(3);
}

/// Clicks an option of the menu above the picture, which stays open for more, and closes the menu.
fn set(window: &mut Window<'_>, option: &str) {
    choose(window, option);
    window.get_by_label("Show").click();
    window.run_steps(3);
}

fn title(heatmap: &Heatmap) -> String {
    format!("{} · {}", heatmap.symbol, heatmap.name)
}

fn show(window: &mut Window<'_>, symbol: &str) {
    let title = title(heatmap(symbol).unwrap());
    choose(window, &title);
    wait_for(window, "Legend from");
    wait_for(window, &title);
}

/// What the library counts of the small picture.
fn library_counts(method: &str) -> PixelCounts {
    let progress = Progress::new();
    let scene = scene("balls:1");
    let tree = tree_by(&scene, method);
    let render = render_sized(&scene, [SIZE, SIZE]);
    let counts = Mutex::new(PixelCounts::new(SIZE, SIZE));
    let pool = thread_pool(2).unwrap();
    render_counted(&scene, &tree, &render, &pool, &progress, |part| {
        counts.lock().unwrap().add(&part);
    })
    .unwrap();
    counts.into_inner().unwrap()
}

fn library_image(symbol: &str, rays: RayFilter) -> HeatImage {
    heatmap(symbol)
        .unwrap()
        .image(&library_counts("midpoint"), rays)
}

/// The label of the legend's color bar.
fn legend(window: &Window<'_>) -> String {
    let node = window.get_by_label_contains("Legend from");
    node.accesskit_node().label().expect("a label")
}

#[test]
fn every_heatmap_comes_up_by_list_and_by_key_with_symbol_and_unit() {
    let mut window = open(small());
    finish(&mut window);
    assert!(!has(&window, "Legend from"));
    assert!(!heatmaps().is_empty());
    for heatmap in heatmaps() {
        plain(&mut window, egui::Key::H);
        wait(&mut window, heatmap.symbol, |w| {
            has(w, &title(heatmap)) && has(w, "Legend from")
        });
        assert!(
            legend(&window).ends_with(heatmap.unit),
            "{}",
            heatmap.symbol
        );
    }
    plain(&mut window, egui::Key::H);
    assert!(
        !has(&window, "Legend from"),
        "the picture comes after the last"
    );
    press(&mut window, egui::Modifiers::SHIFT, egui::Key::H);
    wait_for(&mut window, &title(heatmaps().last().unwrap()));
    for heatmap in heatmaps() {
        show(&mut window, heatmap.symbol);
        wait(&mut window, "its unit", |w| {
            has(w, "Legend from") && legend(w).ends_with(heatmap.unit)
        });
    }
    choose(&mut window, "Picture");
    assert!(!has(&window, "Legend from"));
}

#[test]
fn the_scale_is_linear_or_logarithmic() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_IT");
    assert!(has(&window, "tests per pixel · all rays · linear scale"));
    let found = library_image("N_IT", RayFilter::All).statistics().unwrap();
    assert!(has(
        &window,
        &format!("From {} to {}, mean", found.lowest, found.highest)
    ));
    plain(&mut window, egui::Key::G);
    wait_for(&mut window, "· log scale");
    set(&mut window, "Logarithmic scale");
    wait_for(&mut window, "· linear scale");
}

#[test]
fn one_kind_of_rays_is_told_from_all() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_IT");
    set(&mut window, "Shadow");
    wait_for(&mut window, "· shadow rays ·");
    let found = library_image("N_IT", RayFilter::Shadow)
        .statistics()
        .unwrap();
    let range = format!("Legend from {} to {} tests", found.lowest, found.highest);
    assert!(has(&window, &range), "{} is not {range}", legend(&window));
    // Depth complexity is of the primary ray alone.
    show(&mut window, "D_COMPX");
    wait(&mut window, "all rays", |w| !has(w, "· shadow rays ·"));
    show(&mut window, "N_IT");
    wait_for(&mut window, "· shadow rays ·");
}

#[test]
fn a_locked_range_survives_another_tree() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_IT");
    let before = legend(&window);
    plain(&mut window, egui::Key::R);
    wait_for(&mut window, "· locked");
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    wait_for(&mut window, "balls:1 · sah-cut");
    finish(&mut window);
    wait_for(&mut window, "Legend from");
    assert_eq!(legend(&window), before);
    plain(&mut window, egui::Key::R);
    let found = heatmap("N_IT")
        .unwrap()
        .image(&library_counts("sah-cut"), RayFilter::All)
        .statistics()
        .unwrap();
    let range = format!("Legend from {} to {} tests", found.lowest, found.highest);
    assert_ne!(before, format!("{range} per pixel"), "nothing is tested");
    wait_for(&mut window, &range);
}

#[test]
fn pointer_and_picked_pixel_have_the_librarys_values() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_NODES");
    let image = library_image("N_NODES", RayFilter::All);
    // Without a picked pixel, an arrow key picks the one in the center.
    plain(&mut window, egui::Key::ArrowLeft);
    let value = image.get(24, 24).unwrap();
    wait_for(&mut window, &format!("Picked: {value} nodes per pixel"));
    assert!(has(&window, &format!("Pointer: {value} nodes per pixel")));
    assert!(has(
        &window,
        &format!("Pixel 24, 24: N_NODES {value} nodes")
    ));
    plain(&mut window, egui::Key::ArrowLeft);
    let value = image.get(23, 24).unwrap();
    wait_for(&mut window, &format!("Picked: {value} nodes per pixel"));
    // Where nothing is hit there are no tests per hit.
    show(&mut window, "N_RPRT");
    set(&mut window, "Reflected");
    wait_for(&mut window, "· reflected rays ·");
    let ratios = library_image("N_RPRT", RayFilter::Reflected);
    let without = ratios.values.iter().filter(|v| v.is_nan()).count();
    assert!(without > 0, "nothing is tested");
    let without = bspscope::present::number::grouped(without as f64);
    assert!(has(&window, &format!("white: no value ({without})")));
}

#[test]
fn the_most_expensive_pixels_are_picked_in_order() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_IT");
    let image = library_image("N_IT", RayFilter::All);
    let mut order: Vec<usize> = (0..image.values.len()).collect();
    order.sort_by(|&a, &b| image.values[b].total_cmp(&image.values[a]).then(a.cmp(&b)));
    // The task that names the picked pixel.
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num2);
    let is_picked = |window: &Window<'_>, rank: usize| {
        let (x, y) = (order[rank] as u32 % SIZE, order[rank] as u32 / SIZE);
        let value = image.values[order[rank]];
        has(window, &format!("Pixel {x}, {y}"))
            && has(
                window,
                &format!("{value} · rank {} of 2\u{a0}304", rank + 1),
            )
    };
    plain(&mut window, egui::Key::N);
    wait(&mut window, "the maximum", |w| is_picked(w, 0));
    window.get_by_label("Next costliest pixel").click();
    wait(&mut window, "the second", |w| is_picked(w, 1));
    plain(&mut window, egui::Key::N);
    wait(&mut window, "the third", |w| is_picked(w, 2));
    press(&mut window, egui::Modifiers::SHIFT, egui::Key::N);
    wait(&mut window, "the second again", |w| is_picked(w, 1));
    // A pixel picked by hand has no rank; from it the way begins at the top.
    plain(&mut window, egui::Key::ArrowLeft);
    wait(&mut window, "no rank", |w| !has(w, "rank "));
    plain(&mut window, egui::Key::N);
    wait(&mut window, "the maximum again", |w| is_picked(w, 0));
}

#[test]
fn the_most_expensive_pixel_is_that_of_the_heatmap_chosen_last() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_NODES");
    plain(&mut window, egui::Key::N);
    wait_for(&mut window, "rank 1 of 2\u{a0}304");
    // Both keys in one frame: the next heatmap's values are not there yet.
    window.key_press(egui::Key::H);
    window.key_press(egui::Key::N);
    window.run_steps(2);
    let found = library_image("N_INODES", RayFilter::All)
        .statistics()
        .unwrap();
    let picked = format!("Picked: {} inner nodes per pixel · rank 1", found.highest);
    wait_for(&mut window, &picked);
}

#[test]
fn without_counts_the_picture_stays_and_a_note_says_why() {
    let mut start = small();
    start.setup.scene = SceneRequest::parse("balls:4");
    start.setup.render.width = 2001;
    start.setup.render.height = 2000;
    let mut window = open(start);
    // The picture is not there at once, and if it were, it would be too large to be counted.
    choose(&mut window, &title(&heatmaps()[0]));
    assert!(has(&window, "Counting begins") || has(&window, "Only pictures of up to"));
    wait_for(
        &mut window,
        "Only pictures of up to 4\u{a0}000\u{a0}000 pixels",
    );
    assert!(!has(&window, "Legend from"));
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
}

#[test]
fn what_was_cancelled_before_it_was_counted_says_so() {
    let mut start = small();
    start.setup.scene = SceneRequest::parse("balls:4");
    start.setup.render.width = 1900;
    start.setup.render.height = 1900;
    let mut window = open(start);
    choose(&mut window, &title(&heatmaps()[0]));
    assert!(has(&window, "Counting begins"));
    wait_for(&mut window, "balls:4 · midpoint");
    assert!(has(&window, "Counting begins"));
    window.key_press(egui::Key::Escape);
    wait_for(&mut window, "Not counted: the picture was cancelled");
}

#[test]
fn times_come_by_a_pass_of_their_own_and_belong_to_one_picture() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "T_PIXEL");
    assert!(legend(&window).ends_with("µs per pixel"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::M);
    // Times of the tree before are not shown with the new one.
    wait(&mut window, "new times", |w| {
        has(w, "balls:1 · sah-cut") && has(w, "Legend from")
    });
    finish(&mut window);
    plain(&mut window, egui::Key::N);
    wait_for(&mut window, "rank 1 of 2\u{a0}304");
}

#[test]
fn colors_ends_of_the_range_and_blending_are_set_in_a_menu() {
    let mut window = open(small());
    finish(&mut window);
    show(&mut window, "N_IT");
    window.get_by_label("Show").click();
    window.run_steps(3);
    window.get_by_label("blue-red").click();
    let most = library_image("N_IT", RayFilter::All)
        .statistics()
        .unwrap()
        .highest;
    // A diverging map has its middle at zero.
    let range = format!("Legend from −{most} to {most} tests");
    wait_for(&mut window, &range);
    let field = |window: &Window<'_>, name: &str, value: f64| {
        window
            .get_by_role_and_label(egui::accesskit::Role::SpinButton, name)
            .set_value_accesskit(value);
    };
    field(&window, "Range from", 1.0);
    wait_for(&mut window, &format!("locked 1 to {most}"));
    field(&window, "Range to", 3.0);
    wait_for(&mut window, "Legend from 1 to 3 tests");
    let slider = egui::accesskit::Role::Slider;
    window
        .get_by_role_and_label(slider, "Over the picture")
        .set_value_accesskit(40.0);
    wait_for(&mut window, "40 % over the picture");
    window.get_by_label("Span this picture's values").click();
    let least = library_image("N_IT", RayFilter::All)
        .statistics()
        .unwrap()
        .lowest;
    wait_for(&mut window, &format!("Legend from {least} to {most} tests"));
}

#[test]
fn measuring_times_is_cancelled_and_begun_anew() {
    let mut start = small();
    start.setup.render.width = 400;
    start.setup.render.height = 400;
    start.setup.scene = SceneRequest::parse("balls:3");
    let mut window = open(start);
    finish(&mut window);
    choose(&mut window, &title(heatmap("T_PIXEL").unwrap()));
    // The pass may be over before it is cancelled: then there is nothing to begin anew.
    wait(&mut window, "the pass", |w| {
        has(w, "Cancel timing") || has(w, "Legend from")
    });
    if let Some(button) = window.query_by_label("Cancel timing") {
        button.click();
        wait(&mut window, "its end", |w| {
            has(w, "Not timed: cancelled") || has(w, "Legend from")
        });
        if let Some(button) = window.query_by_label("Measure times") {
            button.click();
        }
    }
    wait_for(&mut window, "Legend from");
}
