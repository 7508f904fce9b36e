//! The theme, as the window paints it.

use crate::harness::{Window, finish, small};
use bspscope::gui::App;
use bspscope::gui::icons;
use bspscope::gui::theme::{IconButton, ROW, Tokens, card, chip, install, tokens};
use egui::epaint::{ClippedShape, Shape};
use egui::{Color32, FontFamily, FontId, Theme};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

const SIZES: [[f32; 2]; 2] = [[1600.0, 1000.0], [1280.0, 720.0]];

fn open<'a>(size: [f32; 2], theme: Theme) -> Window<'a> {
    let builder = Harness::builder().with_size(size).with_theme(theme);
    let builder = builder.with_max_steps(40);
    let mut window = builder.build_eframe(|cc| App::new(cc, small("balls:1")));
    finish(&mut window);
    window
}

/// Every piece of text that was painted, with its font and color.
fn painted(window: &Window<'_>) -> Vec<(String, FontId, Color32)> {
    fn collect(shape: &Shape, found: &mut Vec<(String, FontId, Color32)>) {
        match shape {
            Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, found)),
            Shape::Text(text) => {
                for section in &text.galley.job.sections {
                    let range = section.byte_range.start.0..section.byte_range.end.0;
                    let part = text.galley.job.text[range].to_owned();
                    let color = match (text.override_text_color, section.format.color) {
                        (Some(color), _) => color,
                        (None, Color32::PLACEHOLDER) => text.fallback_color,
                        (None, color) => color,
                    };
                    found.push((part, section.format.font_id.clone(), color));
                }
            }
            _ => {}
        }
    }
    let mut found = Vec::new();
    for ClippedShape { shape, .. } in &window.output().shapes {
        collect(shape, &mut found);
    }
    found.retain(|(text, ..)| !text.trim().is_empty());
    found
}

#[test]
fn no_text_of_the_first_screen_is_smaller_than_12() {
    for size in SIZES {
        let window = open(size, Theme::Dark);
        let painted = painted(&window);
        assert!(painted.len() > 20, "only {} texts", painted.len());
        for (text, font, _) in painted {
            assert!(font.size >= 12.0, "{text:?} in {font:?}");
        }
    }
}

#[test]
fn text_of_the_first_screen_has_the_colors_of_its_theme() {
    for theme in [Theme::Dark, Theme::Light] {
        let window = open(SIZES[0], theme);
        let t = Tokens::of(theme);
        let of_theme = [t.text, t.label, t.hint];
        let painted = painted(&window);
        let number = painted.len();
        let other = painted.into_iter().filter(|(_, font, color)| {
            font.family != FontFamily::Monospace && !of_theme.contains(color)
        });
        let other: Vec<_> = other.collect();
        // What is disabled, or drawn over a picture, has other colors.
        assert!(
            4 * other.len() < number,
            "{} of {number}: {other:?}",
            other.len()
        );
    }
}

#[test]
fn icon_buttons_are_square_and_go_by_their_name() {
    let clicks = std::cell::Cell::new(0);
    let mut window = Harness::new_ui(|ui| {
        install(ui.ctx());
        ui.reset_style();
        let button = IconButton::new(icons::PLAY, "Play").tip("Play the steps of the ray.");
        if ui.add(button).clicked() {
            clicks.set(clicks.get() + 1);
        }
    });
    window.run();
    let button = window.get_by_label("Play");
    assert_eq!(button.rect().size(), egui::Vec2::splat(ROW));
    button.click();
    window.run();
    assert_eq!(clicks.get(), 1);
}

#[test]
fn a_chip_on_a_card_is_lower_than_a_row() {
    let mut window = Harness::new_ui(|ui| {
        install(ui.ctx());
        ui.reset_style();
        let color = tokens(ui).better;
        card(ui).show(ui, |ui| chip(ui, "4.3× fewer", color));
    });
    window.run();
    // Above and below the text are 2 pixels and the outline.
    let text = window.get_by_label("4.3× fewer").rect();
    assert!(text.height() + 6.0 < ROW, "{text}");
}
