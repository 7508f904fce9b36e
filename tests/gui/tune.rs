//! The task Tune: the search for the best tree, its ranking, and what can be done with a row.

use crate::harness::{
    Window, click, finish, grouped, has, open_sized, press, small, type_into, wait,
};
use crate::painted::{assert_whole, texts_in};
use bspscope::structure::{MaxDepth, Method};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, pos2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

const FIND: &str = "Find the best tree";

/// A window on the task, with a finished tiny picture.
fn on_tune<'a>(scene: &str, size: [f32; 2]) -> Window<'a> {
    let mut start = small(scene);
    start.setup.render.width = 24;
    start.setup.render.height = 16;
    let mut window = open_sized(start, size, false);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num4);
    window
}

/// Leaves only these methods chosen.
fn choose_only(window: &mut Window<'_>, methods: &[&str]) {
    for method in Method::all().filter(|m| !methods.contains(&m.name)) {
        click(window, method.name);
    }
}

/// The names of the candidates that can be used, the best first.
fn candidates(window: &Window<'_>) -> Vec<String> {
    let buttons = window.query_all_by_label_contains("Use this: ");
    let names = buttons.map(|b| b.accesskit_node().label().unwrap_or_default());
    names
        .map(|name| name["Use this: ".len()..].to_owned())
        .collect()
}

fn is_done(window: &Window<'_>) -> bool {
    window.query_by_label("Stop").is_none()
}

#[test]
fn settings_are_tried_and_a_row_becomes_the_tree() {
    // So high that all rows are in view: which ones are the best differs from run to run.
    let mut window = on_tune("tetra:2", [1600.0, 4800.0]);
    assert!(has(&window, "Which tree renders this scene fastest?"));
    choose_only(&mut window, &["midpoint", "sah", "octree"]);
    click(&mut window, FIND);
    wait(&mut window, "the first rows", |w| !candidates(w).is_empty());
    wait(&mut window, "the end", is_done);
    let found = candidates(&window);
    // One of them may be the tree on view, which is in use.
    assert!(found.len() > 3, "{found:?}");
    for name in &found {
        let method = name.split(',').next().unwrap();
        assert!(["midpoint", "sah", "octree"].contains(&method), "{name}");
    }
    let refined = |name: &&String| name.ends_with("leaf size 4");
    let wanted = found
        .iter()
        .find(refined)
        .expect("leaf sizes are tried")
        .clone();
    window
        .get_by_label(&format!("Use this: {wanted}"))
        .click_accesskit();
    window.run_steps(3);
    let build = window.state().setup().build.clone();
    assert_eq!(build.n_oilf, 4);
    assert!(wanted.starts_with(build.method.name), "{wanted}");
    if let MaxDepth::Fixed(depth) = build.d_max {
        assert!(wanted.contains(&format!(", depth {depth}, ")), "{wanted}");
    }
    finish(&mut window);
    window.get_by_label(&format!("In use: {wanted}"));
    assert!(!candidates(&window).contains(&wanted));
    // It is a change like any other.
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_ne!(window.state().setup().build, build);
}

#[test]
fn the_command_of_a_row_is_copied() {
    let mut window = on_tune("tetra:1", [1600.0, 1000.0]);
    choose_only(&mut window, &["octree"]);
    click(&mut window, FIND);
    wait(&mut window, "a row", |w| !candidates(w).is_empty());
    wait(&mut window, "the end", is_done);
    let wanted = candidates(&window)[0].clone();
    let button = format!("Copy the command that measures {wanted}");
    window.get_by_label(&button).click_accesskit();
    let copied = (0..5).find_map(|_| {
        window.step();
        let commands = &window.output().platform_output.commands;
        commands.iter().find_map(|command| match command {
            egui::OutputCommand::CopyText(text) => Some(text.clone()),
            _ => None,
        })
    });
    let copied = copied.expect("something is copied");
    assert!(copied.starts_with("bspscope measure tetra:1 "), "{copied}");
    assert!(copied.contains("--method octree"), "{copied}");
}

#[test]
fn a_stopped_search_keeps_its_rows() {
    let mut window = on_tune("balls:2", [1600.0, 1000.0]);
    click(&mut window, FIND);
    assert!(!is_done(&window));
    wait(&mut window, "two rows", |w| candidates(w).len() > 1);
    assert!(has(&window, "Best so far: "));
    press(&mut window, Modifiers::NONE, Key::Escape);
    wait(&mut window, "the end", |w| {
        has(w, "Stopped; what was measured stays.")
    });
    assert!(candidates(&window).len() > 1);
    assert!(!has(&window, "Best so far: "));
    window.get_by_label(FIND);
}

