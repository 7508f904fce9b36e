//! The sweep in the window: the rows of `bspscope sweep`, as curves and as a map, cancelled and resumed,
//! loaded and saved.

use crate::harness::{
    Window, click, finish, has, open_pane, open_sized, press, small, type_into, wait,
};
use bspscope::measure::sweep::{Axis, Form, Plan, answers, read_rows, rule_depth};
use bspscope::measure::{Class, parameter, parameters};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::setup::Value;
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

const SCENE: &str = "balls:1";

/// A window on the pane, with a finished picture.
fn on_sweep<'a>(scene: &str, size: u32) -> Window<'a> {
    let mut start = small(scene);
    start.setup.render.width = size;
    start.setup.render.height = size;
    // There is room for the curves or for the map.
    let mut window = open_sized(start, [880.0, 1200.0], false);
    finish(&mut window);
    open_pane(&mut window, "Depth & leaf size");
    window
}

/// Waits until a sweep of this number of points is complete.
fn wait_for_sweep(window: &mut Window<'_>, points: usize) {
    wait(window, "the sweep", |w| {
        has(w, &format!("{points} of {points} points")) && w.query_by_label("Run sweep").is_some()
    });
}

/// What the pane sweeps over by default, but for these leaf sizes.
fn plan(size: u32, n_oilf: &[u32]) -> Plan {
    let bases = Method::of_the_paper().into_iter().map(|method| {
        let mut setup = small(SCENE).setup;
        setup.build = BuildSettings::for_method(method);
        (setup.render.width, setup.render.height) = (size, size);
        setup
    });
    let sizes = n_oilf.iter().map(|&n| Value::Number(f64::from(n)));
    let axes = [
        Axis {
            name: "n-oilf",
            values: sizes.collect(),
        },
        Axis::of("d-max", "6..24").unwrap(),
    ];
    Plan::new(&bases.collect::<Vec<_>>(), &axes)
}

/// The points of the map, by their names.
fn cells(window: &Window<'_>) -> Vec<String> {
    let nodes = window.query_all_by_label_contains("Load ");
    let names = nodes.map(|node| node.accesskit_node().label().unwrap_or_default());
    names.filter(|name| name.contains("leaf size")).collect()
}

#[test]
fn a_sweep_has_the_rows_of_the_command_line_as_curves_and_as_a_map() {
    let mut window = on_sweep(SCENE, 24);
    type_into(&mut window, "Leaf sizes of the sweep", "1, 3");
    click(&mut window, "Run sweep");
    wait_for_sweep(&mut window, 76);
    window.get_by_label("Plot of T_TR against depth, 76 points");
    // There is not room for both.
    click(&mut window, "Map");
    assert_eq!(cells(&window).len(), 76);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.csv");
    let name = path.to_str().unwrap();
    // The rows take the place of what was there once they are complete.
    let before = folder.path().join("before.csv");
    std::fs::write(&path, "before").unwrap();
    std::fs::hard_link(&path, &before).unwrap();
    type_into(&mut window, "File for the rows", name);
    click(&mut window, "Save rows");
    wait(&mut window, "the file", |w| has(w, "76 rows in "));
    assert_eq!(std::fs::read_to_string(&before).unwrap(), "before");
    let text = std::fs::read_to_string(&path).unwrap();
    let (rows, complete) = read_rows(&text, Form::Csv).unwrap();
    assert_eq!(complete, text.len());
    let progress = Progress::new();
    let scene = load(&small(SCENE).setup.scene, &progress).unwrap();
    let plan = plan(24, &[1, 3]);
    assert_eq!(rows.len(), plan.points.len());
    for point in [0, 20, 75] {
        let expected = plan.row(&scene, point, &progress).unwrap();
        assert_eq!(rows[point].key, expected.key);
        for (place, p) in parameters()
            .iter()
            .enumerate()
            .filter(|(_, p)| p.class != Class::T)
        {
            assert_eq!(
                rows[point].values[place], expected.values[place],
                "{}",
                p.symbol
            );
        }
    }
    // The answer, the rule and the mark are those of the rows.
    let answers = answers(&rows, parameter("T_TR")).unwrap();
    assert_eq!(answers.len(), 2);
    for answer in answers {
        let sentence = answer.sentence(parameter("T_TR"));
        let sentence = sentence
            .replace("D_MAX", "depth")
            .replace("N_OILF", "leaf size");
        assert!(has(&window, &sentence), "{sentence}");
        let best = format!("Load {}, depth ", answer.best.key.method);
        let marked = cells(&window);
        let marked: Vec<_> = marked
            .iter()
            .filter(|name| name.starts_with(&best) && name.ends_with("(least)"))
            .collect();
        assert_eq!(marked.len(), 1, "{marked:?}");
        let place = format!("leaf size {}: T_TR ", answer.best.key.n_oilf);
        assert!(marked[0].contains(&place), "{marked:?}");
    }
    let rule = rule_depth(&rows[0]).unwrap();
    assert!(has(&window, &format!("[{rule}]: the rule 1.2 log2 N + 2")));
}

