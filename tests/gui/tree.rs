//! The window's panes about the tree: outline, find, histograms, icicle and split cost, found by
//! their labels.

use crate::harness::{Window, click, finish, grouped, has, open_sized, press, small, wait};
use crate::painted::{assert_whole, texts_in};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::{BuildSettings, Method, Tree, build};
use bspscope::trace::{RenderSettings, Visits, count_visits, thread_pool};
use egui::accesskit::Role;
use egui::{Event, PointerButton, Pos2, Rect, pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// A window with a finished picture and the outline; with the 3D view where `graphics`.
fn open<'a>(scene: &str, method: &str, graphics: bool) -> Window<'a> {
    let mut start = small(scene);
    start.setup.build = BuildSettings::for_method(Method::named(method).unwrap());
    // So high that the legend of the 3D view is not folded.
    let height = if graphics { 1600.0 } else { 1000.0 };
    let mut window = open_sized(start, [1500.0, height], graphics);
    click(&mut window, "Outline");
    // Until then what is counted comes in and moves what a test clicks at.
    finish(&mut window);
    window
}

/// Returns the text of the first label that contains this.
fn first_text_with(window: &Window<'_>, part: &str) -> String {
    let node = window
        .query_all_by_label_contains(part)
        .next()
        .unwrap_or_else(|| panic!("no label with {part}"));
    let node = node.accesskit_node();
    node.label().or(node.value()).unwrap_or_default()
}

/// Looks for nodes and waits for what the line then says.
fn find(window: &mut Window<'_>, query: &str, says: &str) {
    let field = window.get_by_role_and_label(Role::TextInput, "Find nodes");
    field.focus();
    field.type_text(query);
    wait(window, says, |w| has(w, says));
}

#[test]
fn the_outline_unfolds_from_the_root() {
    let mut window = open("balls:1", "midpoint", false);
    assert!(window.query_by_label("node 0").is_some());
    assert!(window.query_by_label("node 1").is_some());
    assert!(window.query_by_label("node 2").is_none());
    click(&mut window, "Unfold node 1");
    assert!(window.query_by_label("node 2").is_some());
    click(&mut window, "Fold node 0");
    assert!(window.query_by_label("node 1").is_none());
}

#[test]
fn the_outline_is_whole_at_1280_points() {
    let mut window = open_sized(small("balls:1"), [1280.0, 720.0], false);
    click(&mut window, "Outline");
    finish(&mut window);
    for title in ["exp. nodes", "visits"] {
        let header = window.get_by_label(title).rect();
        assert!(header.right() <= 1280.0, "{title}: {header}");
    }
    // Down to a leaf, whose reason is the longest text of its column.
    click(&mut window, "Less visited");
    window.run_steps(3);
    let top = window.get_by_label("exp. nodes").rect().top();
    assert!(listed_leaves(&window) > 0);
    assert_whole(&window, Rect::everything_below(top));
}

#[test]
fn a_node_selected_in_the_outline_is_marked_in_3d() {
    let mut window = open("balls:1", "midpoint", true);
    assert!(!has(&window, "thick box"));
    click(&mut window, "node 0");
    assert!(has(&window, "Selected: node 0, depth 0"));
    assert!(has(
        &window,
        "thick box: selected node 0, depth 0; crossed: x ="
    ));
    // Keys walk on while the pointer is over the outline.
    window.key_press(egui::Key::ArrowDown);
    window.run_steps(3);
    assert!(has(&window, "thick box: selected node 1, depth 1"));
    window.key_press(egui::Key::ArrowLeft);
    window.run_steps(3);
    assert!(has(&window, "Selected: node 0"));
}

#[test]
fn a_leaf_clicked_in_3d_is_selected_in_the_outline() {
    let mut window = open("balls:1", "midpoint", true);
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.center());
    window.run_steps(2);
    // All leaves, rather than the cells above them.
    window.key_press(egui::Key::X);
    window.run_steps(2);
    click(&mut window, "3D view of scene and tree");
    wait(&mut window, "the leaf", |w| has(w, "Selected: node"));
    let node = first_text_with(&window, "Selected: node");
    let node = node["Selected: ".len()..]
        .split(',')
        .next()
        .unwrap()
        .to_owned();
    assert!(window.query_by_label(&node).is_some(), "{node} is listed");
    assert!(has(&window, "a leaf with"));
}

#[test]
fn nodes_are_found_and_walked_through() {
    let mut window = open("balls:1", "midpoint", false);
    find(&mut window, "objects > 1", "Next match");
    wait(&mut window, "matches", |w| {
        !w.get_by_label("Next match").accesskit_node().is_disabled()
    });
    click(&mut window, "Next match");
    assert!(has(&window, "match 1 of"));
    assert!(has(&window, "a leaf with"));
    let first = first_text_with(&window, "Selected: node");
    click(&mut window, "Next match");
    assert!(has(&window, "match 2 of"));
    assert_ne!(first_text_with(&window, "Selected: node"), first);
    click(&mut window, "Previous match");
    assert_eq!(first_text_with(&window, "Selected: node"), first);
    find(&mut window, " or", "expected a number after 'objects'");
}