#[test]
fn building_counts_if_a_number_of_rays_is_given() {
    let mut window = on_tune("tetra:2", [1600.0, 1000.0]);
    choose_only(&mut window, &["midpoint", "sah"]);
    let find = |window: &mut Window<'_>| {
        click(window, FIND);
        wait(window, "the end", |w| {
            is_done(w) && !candidates(w).is_empty()
        });
    };
    find(&mut window);
    assert!(has(&window, " · median CPU times; "));
    click(&mut window, "Build once for");
    type_into(&mut window, "Number of rays", "5000");
    find(&mut window);
    let conditions = format!("CPU times of building and {} rays; ", grouped(5_000_u64));
    assert!(has(&window, &conditions));
    // It keeps its value while it is off.
    for is_on in [false, true] {
        click(&mut window, "Build once for");
        find(&mut window);
        assert_eq!(has(&window, &conditions), is_on);
    }
}

#[test]
fn trees_beyond_the_memory_limit_are_left_out() {
    let mut window = on_tune("tetra:5", [1600.0, 1000.0]);
    choose_only(&mut window, &["none", "midpoint"]);
    click(&mut window, "Memory limit");
    type_into(&mut window, "Most memory", "0.02");
    click(&mut window, FIND);
    wait(&mut window, "the end", is_done);
    assert!(candidates(&window).contains(&"none".to_owned()));
    assert!(has(&window, " more memory than 20.48"));
    // If no tree is small enough, the error says so.
    window.get_by_role_and_label(Role::CheckBox, "none").click();
    window.run_steps(2);
    type_into(&mut window, "Most memory", "0.001");
    click(&mut window, FIND);
    wait(&mut window, "the end", is_done);
    assert!(has(&window, "no tree is small enough: the smallest needs "));
}

#[test]
fn goal_and_all_methods_are_in_view_and_nothing_is_cut() {
    for (size, left) in [([1600.0, 1000.0], 360.0), ([1280.0, 720.0], 300.0)] {
        let mut window = on_tune("tetra:1", size);
        for method in Method::all() {
            let choice = window.get_by_label(method.name).rect();
            assert!(
                choice.right() <= left && choice.bottom() < size[1] - 32.0,
                "{}: {choice}",
                method.name
            );
        }
        let button = window.get_by_label(FIND).rect();
        // Below it is room for two lines: the progress of the search.
        assert!(button.bottom() < size[1] - 32.0 - 40.0, "{button}");
        choose_only(&mut window, &["midpoint", "sah"]);
        click(&mut window, "Least memory");
        click(&mut window, FIND);
        wait(&mut window, "the end", |w| {
            is_done(w) && !candidates(w).is_empty()
        });
        // The buttons of the last column are in the window.
        for name in candidates(&window) {
            let button = window.get_by_label(&format!("Use this: {name}")).rect();
            assert!(button.right() < size[0], "{button}");
        }
        let ranking = Rect::from_min_max(pos2(left, 40.0), pos2(size[0], 0.4 * size[1]));
        assert_whole(&window, ranking);
        let texts = texts_in(&window, ranking);
        let has = |text: &str| texts.iter().any(|t| t.rows.concat() == text);
        for title in ["#", "method", "settings", "time", "nodes", "memory"] {
            assert!(has(title), "{title}: {texts:?}");
        }
        // Below it are the studies, as tabs.
        for tab in ["Depth & leaf size", "Time by term", "Speed and error"] {
            let tab = window.get_by_label(tab).rect();
            assert!(tab.left() >= left && tab.top() > 0.35 * size[1], "{tab}");
        }
    }
}

#[test]
fn no_text_of_the_studies_is_shortened() {
    let mut window = on_tune("teaching", [1600.0, 1000.0]);
    for (tab, run) in [
        ("Depth & leaf size", "Run sweep"),
        ("Time by term", "Measure times"),
        ("Speed and error", "Measure speed and error"),
    ] {
        click(&mut window, tab);
        click(&mut window, run);
        wait(&mut window, tab, |w| w.query_by_label(run).is_some());
    }
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        window.set_size(size.into());
        window.run_steps(3);
        for (tab, shown) in [
            ("Depth & leaf size", "152 of 152 points"),
            ("Time by term", "measured T_TR: "),
            ("Speed and error", "Plot of RMSE against time"),
        ] {
            click(&mut window, tab);
            wait(&mut window, shown, |w| has(w, shown));
            let top = window.get_by_label(tab).rect().bottom();
            let texts = texts_in(&window, Rect::everything_below(top));
            assert!(texts.len() > 5, "{texts:?}");
            for text in texts {
                // Only a choice of several settings at once is too long for its column.
                let is_long = text.rows.concat().contains(", ");
                assert!(!text.is_elided || is_long, "{text:?}");
                assert!(!text.breaks_a_number(), "{text:?}");
            }
        }
    }
}
