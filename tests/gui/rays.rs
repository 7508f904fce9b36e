//! The task *Ray*: the rays of a picked pixel, and the steps of their traversal, found by their labels.

use crate::harness::{SIZE, Window, click, finish, has, open_sized, press, wait};
use bspscope::progress::Progress;
use bspscope::scene::load;
use bspscope::structure::build;
use bspscope::trace::{PixelRecord, RayKind, RenderSettings, Step, record_pixel};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

/// The pixel in the picture's middle, which a click on the picture picks.
const MIDDLE: u32 = SIZE / 2;

fn start() -> bspscope::gui::StartOptions {
    crate::harness::small("balls:1")
}

/// What the library records of the pixel in the middle.
fn expected() -> PixelRecord {
    let start = start();
    let progress = Progress::new();
    let scene = load(&start.setup.scene, &progress).unwrap();
    let tree = build(&scene, &start.setup.build, &progress).unwrap();
    let render = RenderSettings {
        width: SIZE,
        height: SIZE,
        ..start.setup.render
    };
    record_pixel(&scene, &tree, &render, [MIDDLE, MIDDLE]).unwrap()
}

/// A window in which the pixel in the middle is picked.
fn picked<'a>(graphics: bool) -> Window<'a> {
    // High enough that the lists need not be scrolled to.
    picked_at([1500.0, 1500.0], graphics)
}

fn picked_at<'a>(size: [f32; 2], graphics: bool) -> Window<'a> {
    let mut window = open_sized(start(), size, graphics);
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num2);
    assert!(has(&window, "– of –"));
    window.get_by_label("Traced picture").click();
    let rays = expected().rays.len();
    let text = format!("Ray 1 of {rays}: primary ray");
    wait(&mut window, "the rays", |w| has(w, &text));
    window
}

fn at_step(window: &Window<'_>, step: usize, of: usize) -> bool {
    window.query_by_label(&format!("{step} of {of}")).is_some()
}

fn is_disabled(window: &Window<'_>, label: &str) -> bool {
    window.get_by_label(label).accesskit_node().is_disabled()
}

/// The row whose label begins so.
fn row(record: &PixelRecord, ray: usize) -> String {
    format!("Ray {}: {}", ray + 1, record.rays[ray].path.kind.name())
}

#[test]
fn picking_shows_every_ray_and_what_they_sum_to() {
    for graphics in [false, true] {
        let mut window = picked(graphics);
        let record = expected();
        assert!(record.rays.len() > 3);
        // The list makes the rows in view only: going on to a ray brings it there.
        for (i, ray) in record.rays.iter().enumerate() {
            let counts = ray.path.counts();
            let label = window
                .get_by_label_contains(&row(&record, i))
                .accesskit_node()
                .label()
                .unwrap();
            let tests = format!("({} empty), {} test", counts.empty_leaves, counts.tests);
            assert!(label.contains(&tests), "{label}");
            let end = match (ray.path.kind, ray.path.hit.is_hit()) {
                (RayKind::Shadow, true) => "blocked by",
                (RayKind::Shadow, false) => "reaches the light",
                (_, true) => "sphere",
                (_, false) => "background",
            };
            assert!(label.contains(end) || label.contains("polygon"), "{label}");
            press(&mut window, Modifiers::NONE, Key::PageDown);
        }
        assert!(has(&window, "sums equal those of the counting kernel"));
        for (kind, t) in RayKind::ALL.into_iter().zip(record.tallies()) {
            assert!(has(
                &window,
                &format!(
                    "Total of {}: {} rays, {} hits, {} tests, {} inner nodes, {} leaves, {} empty \
                     leaves",
                    kind.name(),
                    t.rays,
                    t.hits,
                    t.tests,
                    t.inner_nodes,
                    t.leaves,
                    t.empty_leaves
                )
            ));
        }
    }
}

/// A whole number in groups of three digits; nodes have no more than six here.
fn grouped(node: u32) -> String {
    match (node / 1000, node % 1000) {
        (0, rest) => rest.to_string(),
        (thousands, rest) => format!("{thousands}\u{a0}{rest:03}"),
    }
}

#[test]
fn a_shadow_ray_shows_its_own_steps() {
    let mut window = picked(false);
    let record = expected();
    let shadow = record
        .rays
        .iter()
        .position(|ray| ray.path.kind == RayKind::Shadow)
        .expect("a shadow ray");
    let before = record.rays[0].path.steps.len();
    assert!(at_step(&window, 1, before));
    window.get_by_label_contains(&row(&record, shadow)).click();
    window.run_steps(3);
    let path = &record.rays[shadow].path;
    assert_ne!(path.steps.len(), before);
    assert!(at_step(&window, 1, path.steps.len()));
    assert!(has(&window, &format!("Ray {} of", shadow + 1)));
    assert!(has(&window, "The shadow ray visits"));
    // Its list has its nodes.
    for (i, step) in path.steps.iter().enumerate().take(5) {
        let what = match step {
            Step::Inner(_) | Step::Boxes(_) => "inner node",
            Step::Culled(_) => "culled node",
            Step::Leaf(_) => "leaf",
        };
        let text = format!("Step {}: {what} {}, depth", i + 1, grouped(step.node()));
        assert!(has(&window, &text), "{text}");
    }
}

