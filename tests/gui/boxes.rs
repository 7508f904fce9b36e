//! Bounding volume hierarchies in every task and pane, found by labels.

use crate::harness::{
    SIZE, Window, click, finish, grouped, has, open, open_sized, over_picture, press, small, wait,
};
use bspscope::gui::StartOptions;
use bspscope::lesson::LESSONS;
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::split::Structure;
use bspscope::structure::{BuildSettings, Method, Moment, NodeKind, Tree, TreeIndex, build};
use bspscope::trace::{LeafOutcome, RayPath, Step, record_pixel};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

fn start(scene: &str, method: &str) -> StartOptions {
    let mut start = small(scene);
    start.setup.build = BuildSettings::for_method(Method::named(method).unwrap());
    start
}

/// The tree on view, and facts of its nodes.
fn expected(scene: &str) -> (Tree, TreeIndex) {
    let start = start(scene, "bvh-sweep");
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    let tree = build(&scene, &start.setup.build, &progress).unwrap();
    let index = TreeIndex::new(&tree, scene.objects().len());
    (tree, index)
}

/// A window with a finished picture, so high that no legend is folded.
fn opened<'a>(scene: &str) -> Window<'a> {
    let mut window = open_sized(start(scene, "bvh-sweep"), [1500.0, 1500.0], true);
    finish(&mut window);
    window
}

fn over_view(window: &mut Window<'_>) {
    let view = window.get_by_label("3D view of scene and tree").rect();
    window.hover_at(view.right_top() + egui::vec2(-4.0, 4.0));
    window.run_steps(2);
}

/// The objects of each child, as the window says it.
fn parts(tree: &Tree, index: &TreeIndex, node: u32) -> String {
    let children = tree.child_nodes(node);
    let objects: Vec<_> = children
        .map(|child| grouped(index.of(child).objects))
        .collect();
    objects.join(" + ")
}

#[test]
fn a_selected_node_shows_the_boxes_of_its_children_and_what_splitting_it_costs() {
    let (tree, index) = expected("balls:1");
    let mut window = opened("balls:1");
    click(&mut window, "Outline");
    assert!(has(&window, "boxes, or why a leaf"));
    let objects = parts(&tree, &index, 0);
    assert!(has(&window, &format!("{objects} objects")), "{objects}");
    click(&mut window, "node 0");
    assert!(has(&window, "thick box: selected node 0, depth 0"));
    assert!(has(&window, "blue boxes: its children"));
    assert!(has(&window, "they do not overlap") || has(&window, "violet: where they overlap, "));
    assert!(!has(&window, "crossed: "));
    click(&mut window, "Split cost");
    wait(&mut window, "the cost", |w| {
        has(w, "node 0: chosen centers at")
    });
    assert!(has(&window, "Drag or click in a curve to try other boxes"));
    click(&mut window, "Cost along y");
    wait(&mut window, "the boxes", |w| {
        has(w, "what if centers at y =")
    });
    assert!(
        has(&window, "more than the chosen boxes") || has(&window, "fewer than the chosen boxes")
    );
    assert!(has(&window, "blue boxes: what if it were divided at y ="));
    window.key_press(Key::Escape);
    window.run_steps(3);
    assert!(has(&window, "blue boxes: its children"));
    // A leaf has no children.
    let leaf = (0..)
        .find(|&node| tree.kind(node) != NodeKind::Inner)
        .unwrap();
    for _ in 0..leaf {
        click(&mut window, "Outline");
        let row = window.get_by_label_contains("Selected: node").rect();
        window.hover_at(row.left_bottom() + egui::vec2(40.0, 60.0));
        window.run_steps(2);
        press(&mut window, Modifiers::NONE, Key::ArrowRight);
        press(&mut window, Modifiers::NONE, Key::ArrowRight);
        if has(&window, &format!("Selected: node {leaf},")) {
            break;
        }
    }
    assert!(has(&window, &format!("Selected: node {leaf}, ")));
    assert!(!has(&window, "blue boxes"));
    for pane in ["Icicle", "Histograms"] {
        click(&mut window, pane);
    }
    assert!(has(&window, "leaves selected"));
}

