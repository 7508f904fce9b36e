//! What the window's design promises, measured on what is drawn: areas, sizes of text, nothing cut,
//! broken or moved, at both reference sizes and in both themes.

use crate::harness::{
    PATIENCE, Window, click, finish, has, is_finished, open_sized, press, small, wait,
};
use crate::painted::texts_in;
use crate::support::wording::assert_plain;
use bspscope::gui::StartOptions;
use bspscope::lesson::Lesson;
use bspscope::measure::heat::heatmaps;
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use std::time::Instant;

/// The reference sizes in points.
const SIZES: [[f32; 2]; 2] = [[1600.0, 1000.0], [1280.0, 720.0]];

/// The keys of the tasks, with their names.
const TASKS: [(Key, &str); 5] = [
    (Key::Num1, "Explore"),
    (Key::Num2, "Ray"),
    (Key::Num3, "Compare"),
    (Key::Num4, "Tune"),
    (Key::Num5, "Lessons"),
];

/// Opens the window in a task, in the dark or the light theme, and lets it come to rest.
fn at<'a>(size: [f32; 2], light: bool, task: Key) -> Window<'a> {
    let mut window = open_sized(small("balls:2"), size, false);
    if light {
        press(&mut window, Modifiers::COMMAND, Key::T);
    }
    finish(&mut window);
    press(&mut window, Modifiers::COMMAND, task);
    finish(&mut window);
    window.run_steps(10);
    window
}