#[test]
fn a_picked_object_leads_to_its_leaves() {
    let mut window = open("balls:1", "midpoint", true);
    click(&mut window, "Traced picture");
    wait(&mut window, "the object", |w| has(w, "is in"));
    // The task Ray shows only the ray's leaves in 3D.
    press(&mut window, egui::Modifiers::COMMAND, egui::Key::Num1);
    wait(&mut window, "the leaves in 3D", |w| has(w, "thin red: "));
    window.get_by_label_contains(" is in ").click();
    wait(&mut window, "the leaves", |w| listed_leaves(w) > 0);
}

/// Leaves among the rows of the outline.
fn listed_leaves(window: &Window<'_>) -> usize {
    window
        .query_all_by_label_contains("leaf: ")
        .filter(|node| node.accesskit_node().role() == Role::Label)
        .count()
}

#[test]
fn brushing_a_histogram_changes_the_leaves_shown() {
    let mut window = open("balls:1", "midpoint", true);
    click(&mut window, "Histograms");
    wait(&mut window, "the histograms", |w| has(w, "leaves selected"));
    let all = first_text_with(&window, "leaves selected");
    let of = all
        .split(" of ")
        .nth(1)
        .unwrap()
        .trim_end_matches(" leaves selected")
        .to_owned();
    assert!(has(&window, &format!("of {of} leaves shown")));
    let bars = window.get_by_label("Histogram: Leaf depth").rect();
    let y = bars.center().y;
    window.drag_at(egui::pos2(bars.left() + 40.0, y));
    window.run_steps(2);
    window.hover_at(egui::pos2(bars.center().x, y));
    window.run_steps(2);
    window.drop_at(egui::pos2(bars.center().x, y));
    window.run_steps(3);
    let some = first_text_with(&window, "leaves selected");
    assert_ne!(some, all);
    let count = some.split(" of ").next().unwrap().to_owned();
    assert!(has(&window, &format!("{count} of {of} leaves shown")));
    // Keys count where the pointer is.
    window.hover_at(egui::pos2(bars.center().x, y));
    window.run_steps(2);
    window.key_press(egui::Key::Delete);
    window.run_steps(3);
    assert_eq!(first_text_with(&window, "leaves selected"), all);
}

/// What the library counts of the picture that [`open`] shows.
fn expected_visits(scene: &str, method: &str) -> (Tree, Visits) {
    let start = small(scene);
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    let settings = BuildSettings::for_method(Method::named(method).unwrap());
    let tree = build(&scene, &settings, &progress).unwrap();
    let render = RenderSettings {
        ..start.setup.render
    };
    let pool = thread_pool(2).unwrap();
    let visits = count_visits(&scene, &tree, &render, &pool, &progress).unwrap();
    (tree, visits)
}

#[test]
fn visits_of_the_picture_are_told_and_lead_to_the_leaves_visited_most() {
    let mut window = open("balls:1", "midpoint", false);
    let (tree, visits) = expected_visits("balls:1", "midpoint");
    let root = format!("{} · ", grouped(visits.by_node[0]));
    wait(&mut window, "the visits", |w| has(w, &root));
    assert!(window.query_by_label("exp. nodes").is_some());
    let leaves = visits.leaves_by_visits(&tree);
    let selected = |w: &Window<'_>, leaf: u32| has(w, &format!("Selected: node {leaf}, "));
    click(&mut window, "Less visited");
    assert!(selected(&window, leaves[0]));
    click(&mut window, "Less visited");
    assert!(selected(&window, leaves[1]));
    click(&mut window, "More visited");
    assert!(selected(&window, leaves[0]));
    let never = visits.by_node.iter().filter(|&&n| n == 0).count();
    assert!(never > 1);
    find(
        &mut window,
        "visits 0",
        &format!("{} matches", grouped(never)),
    );
    click(&mut window, "Next match");
    let node = first_text_with(&window, "Selected: node ");
    let node = node["Selected: node ".len()..].split(',').next().unwrap();
    assert_eq!(visits.by_node[node.parse::<usize>().unwrap()], 0);
}

