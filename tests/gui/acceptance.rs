//! What the window's design promises, measured on what is drawn: areas, sizes of text, nothing cut,
//! broken or moved, at both reference sizes and in both themes.

use crate::harness::{Window, finish, open_sized, press, small};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, Shape};
use egui_kittest::kittest::{NodeT as _, Queryable as _};

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

/// A text as it is drawn.
struct Drawn {
    text: String,
    /// The smallest font of it, in points.
    size: f32,
    rect: Rect,
    clip: Rect,
    is_elided: bool,
    /// The texts of its rows.
    rows: Vec<String>,
}

fn collect(shape: &Shape, clip: Rect, into: &mut Vec<Drawn>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, clip, into)),
        Shape::Text(text) if !text.galley.text().trim().is_empty() => {
            let job = &text.galley.job;
            let sizes = job
                .sections
                .iter()
                .map(|section| section.format.font_id.size);
            into.push(Drawn {
                text: text.galley.text().to_owned(),
                size: sizes.fold(f32::INFINITY, f32::min),
                rect: text.galley.rect.translate(text.pos.to_vec2()),
                clip,
                is_elided: text.galley.elided,
                rows: text.galley.rows.iter().map(|row| row.text()).collect(),
            });
        }
        _ => {}
    }
}

/// All texts on the screen.
fn drawn(window: &Window<'_>) -> Vec<Drawn> {
    let mut all = Vec::new();
    for shape in &window.output().shapes {
        collect(&shape.shape, shape.clip_rect, &mut all);
    }
    all.retain(|text| text.rect.intersects(text.clip));
    assert!(all.len() > 10, "the window has texts");
    all
}

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

#[test]
fn texts_are_large_enough_whole_and_unbroken() {
    everywhere(|window, place| {
        for text in drawn(window) {
            let Drawn { text: words, .. } = &text;
            assert!(text.size >= 12.0, "{place}: '{words}' is {} pt", text.size);
            let is_file_name = words.contains('/') || words.contains(".nff");
            assert!(
                !text.is_elided || is_file_name,
                "{place}: '{words}' is elided"
            );
            let cut = text.rect.left() < text.clip.left() - 1.5
                || text.rect.right() > text.clip.right() + 1.5;
            assert!(
                !cut,
                "{place}: '{words}' is cut: {} in {}",
                text.rect, text.clip
            );
            for pair in text.rows.windows(2) {
                let (end, start) = (pair[0].chars().last(), pair[1].chars().next());
                let in_number = |c: char| c.is_ascii_digit() || c == '.' || c == '\u{a0}';
                let broken =
                    end.is_some_and(in_number) && start.is_some_and(|c| in_number(c) || c == '%');
                assert!(!broken, "{place}: a number of '{words}' is broken");
            }
        }
    });
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
        // The pane has its title row above the picture.
        let of_pane = rect.width() * (rect.height() + 36.0) / whole;
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
    assert!(all.len() > 5);
    all
}

#[test]
fn nothing_moves_while_work_runs() {
    for size in SIZES {
        let mut window = at(size, false, Key::Num1);
        let before = places(&window);
        press(&mut window, Modifiers::COMMAND, Key::M);
        for _ in 0..20 {
            window.run_steps(1);
            for (name, rect) in &before {
                let now = places(&window);
                let same = now.iter().find(|(other, _)| other == name);
                if let Some((_, place)) = same {
                    assert_eq!(place.min, rect.min, "{name} moved");
                }
            }
        }
        finish(&mut window);
    }
}