/// Calls a check for both sizes, both themes and all tasks.
fn everywhere(check: impl Fn(&Window<'_>, &str)) {
    for size in SIZES {
        for light in [false, true] {
            for (key, name) in TASKS {
                let window = at(size, light, key);
                check(&window, &format!("{name} at {size:?}, light: {light}"));
            }
        }
    }
}

/// Asserts that every text is large enough and whole, that no number is broken, and that the title rows of
/// panes have room for all that stands in them.
fn assert_whole(window: &Window<'_>, place: &str) {
    let texts = texts_in(window, window.ctx.content_rect());
    assert!(texts.len() > 10, "{place}");
    for text in &texts {
        let words = text.rows.concat();
        assert!(text.size >= 12.0, "{place}: {text:?}");
        let is_file_name = words.contains('/') || words.contains(".nff");
        assert!(!text.is_elided || is_file_name, "{place}: {text:?}");
        assert!(!text.is_clipped, "{place}: {text:?}");
        assert!(!text.breaks_a_number(), "{place}: {text:?}");
    }
    // Below the top bar.
    let titles: Vec<_> = texts
        .iter()
        .filter(|text| (44.0..72.0).contains(&text.rect.center().y))
        .collect();
    for (i, text) in titles.iter().enumerate() {
        for other in &titles[..i] {
            let both = text.rect.intersect(other.rect);
            assert!(!both.is_positive(), "{place}: {text:?} over {other:?}");
        }
    }
}

#[test]
fn texts_are_large_enough_whole_and_unbroken() {
    everywhere(assert_whole);
}

/// Chooses a heatmap, or the picture, by its place in the menu.
fn show(window: &mut Window<'_>, heatmap: usize) {
    let item = match heatmap.checked_sub(1) {
        Some(place) => {
            let heatmap = &heatmaps()[place];
            format!("{} · {}", heatmap.symbol, heatmap.name)
        }
        None => "Picture".to_owned(),
    };
    click(window, "Show");
    let items = window.query_all_by_role_and_label(Role::RadioButton, &item);
    items.last().expect("an item of the menu").click();
    window.run_steps(3);
    press(window, Modifiers::NONE, Key::Escape);
    window.run_steps(3);
    finish(window);
}

#[test]
fn texts_of_a_ray_and_of_heatmaps_are_whole() {
    for size in SIZES {
        let mut window = at(size, false, Key::Num1);
        window.get_by_label("Traced picture").click();
        window.run_steps(3);
        finish(&mut window);
        for step in 0..12 {
            click(&mut window, "Next");
            assert_whole(&window, &format!("step {step} at {size:?}"));
        }
        for task in [Key::Num1, Key::Num2, Key::Num3] {
            press(&mut window, Modifiers::COMMAND, task);
            finish(&mut window);
            for heatmap in 0..=heatmaps().len() {
                show(&mut window, heatmap);
                assert_whole(&window, &format!("{task:?}, heatmap {heatmap} at {size:?}"));
            }
        }
    }
}

/// A lesson of one step, with the steps of a ray beside the picture.
fn lesson(settings: &str) -> StartOptions {
    let text = format!(
        "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n# S\n```toml\nscene = \"balls:2\"\n\
         a = \"method=midpoint\"\npixel = [64, 64]\n{settings}\n```\nText\n"
    );
    StartOptions {
        lesson: Some(Lesson::parse(&text, "t.md").unwrap()),
        ..small("balls:1")
    }
}

#[test]
fn texts_beside_a_lesson_are_whole() {
    const STEPS: &str = "panes = [\"Steps of the ray\"]";
    let wipe = format!("{STEPS}\nb = \"method=sah-cut\"\nview = \"wipe\"");
    for size in SIZES {
        for settings in [STEPS, &wipe] {
            let mut window = open_sized(lesson(settings), size, false);
            finish(&mut window);
            wait(&mut window, "the ray", |w| has(w, "Step 1: "));
            let place = |heatmap| format!("{settings}, heatmap {heatmap} at {size:?}");
            for heatmap in 0..=heatmaps().len() {
                show(&mut window, heatmap);
                assert_whole(&window, &place(heatmap));
                press(&mut window, Modifiers::NONE, Key::Period);
                assert_whole(&window, &place(heatmap));
            }
        }
    }
}

fn area(window: &Window<'_>, rect: Rect) -> f32 {
    let whole = window.ctx.content_rect();
    rect.area() / whole.area()
}

#[test]
fn the_picture_has_its_share_of_the_window() {
    for (size, [pane, square, maximized]) in SIZES
        .into_iter()
        .zip([[0.38, 0.26, 0.49], [0.34, 0.26, 0.40]])
    {
        let mut window = at(size, false, Key::Num1);
        let rect = window.get_by_label("Traced picture").rect();
        let side = rect.width().min(rect.height());
        let whole = window.ctx.content_rect().area();
        // The pane begins below the top bar.
        let of_pane = rect.width() * (rect.bottom() - 40.0) / whole;
        assert!(of_pane >= pane - 0.01, "{size:?}: the pane has {of_pane}");
        let of_square = side * side / whole;
        assert!(
            of_square >= square - 0.01,
            "{size:?}: the square has {of_square}"
        );
        window.hover_at(rect.center());
        window.run_steps(2);
        press(&mut window, Modifiers::NONE, Key::Z);
        window.run_steps(4);
        let rect = window.get_by_label("Traced picture").rect();
        let side = rect.width().min(rect.height());
        let share = side * side / whole;
        assert!(share >= maximized - 0.01, "{size:?}: maximized {share}");
        assert!(area(&window, rect) > 0.7, "it fills the window");
    }
}

#[test]
fn the_first_screen_has_few_widgets() {
    const ROLES: [Role; 9] = [
        Role::Button,
        Role::CheckBox,
        Role::ComboBox,
        Role::Slider,
        Role::SpinButton,
        Role::TextInput,
        Role::RadioButton,
        Role::Tab,
        Role::Link,
    ];
    for size in SIZES {
        let window = at(size, false, Key::Num1);
        let mut names = Vec::new();
        for role in ROLES {
            let nodes = window.query_all_by_role(role);
            names.extend(nodes.map(|node| node.accesskit_node().label().unwrap_or_default()));
        }
        // A slider and its number are one widget.
        names.sort();
        names.dedup();
        assert!(names.len() > 5);
        assert!(
            names.len() <= 26,
            "{size:?}: {} widgets: {names:?}",
            names.len()
        );
    }
}

/// The rectangles of everything that has a name.
fn places(window: &Window<'_>) -> Vec<(String, Rect)> {
    let roles = [
        Role::Button,
        Role::ComboBox,
        Role::Slider,
        Role::Image,
        Role::Canvas,
    ];
    let mut all = Vec::new();
    for role in roles {
        for node in window.query_all_by_role(role) {
            let name = node.accesskit_node().label().unwrap_or_default();
            all.push((name, node.rect()));
        }
    }
    for symbol in ["N_RPRT", "N_AT", "N_LS", "T_TR"] {
        all.push((symbol.to_owned(), window.get_by_label(symbol).rect()));
    }
    assert!(all.len() > 9);
    all
}

#[test]
fn nothing_moves_while_work_runs() {
    for size in SIZES {
        let mut start = small("balls:2");
        (start.setup.render.width, start.setup.render.height) = (200, 200);
        let mut window = open_sized(start, size, false);
        finish(&mut window);
        window.run_steps(10);
        let before = places(&window);
        let assert_same = |window: &Window<'_>| {
            let now = places(window);
            for (name, rect) in &before {
                let same = now.iter().find(|(other, _)| other == name);
                let (_, place) = same.unwrap_or_else(|| panic!("{name} is gone"));
                assert_eq!(place.min, rect.min, "{name} moved");
            }
        };
        press(&mut window, Modifiers::COMMAND, Key::M);
        let (since, mut frames) = (Instant::now(), 0);
        while !is_finished(&window) {
            assert_same(&window);
            frames += 1;
            window.run_steps(1);
            assert!(since.elapsed() < PATIENCE);
        }
        assert!(frames > 1, "nothing is tested");
        assert_same(&window);
    }
}

#[test]
fn panes_and_actions_are_described_in_plain_words() {
    let sections = bspscope::gui::shortcuts();
    assert!(sections.len() > 5);
    let titles = sections.iter().map(|s| ("title", s.title.clone()));
    let lines = sections.iter().flat_map(|section| {
        let lines = section.lines.iter();
        lines.map(|(_, about)| ("action", (*about).to_owned()))
    });
    let all: Vec<_> = titles.chain(lines).collect();
    assert!(all.len() > 100);
    assert_plain(all.iter().map(|(place, text)| (*place, text.as_str())));
}
