//! The task Explore: figures that respond to changes, a picture that stays while it can, heatmaps with
//! room.

use crate::harness::{
    PATIENCE, SIZE, Window, described, finish, has, is_finished, open, open_sized,
    open_with_graphics, over_picture, press, small, wait_for,
};
use crate::support::scenes::{render_sized, scene, settings};
use bspscope::measure::{DELTA, LAMBDA, Measurement, measure, parameter};
use bspscope::present::number::Digits;
use bspscope::progress::Progress;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::Queryable as _;
use std::time::Instant;

const SIZES: [[f32; 2]; 2] = [[1600.0, 1000.0], [1280.0, 720.0]];

/// What the library measures of the small picture.
fn measured(method: &str) -> Measurement {
    let scene = scene("balls:1");
    let render = render_sized(&scene, [SIZE, SIZE]);
    let measured = measure(&scene, &settings(method), &render, &Progress::new());
    measured.unwrap().measurement
}

/// The pixels of the window where the picture is.
fn picture(window: &mut Window<'_>) -> image::RgbaImage {
    let rect = window.get_by_label("Traced picture").rect();
    let image = window.render().expect("a picture");
    let [x, y, w, h] = [rect.left(), rect.top(), rect.width(), rect.height()].map(|v| v as u32);
    image::imageops::crop_imm(&image, x, y, w, h).to_image()
}

#[test]
fn the_picture_keeps_its_pixels_while_the_method_changes() {
    let mut start = small("balls:3");
    (start.setup.render.width, start.setup.render.height) = (300, 300);
    let mut window = open_with_graphics(start);
    finish(&mut window);
    let before = picture(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::M);
    let (since, mut frames) = (Instant::now(), 0);
    while !is_finished(&window) {
        assert!(picture(&mut window) == before, "frame {frames}");
        frames += 1;
        window.run_steps(1);
        assert!(since.elapsed() < PATIENCE);
    }
    assert!(frames > 1, "nothing is tested");
    assert!(described(&window).starts_with("balls:3 · sah-cut"));
    assert!(picture(&mut window) == before);
    // With fewer bounces the picture is about to differ.
    press(&mut window, Modifiers::COMMAND, Key::PageDown);
    assert!(!is_finished(&window));
    assert!(picture(&mut window) != before);
}

#[test]
fn cards_tell_the_change_and_a_click_restores_a_result() {
    let mut window = open_sized(small("balls:1"), SIZES[0], false);
    finish(&mut window);
    let line = "Results: tests per hit";
    assert!(!has(&window, line), "a single result makes no line");
    press(&mut window, Modifiers::COMMAND, Key::M);
    finish(&mut window);
    let runs = ["midpoint", "sah-cut"].map(measured);
    let assert_change = |window: &Window<'_>, [before, now]: [&Measurement; 2]| {
        for symbol in ["N_RPRT", "N_AT", "N_LS"] {
            let p = parameter(symbol);
            let [before, now] = [before, now].map(|run| p.value(run));
            let value = p.text(now, Digits::Three);
            assert!(window.query_by_label(&value).is_some(), "{symbol} {value}");
            let change = p.change_text(before, now).expect("a change").with_before();
            assert!(has(window, &change), "{symbol}: {change}");
        }
    };
    let [midpoint, sah_cut] = &runs;
    assert_change(&window, [midpoint, sah_cut]);
    // The first result is at the left end.
    let first = window.get_by_label(line).rect().left_center() + egui::vec2(4.0, 0.0);
    window.hover_at(first);
    window.drag_at(first);
    window.run_steps(2);
    window.drop_at(first);
    window.run_steps(3);
    wait_for(&mut window, "balls:1 · midpoint");
    finish(&mut window);
    assert_change(&window, [sah_cut, midpoint]);
}

#[test]
fn all_ten_figures_are_on_one_screen_or_a_click_away() {
    for (size, all) in SIZES.into_iter().zip([true, false]) {
        let mut window = open_sized(small("balls:1"), size, false);
        finish(&mut window);
        let symbols = || DELTA.into_iter().chain(LAMBDA);
        let shown = symbols().filter(|symbol| window.query_by_label(symbol).is_some());
        assert_eq!(shown.count(), if all { 10 } else { 4 }, "{size:?}");
        let screen = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        if !all {
            window.get_by_label("Show all figures").click();
            window.run_steps(4);
        }
        for symbol in symbols() {
            let mut found = window.query_all_by_label(symbol);
            let on_screen = found.any(|node| screen.contains_rect(node.rect()));
            assert!(on_screen || !all, "{symbol}");
            let value = parameter(symbol).name;
            assert!(has(&window, &value[1..]), "{symbol}: {value}");
        }
    }
}

#[test]
fn a_click_on_a_pixel_leads_to_its_rays() {
    let mut window = open(small("balls:1"));
    finish(&mut window);
    window.get_by_label("Traced picture").click();
    window.run_steps(3);
    wait_for(&mut window, "Pixel 24, 24");
    assert!(window.query_by_label("Show all figures").is_none());
}

#[test]
fn a_heatmap_has_room_and_so_has_its_legend() {
    for size in SIZES {
        let mut window = open_sized(small("balls:1"), size, false);
        finish(&mut window);
        over_picture(&mut window);
        press(&mut window, Modifiers::NONE, Key::H);
        wait_for(&mut window, "Legend from");
        let heatmap = window.get_by_label("Traced picture").rect();
        let side = heatmap.size().min_elem();
        assert!(side >= 480.0, "{side} at {size:?}");
        let legend = window.get_by_label_contains("Legend from").rect();
        assert!(legend.top() >= heatmap.bottom() && legend.height() >= 30.0);
        assert!(legend.bottom() <= size[1] - 32.0, "{legend:?}");
    }
}