#[test]
fn a_subtree_stands_out_in_3d() {
    let (tree, index) = expected("balls:2");
    let mut window = opened("balls:2");
    over_view(&mut window);
    press(&mut window, Modifiers::NONE, Key::X);
    let all = grouped(index.of(0).leaves);
    assert!(has(&window, &format!("{all} of {all} leaves shown")));
    click(&mut window, "Outline");
    click(&mut window, "node 1");
    let view = |window: &mut Window<'_>| {
        let rect = window.get_by_label("3D view of scene and tree").rect();
        let image = window.render().unwrap();
        let [left, top] = [rect.left(), rect.top()].map(|at| at as u32);
        let [width, height] = [rect.width() as u32, rect.height() as u32 / 2];
        image::imageops::crop_imm(&image, left, top, width, height).to_image()
    };
    over_view(&mut window);
    let shown = view(&mut window);
    press(&mut window, Modifiers::NONE, Key::H);
    assert!(has(&window, "bright: below node 1; faint: all others"));
    assert!(has(&window, &format!("{all} of {all} leaves shown")));
    let faded = view(&mut window);
    press(&mut window, Modifiers::NONE, Key::H);
    assert!(has(&window, "only below node 1"));
    let below = grouped(index.of(1).leaves);
    assert!(has(&window, &format!("{below} of {all} leaves shown")));
    let alone = view(&mut window);
    assert!(shown != faded && faded != alone);
    // Another node that is selected stands out, the children of the root in their order.
    let second = tree.child_nodes(0).nth(1).unwrap();
    click(&mut window, &format!("node {second}"));
    assert!(has(&window, &format!("only below node {second}")));
    over_view(&mut window);
    press(&mut window, Modifiers::NONE, Key::H);
    assert!(!has(&window, "below node"));
}

#[test]
fn the_menu_of_cells_is_whole_on_a_small_screen() {
    let mut window = open_sized(start("balls:1", "bvh-sweep"), [1280.0, 720.0], true);
    finish(&mut window);
    click(&mut window, "Cells");
    for label in ["None", "Faded", "Visits", "Greatest depth shown"] {
        let rect = window.get_by_label(label).rect();
        assert!(
            rect.top() >= 0.0 && rect.bottom() <= 720.0,
            "{label}: {rect}"
        );
    }
}

#[test]
fn the_build_divides_objects_step_by_step() {
    let (tree, index) = expected("balls:1");
    let mut window = opened("balls:1");
    press(&mut window, Modifiers::COMMAND, Key::G);
    window.run_steps(2);
    let nodes = grouped(tree.nodes().len());
    for node in 0..6 {
        let says = match tree.kind(node) {
            NodeKind::Inner => {
                let objects = parts(&tree, &index, node);
                format!("node {node} of {nodes} is divided into boxes of {objects} objects")
            }
            NodeKind::Leaf { count, stop, .. } => format!(
                "node {node} of {nodes} becomes a leaf of {count} objects: {}",
                stop.text()
            ),
        };
        assert!(has(&window, &says), "{says}");
        let cells = tree.cells_at(Moment::Node(node));
        let undecided = cells.filter(|(_, decided)| !decided).count();
        let dotted = format!("dotted white: {undecided} cell");
        wait(&mut window, &dotted, |w| has(w, &dotted));
        press(&mut window, Modifiers::ALT, Key::ArrowRight);
    }
    click(&mut window, "By depth");
    let reached = tree.depth_reached();
    click(&mut window, "First moment");
    for depth in 0..=reached {
        let says = format!("built up to depth {depth} of {reached} (D_REACH)");
        assert!(has(&window, &says), "{says}");
        press(&mut window, Modifiers::ALT, Key::ArrowRight);
    }
}