#[test]
fn buttons_and_keys_step_to_the_end_and_back() {
    let mut window = picked(false);
    let record = expected();
    let path = &record.rays[0].path;
    let n = path.steps.len();
    assert!(is_disabled(&window, "First") && is_disabled(&window, "Previous"));
    for step in 2..=n {
        if step % 2 == 0 {
            click(&mut window, "Next");
        } else {
            press(&mut window, Modifiers::NONE, Key::Period);
        }
        assert!(at_step(&window, step, n), "step {step}");
        // The current step is named, and its row is the one that is selected.
        let selected = window
            .query_all_by_label_contains(&format!("Step {step}: "))
            .any(|node| node.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True));
        assert!(selected, "row of step {step}");
        let pending = path.pending(step - 1).len();
        assert!(has(&window, &format!("Stack: {pending} node")));
    }
    assert!(is_disabled(&window, "Next") && is_disabled(&window, "Last"));
    press(&mut window, Modifiers::NONE, Key::Period);
    assert!(at_step(&window, n, n));
    assert!(has(&window, "the hit lies before any other leaf: done"));
    click(&mut window, "Previous");
    press(&mut window, Modifiers::NONE, Key::Comma);
    assert!(at_step(&window, n - 2, n));
    click(&mut window, "First");
    assert!(at_step(&window, 1, n));
    press(&mut window, Modifiers::SHIFT, Key::End);
    assert!(at_step(&window, n, n));
    press(&mut window, Modifiers::SHIFT, Key::Home);
    assert!(at_step(&window, 1, n));
    click(&mut window, "Last");
    assert!(at_step(&window, n, n));
}

#[test]
fn leaves_only_passes_over_inner_nodes() {
    let mut window = picked(false);
    let record = expected();
    let path = &record.rays[0].path;
    let (n, leaves) = (path.steps.len(), path.leaves().count());
    click(&mut window, "Options of the steps");
    click(&mut window, "Leaves only");
    let first = path
        .steps
        .iter()
        .position(|step| matches!(step, Step::Leaf(_)))
        .expect("a leaf");
    let text = format!("{} of {n} (leaf 1 of {leaves})", first + 1);
    assert!(has(&window, &text), "{text}");
    for _ in 1..leaves {
        click(&mut window, "Next");
    }
    let text = format!("{n} of {n} (leaf {leaves} of {leaves})");
    assert!(has(&window, &text), "{text}");
    assert!(is_disabled(&window, "Next"));
    press(&mut window, Modifiers::NONE, Key::K);
    assert!(at_step(&window, n, n));
}

#[test]
fn playing_goes_on_by_itself_and_stops_at_the_end() {
    let mut window = picked(false);
    let n = expected().rays[0].path.steps.len();
    press(&mut window, Modifiers::NONE, Key::Space);
    assert!(has(&window, "Pause"));
    // Two steps a second; a frame of the test lasts a quarter of one.
    window.run_steps(3);
    let step = (2..6)
        .find(|&step| at_step(&window, step, n))
        .expect("it goes on");
    click(&mut window, "Pause");
    let paused = (step..step + 3)
        .find(|&step| at_step(&window, step, n))
        .expect("it paused");
    window.run_steps(10);
    assert!(at_step(&window, paused, n), "a pause is a pause");
    click(&mut window, "Play");
    window.run_steps(2 * n + 4);
    assert!(at_step(&window, n, n));
    assert!(window.query_by_label("Play").is_some(), "it stopped");
    // Once more from the beginning.
    click(&mut window, "Play");
    assert!(!at_step(&window, n, n));
}

#[test]
fn a_pixel_keeps_its_ray_in_another_tree() {
    let mut window = picked(false);
    let rays = expected().rays.len();
    press(&mut window, Modifiers::NONE, Key::PageDown);
    press(&mut window, Modifiers::COMMAND, Key::M);
    window.run_steps(2);
    finish(&mut window);
    let text = format!("Ray 2 of {rays}");
    wait(&mut window, "the ray", |w| has(w, &text));
}

/// The rows of the list of steps that are in view, and which of them is selected.
fn rows(window: &Window<'_>) -> (usize, Option<egui::Rect>) {
    let is_row = |node: &egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        node.toggled().is_some()
            && node.label().is_some_and(|label| {
                label.starts_with("Step ")
                    && (label.contains(": leaf") || label.contains(": inner"))
            })
    };
    let rows: Vec<_> = window
        .query_all_by_label_contains("Step ")
        .filter(is_row)
        .collect();
    let selected = rows
        .iter()
        .find(|row| row.accesskit_node().toggled() == Some(egui::accesskit::Toggled::True));
    (rows.len(), selected.map(|row| row.rect()))
}

