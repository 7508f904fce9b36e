//! Fonts and text styles.
//!
//! Text is set in Inter. Its subsets in `assets/fonts` have digits of equal width, so that a number that
//! changes moves nothing. Paths and code are set in Hack. The fonts that come with egui supply rare
//! characters.

use eframe::epaint::text::{FontData, FontDefinitions};
use egui::{FontFamily, FontId, RichText, TextStyle};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The text style of secondary text and of tables.
pub const HINT: &str = "hint";
/// The text style of a lesson's text.
pub const LESSON: &str = "lesson";
/// The text style of the value on a card.
pub const FIGURE: &str = "figure";
/// The text style of a title that fills a screen.
pub const DISPLAY: &str = "display";

/// Returns the text style called [`HINT`], [`LESSON`], [`FIGURE`] or [`DISPLAY`].
pub fn named(name: &str) -> TextStyle {
    TextStyle::Name(name.into())
}

/// Returns the family of emphasized text.
pub fn semibold() -> FontFamily {
    FontFamily::Name("semibold".into())
}

/// Returns secondary text, such as an explanation or a unit.
pub fn hint(text: impl Into<String>) -> RichText {
    RichText::new(text).text_style(named(HINT)).weak()
}

/// Returns emphasized text in the size of its surroundings.
pub fn strong(text: impl Into<String>) -> RichText {
    RichText::new(text).family(semibold()).strong()
}

/// Returns the title of a card, pane or section.
pub fn heading(text: impl Into<String>) -> RichText {
    RichText::new(text).heading().strong()
}

/// Returns text of a lesson.
pub fn lesson(text: impl Into<String>) -> RichText {
    let text = RichText::new(text).text_style(named(LESSON)).strong();
    text.line_height(Some(26.0))
}

/// Returns the value on a card.
pub fn figure(text: impl Into<String>) -> RichText {
    RichText::new(text).text_style(named(FIGURE)).strong()
}

/// Returns a title that fills a screen.
pub fn display(text: impl Into<String>) -> RichText {
    RichText::new(text).text_style(named(DISPLAY)).strong()
}

/// Returns the font of every text style. None is smaller than 12 pixels.
pub(super) fn text_styles() -> BTreeMap<TextStyle, FontId> {
    [
        (TextStyle::Small, FontId::proportional(12.0)),
        (named(HINT), FontId::proportional(13.0)),
        (TextStyle::Monospace, FontId::monospace(14.0)),
        (TextStyle::Body, FontId::proportional(15.0)),
        (TextStyle::Button, FontId::proportional(15.0)),
        (named(LESSON), FontId::proportional(17.0)),
        (TextStyle::Heading, FontId::new(18.0, semibold())),
        (named(FIGURE), FontId::new(20.0, semibold())),
        (named(DISPLAY), FontId::new(28.0, semibold())),
    ]
    .into()
}