#[test]
fn leaves_are_coloured_and_filtered_by_visits() {
    let mut window = open("balls:1", "midpoint", true);
    let (tree, visits) = expected_visits("balls:1", "midpoint");
    let leaves = visits.leaves_by_visits(&tree);
    let is_never = |leaf: &&u32| visits.by_node[**leaf as usize] == 0;
    let never = leaves.iter().filter(is_never).count();
    assert!(never > 0 && never < leaves.len());
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.center());
    window.run_steps(2);
    for (says, count) in [
        ("leaves shown: visited by the picture", leaves.len() - never),
        ("leaves shown: never visited", never),
    ] {
        window.key_press(egui::Key::N);
        wait(&mut window, says, |w| has(w, says));
        let shown = format!("{count} of {} leaves shown", leaves.len());
        assert!(has(&window, &shown), "{shown}");
    }
    for _ in 0..4 {
        window.key_press(egui::Key::C);
        window.run_steps(2);
    }
    wait(&mut window, "the colouring", |w| {
        has(w, "Visits (rays of the picture that visited it)")
    });
}

#[test]
fn rays_by_nodes_have_a_histogram_that_can_be_brushed() {
    let mut window = open("balls:1", "midpoint", false);
    let (_, visits) = expected_visits("balls:1", "midpoint");
    click(&mut window, "Histograms");
    wait(&mut window, "the visits", |w| {
        has(w, "leaves selected") && !has(w, "visits: counted") && !has(w, "counting visits")
    });
    for name in ["Visits per leaf", "Nodes per ray"] {
        let clear = |w: &Window<'_>| {
            !w.get_by_label("Clear ranges")
                .accesskit_node()
                .is_disabled()
        };
        assert!(!clear(&window));
        let plot = window.get_by_label(&format!("Histogram: {name}")).rect();
        let at = egui::pos2(plot.left() + 60.0, plot.center().y);
        window.drag_at(at);
        window.drop_at(at);
        window.run_steps(3);
        assert!(clear(&window), "{name}");
        if name == "Nodes per ray" {
            // Exactly the pixels that the library finds are named.
            wait(&mut window, "the pixels", |w| has(w, "others hatched"));
            let text = first_text_with(&window, "others hatched");
            let nodes = text.split("a ray of ").nth(1).unwrap();
            let nodes = nodes.split(" nodes").next().unwrap();
            let mut ends = nodes.split(" to ").map(|n| n.parse::<u32>().unwrap());
            let lo = ends.next().unwrap();
            let pixels = visits.pixels_within([lo, ends.next().unwrap_or(lo)]).len();
            assert!(pixels > 0);
            let pixels = grouped(pixels);
            assert!(text.starts_with(&format!("{pixels} pixels")), "{text}");
        }
        click(&mut window, "Clear ranges");
    }
}

#[test]
fn the_icicle_is_coloured_by_every_histogram() {
    let mut window = open("balls:1", "midpoint", false);
    click(&mut window, "Icicle");
    for (title, unit) in [
        ("Objects", "Objects (objects in a leaf)"),
        ("Volume", "Volume (cubed units of length)"),
        ("Visits", "Visits (rays of the picture that visited it)"),
        ("Depth", "Depth (levels below the root)"),
    ] {
        let shade = |node: &egui_kittest::Node<'_>| {
            node.value().is_some_and(|value| value.starts_with("Shade"))
        };
        let combo = window.query_all_by_role(Role::ComboBox).find(shade);
        combo.expect("the list of colourings").click();
        window.run_steps(3);
        window.get_by_role_and_label(Role::Button, title).click();
        wait(&mut window, unit, |w| has(w, unit));
    }
}

/// Presses the button here, moves and releases it there, all in as many frames as there are lists.
fn drag(window: &mut Window<'_>, frames: &[&[Event]]) {
    for events in frames {
        window.input_mut().events.extend(events.iter().cloned());
        window.step();
    }
    window.run_steps(3);
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: egui::Modifiers::NONE,
    }
}

/// A slow and a quick drag between the same two points: in the quick one the button is released in the
/// frame of the last move.
fn slow_and_quick(from: Pos2, to: Pos2) -> [Vec<Vec<Event>>; 2] {
    let middle = from + (to - from) * 0.5;
    let moved = Event::PointerMoved;
    [
        vec![
            vec![moved(from)],
            vec![button(from, true)],
            vec![moved(middle)],
            vec![moved(to)],
            vec![moved(to)],
            vec![button(to, false)],
        ],
        vec![
            vec![moved(from)],
            vec![button(from, true)],
            vec![moved(middle)],
            vec![moved(to), button(to, false)],
        ],
    ]
}