#[test]
fn the_row_of_the_current_step_is_always_in_view() {
    for (size, least) in [([1600.0, 1000.0], 6), ([1280.0, 720.0], 4)] {
        let mut window = picked_at(size, false);
        let n = expected().rays[0].path.steps.len();
        assert!(n > least, "{n} steps");
        let strip = window.get_by_label("Steps along the ray").rect();
        let picture = window.get_by_label("Traced picture").rect();
        assert!(strip.left() >= picture.right(), "{strip} beside {picture}");
        assert!(strip.width() > 0.9 * (size[0] - picture.right()));
        for step in 1..=n {
            assert!(at_step(&window, step, n));
            let (count, selected) = rows(&window);
            assert!(count >= least, "{count} rows at {size:?}");
            let selected = selected.expect("the row of the current step");
            assert!(selected.top() > strip.bottom(), "{selected} below {strip}");
            // Above the tabs at the bottom.
            assert!(
                selected.bottom() <= size[1] - 30.0,
                "{selected} at {size:?}"
            );
            if step < n {
                click(&mut window, "Next");
                // The list scrolls in the frame after.
                window.run_steps(2);
            }
        }
    }
}

#[test]
fn a_click_on_the_strip_goes_to_the_step() {
    let mut window = picked(false);
    let path = &expected().rays[0].path;
    let n = path.steps.len();
    let strip = window.get_by_label("Steps along the ray").rect();
    let at = |window: &mut Window<'_>, x: f32| {
        let place = egui::pos2(x, strip.center().y - 2.0);
        window.drag_at(place);
        window.drop_at(place);
        window.run_steps(3);
    };
    at(&mut window, strip.right() - 12.0);
    let leaf = |step: &Step| matches!(step, Step::Leaf(_));
    let last = path.steps.iter().rposition(leaf).expect("a leaf");
    assert!(at_step(&window, last + 1, n));
    at(&mut window, strip.left() + 9.0);
    let first = path.steps.iter().position(leaf).expect("a leaf");
    assert!(at_step(&window, first + 1, n));
}

/// What the 3D view shows, without what lies under the pointer.
fn view(window: &mut Window<'_>) -> image::RgbaImage {
    window.remove_cursor();
    window.run_steps(3);
    let rect = window.get_by_label("3D view of scene and tree").rect();
    let image = window.render().unwrap();
    let [left, top] = [rect.left(), rect.top()].map(|at| at as u32);
    let [width, height] = [rect.width(), rect.height()].map(|length| length as u32);
    image::imageops::crop_imm(&image, left, top, width, height).to_image()
}

#[test]
fn leaving_the_task_restores_the_view_and_nothing_renders_the_picture_again() {
    let mut window = picked_at([1500.0, 1000.0], true);
    let beside = view(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::Num1);
    let before = view(&mut window);
    assert!(before != beside);
    press(&mut window, Modifiers::COMMAND, Key::Num2);
    window.run_steps(3);
    assert!(view(&mut window) == beside, "the same ray, the same side");
    orbit(&mut window);
    assert!(window.state().is_finished(), "orbiting renders nothing");
    assert!(view(&mut window) != beside);
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run_steps(2);
    assert!(window.query_by_label("Steps along the ray").is_none());
    assert!(view(&mut window) == before, "camera and settings as before");
    assert!(window.state().is_finished());
}

/// Drags in the 3D view.
fn orbit(window: &mut Window<'_>) {
    let rect = window.get_by_label("3D view of scene and tree").rect();
    window.drag_at(rect.center());
    window.run_steps(2);
    window.hover_at(rect.center() + egui::vec2(90.0, 20.0));
    window.run_steps(2);
    window.drop_at(rect.center() + egui::vec2(90.0, 20.0));
    window.run_steps(2);
}

/// The share of pixels that are not the same.
fn difference(a: &image::RgbaImage, b: &image::RgbaImage) -> f64 {
    assert_eq!(a.dimensions(), b.dimensions());
    let pairs = a.pixels().zip(b.pixels());
    let different = pairs.filter(|(a, b)| a != b).count();
    different as f64 / f64::from(a.width() * a.height())
}

#[test]
fn the_ray_is_framed_again_in_a_pane_of_another_size() {
    const WIDE: [f32; 2] = [1500.0, 1000.0];
    const HIGH: [f32; 2] = [900.0, 1100.0];
    let mut window = picked_at(WIDE, true);
    let wide = view(&mut window);
    window.set_size(HIGH.into());
    let high = view(&mut window);
    let picked_there = view(&mut picked_at(HIGH, true));
    assert!(difference(&high, &picked_there) < 0.001);
    window.set_size(WIDE.into());
    assert!(difference(&view(&mut window), &wide) < 0.001);
    // Where the user moved the camera, it stays.
    orbit(&mut window);
    let moved = view(&mut window);
    assert!(difference(&moved, &wide) > 0.1);
    for size in [HIGH, WIDE] {
        window.set_size(size.into());
        window.run_steps(3);
    }
    assert!(view(&mut window) == moved);
}
