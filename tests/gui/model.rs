//! The time of the picture by term of equation (1), in the window: measured in the background, for the
//! whole picture, a region and a pixel.

use crate::harness::{
    SIZE, Window, click, finish, has, open, open_pane, press, small, text_with, wait,
};
use bspscope::measure::model::{PictureTerms, Region, Term};
use bspscope::present::number::grouped;
use bspscope::primitive::PrimitiveKind;
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::build;
use bspscope::trace::RenderSettings;
use egui_kittest::kittest::Queryable as _;

const SCENE: &str = "balls:1";

/// A window on the pane, with a finished picture.
fn on_time<'a>() -> Window<'a> {
    let mut window = open(small(SCENE));
    finish(&mut window);
    open_pane(&mut window, "Time by term");
    window
}

fn measure(window: &mut Window<'_>) {
    click(window, "Measure times");
    wait(window, "the times", |w| {
        w.query_by_label("Measure times").is_some() && has(w, "Time by term: ")
    });
}

/// What the library counts in every pixel.
fn terms() -> PictureTerms {
    let (start, progress) = (small(SCENE), Progress::new());
    let scene = load(&start.setup.scene, &progress).unwrap();
    let render = RenderSettings {
        ..start.setup.render
    };
    let tree = build(&scene, &start.setup.build, &progress).unwrap();
    PictureTerms::count(&scene, &tree, &render, &progress).unwrap()
}

/// Whether the table has the counts of these pixels.
fn has_counts(window: &Window<'_>, region: Option<Region>) -> bool {
    let sum = terms().sum(region);
    let sphere = PrimitiveKind::Sphere;
    [Term::Node, Term::Miss(sphere)].into_iter().all(|term| {
        let count = grouped(sum.count(term) as f64);
        window.query_all_by_label(&count).next().is_some()
    })
}

#[test]
fn the_time_of_the_picture_is_told_by_term_beside_what_was_measured() {
    let mut window = on_time();
    assert!(has(&window, "Where does the time of this picture go?"));
    measure(&mut window);
    let bar = text_with(&window, "Time by term: ");
    for term in ["T_T + T_P: ", "T_IUN sphere: ", "\u{a0}%"] {
        assert!(bar.contains(term), "{bar}");
    }
    let about = text_with(&window, "Whole picture: ");
    assert!(
        about.contains(" predicted, ") && about.contains(" measured (T_TR), "),
        "{about}"
    );
    assert!(about.contains("T_TR of trees left out within"), "{about}");
    assert!(has(&window, "measured T_TR: "));
    assert!(has_counts(&window, None));
    // The shares are of one whole.
    let shares: Vec<f64> = bar
        .split(", ")
        .filter_map(|part| part.strip_suffix("\u{a0}%")?.parse().ok())
        .collect();
    assert!(shares.len() >= 3, "{bar}");
    assert!((shares.iter().sum::<f64>() - 100.0).abs() < 0.5, "{bar}");
    click(&mut window, "in place");
    assert!(has(&window, "without const, which is not timed in place"));
    assert!(!text_with(&window, "Time by term: ").contains("const"));
}

#[test]
fn a_region_and_a_pixel_have_their_own_time() {
    let mut window = on_time();
    measure(&mut window);
    click(&mut window, "region");
    assert!(has(&window, "No region: Shift+drag one in the picture."));
    let picture = window.get_by_label("Traced picture").rect();
    // The picture is square and fills the pane's lesser side.
    let side = picture.width().min(picture.height());
    let at = |x: f32, y: f32| {
        let corner = picture.center() - egui::Vec2::splat(side / 2.0);
        corner + egui::vec2(x + 0.5, y + 0.5) * side / SIZE as f32
    };
    window.event(egui::Event::ModifiersChanged(egui::Modifiers::SHIFT));
    window.hover_at(at(10.0, 20.0));
    window.run_steps(1);
    window.drag_at(at(10.0, 20.0));
    window.run_steps(1);
    window.hover_at(at(20.0, 25.0));
    window.run_steps(2);
    window.hover_at(at(29.0, 33.0));
    window.run_steps(2);
    window.drop_at(at(29.0, 33.0));
    window.event(egui::Event::ModifiersChanged(egui::Modifiers::NONE));
    window.run_steps(3);
    let region = Region {
        x: 10,
        y: 20,
        width: 20,
        height: 14,
    };
    let about = text_with(&window, " predicted");
    assert!(
        about.starts_with("Region of 20 × 14 pixels from 10, 20: "),
        "{about}"
    );
    assert!(has_counts(&window, Some(region)));
    assert!(!has(&window, "measured T_TR: "));
    click(&mut window, "picked pixel");
    assert!(has(&window, "No pixel is picked"));
    window.hover_at(at(12.0, 30.0));
    window.run_steps(1);
    window.drag_at(at(12.0, 30.0));
    window.drop_at(at(12.0, 30.0));
    wait(&mut window, "the pixel", |w| has(w, "Pixel 12, 30: "));
    let pixel = Region {
        x: 12,
        y: 30,
        width: 1,
        height: 1,
    };
    assert!(has_counts(&window, Some(pixel)));
}

#[test]
fn timing_is_cancelled_and_what_was_found_stays() {
    let mut start = small("balls:2");
    start.setup.render.width = 256;
    start.setup.render.height = 256;
    let mut window = open(start);
    finish(&mut window);
    open_pane(&mut window, "Time by term");
    click(&mut window, "Measure times");
    wait(&mut window, "some trees", |w| {
        has(w, " of 24 trees are timed") && !has(w, "0 of 24 trees")
    });
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    wait(&mut window, "the end", |w| {
        has(w, "cancelled: what was measured stays")
    });
    click(&mut window, "in place");
    wait(&mut window, "times in place", |w| has(w, "Time by term: "));
}
