//! The study of measures in the window: started, ended early, and its result for every set of rays and kernel.

use crate::harness::{
    Window, click, finish, has, open_pane, open_sized, press, small, text_with, type_into, wait,
};
use crate::painted::{assert_whole, texts_in};
use bspscope::measure::study::{KERNELS, Predictor};
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// The button that starts the study.
const RUN: &str = "Study measures";

/// A window on the pane, with a finished tiny picture.
fn on_study<'a>(scene: &str) -> Window<'a> {
    let mut window = open_sized(small(scene), [1280.0, 1000.0], false);
    finish(&mut window);
    open_pane(&mut window, "Measures and time");
    type_into(&mut window, "Rays per set", "32");
    type_into(&mut window, "Rounds of the study", "1");
    window
}

fn study(window: &mut Window<'_>) {
    click(window, RUN);
    wait(window, "the result", |w| has(w, "by rank correlation"));
    window.run_steps(5);
}

/// The names of the measures from the top, with the figure of their bars.
fn measures(window: &Window<'_>) -> Vec<(String, f64)> {
    let bars = Predictor::ALL
        .map(Predictor::name)
        .into_iter()
        .flat_map(|name| {
            let start = format!("{name}: ");
            let nodes = window.query_all_by_label_contains(&start);
            let bars = nodes.filter_map(|node| {
                let label = node.accesskit_node().label()?;
                let figure = label.strip_prefix(&start)?.split(' ').next()?;
                let figure: f64 = figure.replace('−', "-").parse().ok()?;
                Some((node.rect().top(), name.to_owned(), figure))
            });
            bars.collect::<Vec<_>>()
        });
    let mut bars: Vec<_> = bars.collect();
    bars.sort_by(|a, b| a.0.total_cmp(&b.0));
    bars.into_iter()
        .map(|(_, name, figure)| (name, figure))
        .collect()
}

#[test]
fn measures_are_ranked_for_every_set_of_rays_and_kernel() {
    let mut window = on_study("balls:2");
    assert!(has(&window, "Which measure predicts time?"));
    study(&mut window);
    assert!(has(&window, " · 32 rays · "));
    for rays in ["primary", "shadow", "reflected", "random"] {
        click(&mut window, rays);
        for kernel in KERNELS {
            click(&mut window, kernel.name());
            let found = measures(&window);
            // Those of a tree with boxes alone may be the same in all structures.
            assert!(found.len() > 5, "{rays} {kernel:?}: {found:?}");
            let figures: Vec<_> = found.iter().map(|(_, figure)| -figure).collect();
            assert!(figures.is_sorted(), "{rays} {kernel:?}: {found:?}");
        }
    }
    click(&mut window, "by rank correlation");
    let ranks: Vec<_> = measures(&window)
        .iter()
        .map(|(_, rank)| -rank.abs())
        .collect();
    assert!(ranks.is_sorted(), "{ranks:?}");
    // The keys do the same.
    press(&mut window, Modifiers::NONE, Key::W);
    press(&mut window, Modifiers::NONE, Key::E);
    assert!(text_with(&window, "balls:2 · ").contains(" structures · 32 rays"));
    assert!(measures(&window).len() > 5);
    let table = window.get_by_label("structures").rect();
    let below = Rect::everything_below(table.top());
    assert_whole(&window, below);
    assert!(texts_in(&window, below).len() > 40);
}

#[test]
fn a_picture_without_reflections_has_no_such_rays() {
    let mut window = on_study("tetra:3");
    study(&mut window);
    click(&mut window, "reflected");
    assert!(has(&window, "The picture has no reflected rays."));
    click(&mut window, "shadow");
    assert!(!measures(&window).is_empty());
}

#[test]
fn a_cancelled_study_leaves_nothing() {
    let mut window = on_study("balls:2");
    click(&mut window, RUN);
    assert!(window.query_by_label(RUN).is_none());
    click(&mut window, "Cancel study");
    wait(&mut window, "the end", |w| has(w, "cancelled"));
    assert!(has(&window, "Which measure predicts time?"));
    assert!(window.query_by_label("by rank correlation").is_none());
}
