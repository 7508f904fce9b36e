//! Speed and error in the window: measured in the background, plotted, listed, loaded and shown pixel by
//! pixel.

use crate::harness::{
    Window, click, finish, has, open, open_pane, open_sized, press, small, text_with, wait,
};
use bspscope::measure::accuracy::{choices, reference};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::setup::Setup;
use bspscope::trace::{PrecisionChoice, RenderSettings};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// The button that starts the study.
const RUN: &str = "Measure speed and error";

/// A window on the pane, with a finished picture.
fn on_study<'a>(scene: &str, size: u32) -> Window<'a> {
    let mut start = small(scene);
    start.setup.render.width = size;
    start.setup.render.height = size;
    // There is room for the table or for the error map.
    let mut window = open_sized(start, [960.0, 1600.0], false);
    finish(&mut window);
    open_pane(&mut window, "Speed and error");
    window
}

fn measure(window: &mut Window<'_>) {
    click(window, RUN);
    wait(window, "the end", |w| has(w, RUN));
    // Until nothing moves any more.
    window.run_steps(5);
}

/// Turns done and turns in all.
fn turns(window: &Window<'_>) -> [usize; 2] {
    let text = text_with(window, " turns");
    let words = text.split(" · ").find(|part| part.ends_with(" turns"));
    let mut numbers = words.unwrap().split(' ').filter_map(|n| n.parse().ok());
    [numbers.next().unwrap(), numbers.next().unwrap()]
}

#[test]
fn every_choice_is_plotted_and_listed() {
    let mut window = on_study("teaching", 24);
    measure(&mut window);
    let start = small("teaching");
    let scene = load(&start.setup.scene, &Progress::new()).unwrap();
    let render = RenderSettings {
        width: 24,
        height: 24,
        samples: 8,
        ..start.setup.render
    };
    let setup = Setup {
        render,
        ..start.setup
    };
    let expected = choices(&reference(&setup), &scene);
    assert_eq!(turns(&window), [3 * expected.len(); 2]);
    let plot = format!("Plot of RMSE against time, {} choices", expected.len());
    window.get_by_label(&plot);
    for choice in &expected {
        let point = format!("{}: ", choice.words());
        let points = window.query_all_by_label_contains(&point);
        let points = points.filter(|p| {
            let name = p.accesskit_node().label().unwrap_or_default();
            name.starts_with(&point) && name.contains("of the reference's time, RMSE ")
        });
        assert_eq!(points.count(), 1, "{point}");
    }
    window.get_by_label("reference: 1.000 of the reference's time, RMSE 0");
    window.get_by_label("Load reference");
    // Another measure of the same outcomes.
    let plot = window.get_by_label(&plot).rect();
    window.hover_at(plot.center());
    window.run_steps(2);
    press(&mut window, egui::Modifiers::NONE, egui::Key::E);
    assert!(has(&window, "Plot of max against time"));
    assert!(has(
        &window,
        "reference: 1.000 of the reference's time, max 0"
    ));
}

#[test]
fn a_row_or_a_point_loads_its_settings_and_undo_takes_them_back() {
    let mut window = on_study("teaching", 24);
    measure(&mut window);
    let used = |w: &Window<'_>, depth: u32| {
        w.state().is_finished() && w.state().setup().render.d_arec == depth
    };
    assert!(used(&window, 4));
    click(&mut window, "Load D_AREC 1");
    wait(&mut window, "the row's settings", |w| used(w, 1));
    finish(&mut window);
    let point = text_with(&window, "D_AREC 2: ");
    click(&mut window, &point);
    wait(&mut window, "the point's settings", |w| used(w, 2));
    finish(&mut window);
    for depth in [1, 4] {
        press(&mut window, egui::Modifiers::COMMAND, egui::Key::Z);
        wait(&mut window, "what was before", |w| used(w, depth));
        finish(&mut window);
    }
}

#[test]
fn the_chosen_outcomes_error_is_mapped_pixel_by_pixel() {
    let mut window = on_study("teaching", 24);
    measure(&mut window);
    click(&mut window, "Error map");
    assert!(has(&window, "Choose an outcome"));
    let point = text_with(&window, "D_AREC 0: ");
    click(&mut window, &point);
    wait(&mut window, "the map", |w| {
        w.query_by_label("Error map of D_AREC 0").is_some()
    });
    assert!(has(&window, "Legend from 0 to 0."));
    finish(&mut window);
    let map = window.get_by_label("Error map of D_AREC 0").rect();
    let at = map.min + map.size() * egui::vec2(6.5, 10.5) / 24.0;
    window.hover_at(at);
    window.run_steps(2);
    assert!(has(&window, "pixel 6, 10: ") && !has(&window, "Pixel 6, 10 (from"));
    window.drag_at(at);
    window.drop_at(at);
    // Back in the task Explore, the settings of the next choice are loaded.
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num2);
    wait(&mut window, "the pixel", |w| has(w, "Pixel 6, 10"));
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num1);
    let point = text_with(&window, "method sah-cut: ");
    click(&mut window, &point);
    wait(&mut window, "no error", |w| has(w, "No pixel differs"));
}

#[test]
fn a_cancelled_study_keeps_what_was_measured() {
    let mut window = on_study("balls:2", 256);
    click(&mut window, RUN);
    wait(&mut window, "some outcomes", |w| {
        has(w, "Plot of RMSE") && turns(w)[0] >= 2
    });
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    wait(&mut window, "the end", |w| {
        has(w, "cancelled: what was measured stays")
    });
    let [taken, of] = turns(&window);
    assert!(taken >= 2 && taken < of, "{taken} of {of}");
    assert!(has(
        &window,
        &format!("Plot of RMSE against time, {taken} choices")
    ));
    window.get_by_label("Load reference");
}

#[test]
fn the_precision_that_auto_takes_is_told_with_the_reason() {
    let mut start = small("teaching");
    start.setup.render.precision = PrecisionChoice::Auto;
    let mut window = open(start);
    finish(&mut window);
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::I);
    window.run_steps(5);
    window.get_by_label("used f32").hover();
    wait(&mut window, "the reason", |w| {
        has(w, "Used: f32, every object and every pixel is wide enough")
    });
}
