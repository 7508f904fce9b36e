//! The torture set: every case by every method is right.

use bspscope::measure::stability::{CASES, Cell, KERNELS, Outcome, run};
use bspscope::progress::Progress;
use bspscope::scene::{Scene, builtin};
use bspscope::trace::thread_pool;
use bspscope::tree::Method;

fn matrix(scene: Option<&Scene>, methods: &[Method]) -> Vec<Cell> {
    run(
        scene,
        methods,
        true,
        &thread_pool(0).unwrap(),
        &Progress::new(),
    )
    .unwrap()
}

fn assert_right(cells: &[Cell]) {
    let wrong: Vec<_> = cells
        .iter()
        .filter(|cell| matches!(cell.outcome, Outcome::Fail { .. }))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_case_is_right_by_every_method() {
    let methods: Vec<Method> = Method::all().filter(|m| m.name != "none").collect();
    let cells = matrix(None, &methods);
    let cases: usize = CASES.iter().map(|(_, cases)| cases.len()).sum();
    assert!(cases >= 30 && methods.len() >= 3);
    assert_eq!(cells.len(), cases * methods.len() * KERNELS.len());
    assert_right(&cells);
    // Nothing passed because nothing was asked.
    for theme in ["transforms", "rays"] {
        let of_theme = cells.iter().filter(|cell| cell.theme == theme);
        for cell in of_theme {
            assert!(
                matches!(cell.outcome, Outcome::Pass { rays } if rays >= 100),
                "{cell:?}"
            );
        }
    }
}

#[test]
fn the_cases_for_any_scene_are_right_on_generated_ones() {
    let applicable: usize = CASES
        .iter()
        .map(|(_, c)| c.iter().filter(|c| c.any_scene).count())
        .sum();
    for (name, size) in [("tetra", 3), ("rings", 1)] {
        let scene = Scene::new(builtin::generate(name, Some(size)).unwrap());
        let cells = matrix(Some(&scene), &Method::of_the_paper());
        assert_eq!(cells.len(), applicable * 2 * KERNELS.len());
        assert_right(&cells);
    }
}
