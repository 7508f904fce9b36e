//! Whether all text can be read: its contrast with what is painted beneath it, in every task and both
//! themes.

use crate::harness::{Window, click, finish, has, open_sized, press, small, type_into, wait};
use bspscope::gui::StartOptions;
use bspscope::gui::theme::Tokens;
use bspscope::lesson::LESSONS;
use egui::epaint::{RectShape, Shape, TextShape};
use egui::{Color32, Key, Modifiers, Rect, Theme};
use egui_kittest::kittest::Queryable as _;

/// The contrast ratio of WCAG 2, from 1 to 21.
fn contrast(a: Color32, b: Color32) -> f64 {
    let luminance = |color: Color32| {
        let [r, g, b] = [color.r(), color.g(), color.b()].map(|byte| {
            let value = f64::from(byte) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                ((value + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

/// Something that is painted and can lie beneath text.
struct Ground {
    rect: Rect,
    /// `None` for a picture, whose colors are anything.
    fill: Option<Color32>,
}

/// A text in one color, and what is beneath it.
struct Painted {
    words: String,
    color: Color32,
    /// The darkest and the lightest color that the ground can have: equal, except over a picture.
    grounds: [Color32; 2],
}

/// Every text of the last frame.
fn painted(window: &Window<'_>) -> Vec<Painted> {
    let (mut grounds, mut found) = (Vec::new(), Vec::new());
    for clipped in &window.output().shapes {
        collect(&clipped.shape, clipped.clip_rect, &mut grounds, &mut found);
    }
    found
}

fn collect(shape: &Shape, clip: Rect, grounds: &mut Vec<Ground>, found: &mut Vec<Painted>) {
    match shape {
        Shape::Vec(shapes) => {
            for shape in shapes {
                collect(shape, clip, grounds, found);
            }
        }
        Shape::Rect(RectShape {
            rect,
            fill,
            brush,
            blur_width,
            ..
        }) => {
            let is_even = brush.is_none() && *blur_width == 0.0;
            // A shadow is blurred; what it darkens is beside its card.
            if *fill != Color32::TRANSPARENT && (is_even || brush.is_some()) {
                grounds.push(Ground {
                    rect: rect.intersect(clip),
                    fill: is_even.then_some(*fill),
                });
            }
        }
        Shape::Mesh(mesh) => grounds.push(Ground {
            rect: mesh.calc_bounds().intersect(clip),
            fill: None,
        }),
        Shape::Callback(callback) => grounds.push(Ground {
            rect: callback.rect.intersect(clip),
            fill: None,
        }),
        Shape::Text(text) => {
            for row in &text.galley.rows {
                let place = row.rect_without_leading_space();
                let place = place.translate(text.pos.to_vec2());
                if clip.contains(place.center()) {
                    let grounds = beneath(place, grounds);
                    found.extend(colors(text, &row.row).into_iter().map(|color| Painted {
                        words: row.text(),
                        color,
                        grounds,
                    }));
                }
            }
        }
        _ => {}
    }
}

/// The colors of a row's glyphs.
fn colors(text: &TextShape, row: &egui::epaint::text::Row) -> Vec<Color32> {
    let visuals = &row.visuals;
    let glyphs = &visuals.mesh.vertices[visuals.glyph_vertex_range.clone()];
    let mut colors: Vec<Color32> = Vec::new();
    for vertex in glyphs {
        let own = match vertex.color {
            Color32::PLACEHOLDER => text.fallback_color,
            color => color,
        };
        let color = text.override_text_color.unwrap_or(own);
        let color = color.gamma_multiply(text.opacity_factor);
        if !colors.contains(&color) {
            colors.push(color);
        }
    }
    colors
}

/// The darkest and the lightest color beneath a text.
fn beneath(text: Rect, grounds: &[Ground]) -> [Color32; 2] {
    let mut found = [Color32::BLACK, Color32::WHITE];
    for ground in grounds {
        if ground.rect.contains(text.center()) {
            found = match ground.fill {
                Some(fill) => found.map(|below| below.blend(fill)),
                None => [Color32::BLACK, Color32::WHITE],
            };
        }
    }
    found
}

/// The least contrast that a color of the theme must have; for others, that of a hint.
fn least(t: &Tokens, text: &Painted) -> f64 {
    let colored = [t.accent, t.a, t.b, t.better, t.worse, t.warning, t.error];
    let [dark, light] = text.grounds;
    let is_selected = dark == t.selected && light == t.selected;
    let is_panel = [t.panel, t.card].contains(&dark) && dark == light;
    match text.color {
        color if color == t.text && is_selected => 8.4,
        color if color == t.text && dark == light => 10.0,
        color if color == t.label && dark == light => 7.8,
        color if color == t.on_accent && dark == t.accent => 7.3,
        color if colored.contains(&color) && is_panel => 7.3,
        _ => 5.1,
    }
}

/// Asserts that every text can be read. Text over a shaded part of a picture must be readable whatever the
/// picture shows. Two kinds of text are left out:
/// - Disabled controls have translucent text. It says that they cannot be used.
/// - Numbers at the leaves in the 3D view have the colors of the leaves, and a black outline in place of a
///   shade, which would hide the leaves.
fn assert_readable(window: &Window<'_>, place: &str) {
    let theme = window.ctx.theme();
    let t = Tokens::of(theme);
    let mut checked = 0;
    for text in painted(window) {
        let Painted { words, color, .. } = &text;
        let [dark, light] = text.grounds;
        if color.a() < 255 || words.trim().is_empty() {
            continue;
        }
        if [dark, light] == [Color32::BLACK, Color32::WHITE] {
            let is_number = words.chars().all(|c| c.is_ascii_digit());
            assert!(is_number, "{place}: {words:?} has no shade beneath it");
            continue;
        }
        let found = contrast(*color, dark).min(contrast(*color, light));
        let least = least(t, &text);
        assert!(
            found >= least,
            "{place}, {theme:?}: {words:?} in {color:?} on {dark:?} to {light:?}: {found:.2} < {least}"
        );
        checked += 1;
    }
    assert!(checked > 8, "{place}: only {checked} texts");
}

/// Checks a window in both themes; `open` brings it to the state that is checked.
fn in_both_themes(name: &str, start: impl Fn() -> StartOptions, open: impl Fn(&mut Window<'_>)) {
    for theme in [Theme::Dark, Theme::Light] {
        let mut window = open_sized(start(), [1280.0, 720.0], true);
        finish(&mut window);
        if theme == Theme::Light {
            window.ctx.set_theme(theme);
        }
        open(&mut window);
        finish(&mut window);
        window.remove_cursor();
        window.run_steps(30);
        assert_eq!(window.ctx.theme(), theme);
        assert_readable(&window, name);
    }
}

#[test]
fn text_of_explore_can_be_read() {
    in_both_themes("Explore", || small("balls:1"), |_| ());
}

#[test]
fn text_of_ray_can_be_read() {
    in_both_themes(
        "Ray",
        || small("balls:1"),
        |window| {
            window.get_by_label("Traced picture").click();
            window.run_steps(3);
        },
    );
}

#[test]
fn text_of_compare_can_be_read() {
    in_both_themes(
        "Compare",
        || small("balls:1"),
        |window| press(window, Modifiers::COMMAND, Key::Num3),
    );
}

#[test]
fn text_of_tune_can_be_read() {
    in_both_themes(
        "Tune",
        || small("tetra:1"),
        |window| {
            press(window, Modifiers::COMMAND, Key::Num4);
            click(window, "Find the best tree");
            wait(window, "the end", |w| w.query_by_label("Stop").is_none());
        },
    );
}

#[test]
fn text_of_the_study_of_measures_can_be_read() {
    in_both_themes(
        "Measures and time",
        || small("tetra:3"),
        |window| {
            press(window, Modifiers::COMMAND, Key::Num4);
            click(window, "Measures and time");
            type_into(window, "Rays per set", "16");
            click(window, "Study measures");
            wait(window, "the end", |w| has(w, "by rank correlation"));
        },
    );
}

#[test]
fn text_of_lessons_can_be_read() {
    in_both_themes(
        "Lessons",
        || small("balls:1"),
        |window| press(window, Modifiers::COMMAND, Key::Num5),
    );
    let taking = || StartOptions {
        lesson: Some(LESSONS[0].read()),
        ..small("balls:1")
    };
    in_both_themes("a lesson", taking, |_| ());
}

#[test]
fn text_of_present_can_be_read() {
    in_both_themes(
        "Present",
        || small("balls:1"),
        |window| press(window, Modifiers::NONE, Key::F11),
    );
}

#[test]
fn text_of_the_first_start_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let start = || StartOptions {
        remember: true,
        settings_folder: Some(folder.path().to_owned()),
        ..small("balls:1")
    };
    in_both_themes("the first start", start, |_| ());
}