#[test]
fn a_quick_drag_ends_where_the_button_is_released() {
    let mut window = open("balls:1", "sah-cut", false);
    click(&mut window, "node 0");
    for (pane, plot, result, undo) in [
        ("Split cost", "Cost along x", "what if x = ", "Undo what-if"),
        (
            "Histograms",
            "Histogram: Leaf depth",
            "Leaf depth: ",
            "Clear ranges",
        ),
    ] {
        click(&mut window, pane);
        wait(&mut window, pane, |w| w.query_by_label(plot).is_some());
        let plot = window.get_by_label(plot).rect();
        let at = |x: f32| pos2(plot.left() + x * plot.width(), plot.center().y);
        let ends = slow_and_quick(at(0.3), at(0.8)).map(|frames| {
            let frames: Vec<_> = frames.iter().map(Vec::as_slice).collect();
            drag(&mut window, &frames);
            let texts = texts_in(&window, Rect::EVERYTHING);
            let mut texts = texts.into_iter().map(|text| text.rows.concat());
            let found = texts.find(|text| text.starts_with(result));
            click(&mut window, undo);
            found.unwrap_or_else(|| panic!("{pane}: nothing was selected"))
        });
        assert_eq!(ends[0], ends[1], "{pane}");
    }
}

#[test]
fn the_texts_of_the_histograms_are_whole() {
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        let mut window = open_sized(small("balls:2"), size, false);
        click(&mut window, "Histograms");
        finish(&mut window);
        let top = window.get_by_label("Histogram: Leaf depth").rect().top();
        assert_whole(&window, Rect::everything_below(top));
    }
}

#[test]
fn the_axes_of_the_split_cost_have_numbers() {
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        let mut window = open_sized(small("balls:1"), size, false);
        click(&mut window, "Outline");
        finish(&mut window);
        click(&mut window, "node 0");
        click(&mut window, "Split cost");
        for axis in ["x", "y", "z"] {
            let plot = window.get_by_label(&format!("Cost along {axis}")).rect();
            let below = Rect::from_min_size(plot.left_bottom(), vec2(plot.width(), 20.0));
            let left = Rect::from_min_size(
                plot.left_top() - vec2(44.0, 8.0),
                vec2(44.0, plot.height() + 16.0),
            );
            for side in [below, left] {
                let texts = texts_in(
                    &window,
                    side.intersect(Rect::from_min_size(Pos2::ZERO, size.into())),
                );
                let numbers = texts
                    .iter()
                    .filter_map(|t| t.rows.concat().parse::<f64>().ok());
                let numbers: Vec<f64> = numbers.collect();
                assert!(numbers.len() >= 2, "{axis}: {texts:?}");
            }
        }
    }
}

#[test]
fn the_selected_cell_is_outlined_in_the_picture() {
    let mut window = open("balls:1", "midpoint", true);
    click(&mut window, "node 0");
    click(&mut window, "node 1");
    let picture = window.get_by_label("Traced picture").rect();
    window.hover_at(picture.center());
    window.run_steps(3);
    let orange = |window: &mut Window<'_>| {
        let image = window.render().unwrap();
        let inside = |x: u32, y: u32| picture.contains(egui::pos2(x as f32, y as f32));
        let pixels = image.enumerate_pixels();
        pixels
            .filter(|(x, y, pixel)| inside(*x, *y) && pixel.0[..3] == [255, 176, 0])
            .count()
    };
    let with = orange(&mut window);
    assert!(with > 100, "{with}");
    window.key_press(egui::Key::S);
    window.run_steps(3);
    assert_eq!(orange(&mut window), 0);
    window.key_press(egui::Key::S);
    window.run_steps(3);
    assert!(orange(&mut window) > 100);
}

#[test]
fn the_icicle_selects_nodes() {
    let mut window = open("balls:1", "midpoint", false);
    click(&mut window, "Icicle");
    let icicle = window.get_by_label("Icicle of the tree").rect();
    window.hover_at(icicle.center_top() + egui::vec2(0.0, 4.0));
    window.run_steps(2);
    window.drag_at(icicle.center_top() + egui::vec2(0.0, 4.0));
    window.drop_at(icicle.center_top() + egui::vec2(0.0, 4.0));
    window.run_steps(3);
    click(&mut window, "Outline");
    assert!(has(&window, "Selected: node 0"));
}

#[test]
fn the_cost_of_the_chosen_plane_is_told_and_other_planes_can_be_tried() {
    let mut window = open("balls:1", "sah-cut", true);
    click(&mut window, "node 0");
    click(&mut window, "Split cost");
    wait(&mut window, "the cost", |w| has(w, "node 0: chosen"));
    let text = first_text_with(&window, "node 0: chosen");
    assert!(
        text.contains("below") && text.contains("cost") && text.contains("tests"),
        "{text}"
    );
    assert!(has(&window, "Drag or click in a curve"));
    click(&mut window, "Cost along y");
    wait(&mut window, "the plane", |w| has(w, "what if y ="));
    assert!(
        has(&window, "tests more than the chosen plane")
            || has(&window, "tests fewer than the chosen plane")
    );
    assert!(has(&window, "crossed: what if y ="));
    window.key_press(egui::Key::Escape);
    window.run_steps(3);
    assert!(!has(&window, "what if y ="));
}