/// A primary ray of the scene that finds its closest hit only after another, and culls a node; with its pixel.
fn overlapping(scene: &str, culls: bool) -> ([u32; 2], RayPath) {
    let start = start(scene, "bvh-sweep");
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    let tree = build(&scene, &start.setup.build, &progress).unwrap();
    let render = bspscope::trace::RenderSettings {
        width: SIZE,
        height: SIZE,
        ..start.setup.render
    };
    let mut pixels: Vec<[u32; 2]> = (0..SIZE)
        .flat_map(|y| (0..SIZE).map(move |x| [x, y]))
        .collect();
    let middle = SIZE / 2;
    pixels.sort_by_key(|[x, y]| x.abs_diff(middle) + y.abs_diff(middle));
    let found = pixels.into_iter().find_map(|pixel| {
        let record = record_pixel(&scene, &tree, &render, pixel).unwrap();
        let path = record.rays.into_iter().next()?.path;
        let overlaps = path
            .leaves()
            .any(|leaf| leaf.outcome == LeafOutcome::OverlapAhead);
        let culled = path
            .steps
            .iter()
            .any(|step| matches!(step, Step::Culled(_)));
        (overlaps && culled == culls).then_some((pixel, path))
    });
    found.expect("such a ray")
}

/// Picks a pixel by keys, from the one in the middle.
fn pick(window: &mut Window<'_>, pixel: [u32; 2]) {
    press(window, Modifiers::COMMAND, Key::Num2);
    window.get_by_label("Traced picture").click();
    wait(window, "the rays", |w| has(w, "Ray 1 of "));
    over_picture(window);
    let middle = SIZE / 2;
    for (at, [less, more]) in pixel.into_iter().zip([
        [Key::ArrowLeft, Key::ArrowRight],
        [Key::ArrowUp, Key::ArrowDown],
    ]) {
        let key = if at < middle { less } else { more };
        for _ in 0..at.abs_diff(middle) {
            press(window, Modifiers::NONE, key);
        }
    }
    let [x, y] = pixel;
    let text = format!("Pixel {x}, {y} (");
    wait(window, &text, |w| has(w, &text));
    finish(window);
}

#[test]
fn every_step_of_a_ray_says_which_boxes_were_hit_and_why_it_goes_on() {
    for culls in [true, false] {
        let (pixel, path) = overlapping("teaching", culls);
        let mut window = opened("teaching");
        pick(&mut window, pixel);
        let n = path.steps.len();
        // Recorded once the picture is there.
        let first = format!("1 of {n}");
        wait(&mut window, &first, |w| w.query_by_label(&first).is_some());
        let mut seen = [false; 3];
        for (i, step) in path.steps.iter().enumerate() {
            let at = format!("{} of {n}", i + 1);
            assert!(window.query_by_label(&at).is_some(), "{at} at {pixel:?}");
            match step {
                Step::Boxes(step) => {
                    assert!(has(&window, "Tests the boxes of its 2 children:"));
                    for test in &step.tests {
                        assert!(has(&window, &format!("Node {}: ", test.node)));
                    }
                }
                Step::Culled(step) => {
                    assert!(has(&window, &format!("node {} is culled", step.node)));
                    assert!(has(&window, "beyond the closest hit at"));
                    assert!(has(
                        &window,
                        "culled nodes: boxes that begin beyond the hit"
                    ));
                    seen[0] = true;
                }
                Step::Leaf(leaf) => {
                    assert!(has(&window, leaf.outcome.text()));
                    let overlaps = leaf.outcome == LeafOutcome::OverlapAhead;
                    assert_eq!(has(&window, "Boxes overlap: node"), overlaps);
                    seen[1] |= overlaps;
                }
                Step::Inner(_) => unreachable!("a hierarchy has no planes"),
            }
            seen[2] |= has(&window, "The first hit, ");
            if i + 1 < n {
                press(&mut window, Modifiers::NONE, Key::Period);
                window.run_steps(1);
            }
        }
        assert_eq!(seen, [culls, true, true], "{pixel:?}");
        assert!(has(&window, "box tests and "));
        // Every step has its row and its block.
        let strip = window.get_by_label("Steps along the ray").rect();
        let place = egui::pos2(strip.left() + 9.0, strip.center().y - 2.0);
        window.drag_at(place);
        window.drop_at(place);
        window.run_steps(3);
        let leaf = |step: &Step| matches!(step, Step::Leaf(_));
        let first = path.steps.iter().position(leaf).unwrap();
        assert!(
            window
                .query_by_label(&format!("{} of {n}", first + 1))
                .is_some()
        );
    }
}