#[test]
fn a_cell_or_a_point_loads_its_settings_and_another_parameter_is_shown() {
    let mut window = on_sweep(SCENE, 24);
    type_into(&mut window, "Leaf sizes of the sweep", "1, 3");
    click(&mut window, "Run sweep");
    wait_for_sweep(&mut window, 76);
    click(&mut window, "Map");
    let on_view = |w: &Window<'_>, method: &str, depth: u32, n_oilf: u32| {
        let build = &w.state().setup().build;
        w.state().is_finished()
            && build.method.name == method
            && (build.d_max, build.n_oilf) == (MaxDepth::Fixed(depth), n_oilf)
    };
    let cells = cells(&window);
    let cell = |words: &str| cells.iter().find(|name| name.contains(words)).unwrap();
    click(&mut window, cell("midpoint, depth 9, leaf size 3: "));
    wait(&mut window, "the cell's settings", |w| {
        on_view(w, "midpoint", 9, 3)
    });
    // Out of sight below, but not for assistive programs.
    let other = cell("sah-cut, depth 7, leaf size 1: ");
    window.get_by_label(other).click_accesskit();
    wait(&mut window, "the other cell's settings", |w| {
        on_view(w, "sah-cut", 7, 1)
    });
    finish(&mut window);
    click(&mut window, "Curves");
    let pane = window.get_by_label("Plot of T_TR against depth, 76 points");
    let pane = pane.rect().center();
    window.hover_at(pane);
    window.run_steps(2);
    press(&mut window, egui::Modifiers::SHIFT, egui::Key::E);
    let plot = "Plot of N_AT against depth, 76 points";
    wait(&mut window, "the parameter before", |w| {
        w.query_by_label(plot).is_some()
    });
    // A point of a curve is as good as a cell.
    let point = window.get_by_label_contains("Load midpoint, depth 24, leaf size 1: N_AT ");
    point.click_accesskit();
    wait(&mut window, "the point's settings", |w| {
        on_view(w, "midpoint", 24, 1)
    });
}

#[test]
fn a_cancelled_sweep_is_resumed_after_its_last_row() {
    let mut window = on_sweep("balls:2", 200);
    click(&mut window, "Run sweep");
    wait(&mut window, "some rows", |w| {
        has(w, "of 152 points") && !has(w, "0 of 152 points")
    });
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    wait(&mut window, "the end", |w| {
        has(w, "cancelled: the rows stay")
    });
    let taken = |w: &Window<'_>| -> usize {
        let node = w.get_by_label_contains(" of 152 points");
        let text = node
            .accesskit_node()
            .value()
            .or(node.accesskit_node().label());
        text.unwrap().split(' ').next().unwrap().parse().unwrap()
    };
    let before = taken(&window);
    assert!(before > 0 && before < 152);
    click(&mut window, "Map");
    let first = cells(&window)[0].clone();
    click(&mut window, "Run sweep");
    assert!(taken(&window) >= before, "rows stay");
    wait(&mut window, "one more row", |w| taken(w) > before);
    // The time of the first row is that of the run that measured it.
    let unmarked = first.trim_end_matches(" (least)");
    assert!(has(&window, unmarked));
    // Other settings are another sweep.
    press(&mut window, egui::Modifiers::NONE, egui::Key::Escape);
    wait(&mut window, "the end", |w| {
        has(w, "cancelled: the rows stay")
    });
    type_into(&mut window, "Leaf sizes of the sweep", "none");
    assert!(
        window
            .get_by_label("Run sweep")
            .accesskit_node()
            .is_disabled()
    );
    type_into(&mut window, "Leaf sizes of the sweep", "5");
    click(&mut window, "Run sweep");
    wait(&mut window, "the other sweep", |w| has(w, " of 38 points"));
}