/// Returns the fonts. Every family has its own font, then the icons, then the fonts that come with
/// egui.
pub(super) fn fonts() -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    for (name, data) in [
        (
            "Inter",
            &include_bytes!("../../../assets/fonts/Inter-Regular.ttf")[..],
        ),
        (
            "Inter SemiBold",
            &include_bytes!("../../../assets/fonts/Inter-SemiBold.ttf")[..],
        ),
        (
            "Phosphor",
            &include_bytes!("../../../assets/fonts/Phosphor.ttf")[..],
        ),
    ] {
        let data = Arc::new(FontData::from_static(data));
        fonts.font_data.insert(name.to_owned(), data);
    }
    let proportional = fonts.families[&FontFamily::Proportional].clone();
    let monospace = fonts.families[&FontFamily::Monospace].clone();
    for (family, own, rare) in [
        (
            FontFamily::Proportional,
            "Inter",
            [&proportional, &monospace],
        ),
        (semibold(), "Inter SemiBold", [&proportional, &monospace]),
        (FontFamily::Monospace, "Hack", [&monospace, &proportional]),
    ] {
        let mut chain = vec![own.to_owned(), "Phosphor".to_owned()];
        // Other fonts have glyphs of their own for the codes of some icons.
        for name in rare.into_iter().flatten() {
            if !chain.contains(name) {
                chain.push(name.clone());
            }
        }
        fonts.families.insert(family, chain);
    }
    fonts
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::epaint::text::{Fonts, TextOptions};
    use egui::Color32;
    use std::collections::BTreeSet;
    use std::path::Path;

    fn families() -> [FontFamily; 3] {
        [FontFamily::Proportional, semibold(), FontFamily::Monospace]
    }

    /// Every character of the sources and lessons, written as itself or as an escape.
    fn characters_in_use() -> BTreeSet<char> {
        fn read(path: &Path, found: &mut BTreeSet<char>) {
            if path.is_dir() {
                for entry in std::fs::read_dir(path).unwrap() {
                    read(&entry.unwrap().path(), found);
                }
            } else if let Ok(text) = std::fs::read_to_string(path) {
                let escapes = text.split("\\u{").skip(1).filter_map(|rest| {
                    let code = rest.split('}').next()?;
                    char::from_u32(u32::from_str_radix(code, 16).ok()?)
                });
                found.extend(escapes);
                found.extend(text.chars());
            }
        }
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut found = BTreeSet::new();
        for folder in ["src/gui", "src/present", "src/measure", "assets/lessons"] {
            read(&root.join(folder), &mut found);
        }
        // The last code stands for a character that no font has.
        found.retain(|c| !c.is_control() && *c != char::MAX);
        found
    }

    #[test]
    fn fonts_have_every_character_in_use() {
        let used = characters_in_use();
        for c in "aΔΛ₁−×·…".chars() {
            assert!(used.contains(&c), "{c} was not found");
        }
        let mut fonts = Fonts::new(TextOptions::default(), fonts());
        for family in families() {
            let font = FontId::new(15.0, family);
            for &c in &used {
                assert!(fonts.has_glyph(&font, c), "{font:?}: {c:?}");
            }
        }
    }

    #[test]
    fn common_signs_come_from_inter() {
        let mut fonts = Fonts::new(TextOptions::default(), fonts());
        let mut view = fonts.with_pixels_per_point(1.0);
        for (family, name) in [
            (FontFamily::Proportional, "Inter"),
            (semibold(), "Inter SemiBold"),
        ] {
            let characters = view.characters(&family);
            for c in "aß09ΔΛσ₁₆²−×·…–≤±→".chars() {
                assert_eq!(characters[&c][0], name, "{c}");
            }
        }
    }

    #[test]
    fn icons_come_from_their_font() {
        let source = include_str!("../icons.rs");
        let lines = source.lines().filter(|line| line.contains("pub const"));
        let codes: Vec<char> = lines
            .map(|line| {
                let code = line.split(['{', '}']).nth(1).unwrap();
                char::from_u32(u32::from_str_radix(code, 16).unwrap()).unwrap()
            })
            .collect();
        assert!(codes.len() > 50, "only {} icons", codes.len());
        let mut fonts = Fonts::new(TextOptions::default(), fonts());
        let mut view = fonts.with_pixels_per_point(1.0);
        for family in families() {
            let characters = view.characters(&family);
            for c in &codes {
                let drawn_by = characters.get(c).map(|fonts| fonts[0].as_str());
                assert_eq!(drawn_by, Some("Phosphor"), "{c:?}");
            }
        }
    }

    #[test]
    fn numbers_of_equal_length_have_equal_width() {
        let mut fonts = Fonts::new(TextOptions::default(), fonts());
        let mut view = fonts.with_pixels_per_point(1.0);
        for family in families() {
            for size in [12.0, 15.0, 20.0] {
                let font = FontId::new(size, family.clone());
                let mut width = |text: String| {
                    let galley = view.layout_no_wrap(text, font.clone(), Color32::WHITE);
                    galley.size().x
                };
                let zeros = width("0000\u{a0}000".to_owned());
                assert!(zeros > 3.0 * size, "{zeros}");
                for digit in '1'..='9' {
                    let text = "0000\u{a0}000".replace('0', &digit.to_string());
                    assert_eq!(width(text), zeros, "{font:?}: {digit}");
                }
            }
        }
    }

    #[test]
    fn space_in_numbers_is_half_a_space() {
        let mut fonts = Fonts::new(TextOptions::default(), fonts());
        let mut view = fonts.with_pixels_per_point(1.0);
        for family in [FontFamily::Proportional, semibold()] {
            let font = FontId::new(20.0, family);
            let [half, whole] = ['\u{a0}', ' '].map(|c| view.glyph_width(&font, c));
            assert!((half - whole / 2.0).abs() < 0.1, "{half} {whole}");
        }
    }
}