#[test]
fn a_setting_that_the_structure_does_not_use_is_disabled() {
    for (method, unused) in [
        ("midpoint", vec![]),
        ("grid", vec!["Depth", "Leaf size", "First axis"]),
        ("bvh-binned", vec!["Overlap", "First axis"]),
    ] {
        let mut window = open(start("tetra:1", method));
        press(&mut window, Modifiers::COMMAND, Key::I);
        let notes = window.query_all_by_label("not used").count();
        assert_eq!(notes, unused.len(), "{method}");
        for name in ["Depth", "Leaf size", "Overlap", "First axis", "Root margin"] {
            let roles = [Role::SpinButton, Role::ComboBox, Role::Slider];
            let nodes = window.query_all_by_label(name);
            let mut controls = nodes
                .map(|node| node.accesskit_node())
                .filter(|node| roles.contains(&node.role()));
            // The automatic margin is disabled, too.
            if name != "Root margin" {
                let is_disabled = controls.all(|node| node.is_disabled());
                assert_eq!(is_disabled, unused.contains(&name), "{method}: {name}");
            }
        }
    }
}

#[test]
fn lists_of_methods_have_a_heading_per_family() {
    let families = Method::families();
    assert_eq!(families.len(), 3);
    let mut window = open_sized(start("tetra:1", "bvh-sweep"), [1280.0, 720.0], false);
    finish(&mut window);
    window
        .get_by_role_and_label(Role::ComboBox, "Method")
        .click();
    window.run_steps(3);
    for (family, methods) in &families {
        let heading = window.get_by_label(family).rect();
        for method in methods {
            let item = window.get_by_role_and_label(Role::Button, method.name);
            assert!(
                item.rect().top() >= heading.bottom() - 1.0,
                "{}",
                method.name
            );
        }
    }
    click(&mut window, "bvh-binned");
    wait(&mut window, "the method", |w| {
        w.state().setup().build.method.name == "bvh-binned"
    });
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num4);
    for (family, _) in &families {
        assert!(window.query_by_label(family).is_some(), "{family}");
    }
    assert!(families.iter().all(|(family, methods)| {
        methods
            .iter()
            .all(|method| method.structure.family() == *family)
    }));
    assert_eq!(Structure::Grid.family(), Structure::Octree.family());
}

#[test]
fn a_hierarchy_is_compared_with_a_kd_tree() {
    let mut window = opened("balls:1");
    press(&mut window, Modifiers::COMMAND, Key::Num3);
    wait(&mut window, "the gate", |w| has(w, "Fair comparison"));
    click(&mut window, "Build method of B");
    for (family, _) in Method::families() {
        assert!(has(&window, family), "{family}");
    }
}

#[test]
fn the_lessons_on_boxes_are_on_the_list() {
    let mut window = opened("balls:1");
    press(&mut window, Modifiers::COMMAND, Key::Num5);
    for lesson in &LESSONS[6..] {
        assert!(has(&window, &lesson.read().title), "{}", lesson.name);
    }
    assert_eq!(LESSONS.len(), 8);
}
