//! The theme as egui's style: color, size and distances of every widget.

use super::text::text_styles;
use super::tokens::Tokens;
use egui::style::{Selection, TextCursorStyle, WidgetVisuals, Widgets};
use egui::{CornerRadius, Margin, Spacing, Stroke, Style, Theme, Visuals, vec2};

/// The height of controls and of rows.
pub const ROW: f32 = 28.0;
/// The radius of the corners of controls.
pub const RADIUS: u8 = 4;
/// The radius of the corners of cards, menus and windows.
pub const CARD_RADIUS: u8 = 6;

/// Returns the style of a theme.
pub(super) fn style(theme: Theme) -> Style {
    Style {
        text_styles: text_styles(),
        spacing: spacing(),
        visuals: visuals(theme),
        animation_time: 0.2,
        ..theme.default_style()
    }
}

fn spacing() -> Spacing {
    Spacing {
        item_spacing: vec2(8.0, 4.0),
        // So high that the list of methods is whole on the smallest screen.
        default_area_size: vec2(600.0, 640.0),
        window_margin: Margin::same(12),
        menu_margin: Margin::same(4),
        button_padding: vec2(8.0, 4.0),
        indent: 16.0,
        interact_size: vec2(40.0, ROW),
        icon_width: 16.0,
        icon_width_inner: 10.0,
        icon_spacing: 8.0,
        // All build methods without scrolling.
        combo_height: 480.0,
        combo_width: 90.0,
        ..Spacing::default()
    }
}

fn visuals(theme: Theme) -> Visuals {
    let t = Tokens::of(theme);
    Visuals {
        weak_text_color: Some(t.hint),
        widgets: widgets(t),
        // The stroke is the color of selected text, and the focus ring of text fields.
        selection: Selection {
            bg_fill: t.selected,
            stroke: Stroke::new(2.0, t.text),
        },
        hyperlink_color: t.accent,
        faint_bg_color: t.card,
        extreme_bg_color: t.ground,
        code_bg_color: t.control,
        warn_fg_color: t.warning,
        error_fg_color: t.error,
        window_corner_radius: CornerRadius::same(CARD_RADIUS),
        window_fill: t.card,
        window_stroke: Stroke::new(1.0, t.divider),
        menu_corner_radius: CornerRadius::same(CARD_RADIUS),
        panel_fill: t.panel,
        text_cursor: TextCursorStyle {
            stroke: Stroke::new(2.0, t.accent),
            ..TextCursorStyle::default()
        },
        slider_trailing_fill: true,
        ..theme.default_visuals()
    }
}

fn widgets(t: &Tokens) -> Widgets {
    let widget = |fill, outline, text| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: outline,
        fg_stroke: Stroke::new(1.0, text),
        corner_radius: CornerRadius::same(RADIUS),
        expansion: 0.0,
    };
    let border = Stroke::new(1.0, t.border);
    Widgets {
        noninteractive: widget(t.panel, Stroke::new(1.0, t.divider), t.label),
        inactive: widget(t.control, border, t.text),
        hovered: widget(t.hover, border, t.text),
        // Pressed, or with the focus.
        active: widget(t.hover, Stroke::new(2.0, t.border), t.text),
        open: widget(t.hover, border, t.text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn no_text_style_is_smaller_than_12() {
        for theme in [Theme::Dark, Theme::Light] {
            let styles = style(theme).text_styles;
            assert_eq!(styles.len(), 9);
            for (name, font) in styles {
                assert!(font.size >= 12.0, "{name}: {}", font.size);
            }
        }
    }

    /// Text that is painted has fonts of its own.
    #[test]
    fn no_painted_text_is_smaller_than_12() {
        fn check(folder: &Path, found: &mut usize) {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    check(&path, found);
                    continue;
                }
                let source = std::fs::read_to_string(&path).unwrap();
                for call in [
                    "FontId::proportional(",
                    "FontId::monospace(",
                    "FontId::new(",
                    ".size(",
                ] {
                    for rest in source.split(call).skip(1) {
                        let size = rest.split([',', ')']).next().unwrap();
                        if let Ok(size) = size.parse::<f32>() {
                            assert!(size >= 12.0, "{}: {call}{size}", path.display());
                            *found += 1;
                        }
                    }
                }
            }
        }
        let mut found = 0;
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        check(&root.join("src/gui"), &mut found);
        assert!(found > 9, "only {found} fonts found");
    }

    #[test]
    fn widgets_have_the_colors_of_their_theme() {
        for theme in [Theme::Dark, Theme::Light] {
            let (t, visuals) = (Tokens::of(theme), visuals(theme));
            assert_eq!(visuals.dark_mode, theme == Theme::Dark);
            assert_eq!(visuals.text_color(), t.label);
            assert_eq!(visuals.strong_text_color(), t.text);
            assert_eq!(visuals.weak_text_color(), t.hint);
            assert_eq!(visuals.window_fill(), t.card);
            // Whatever has the focus has a ring 2 wide.
            assert_eq!(visuals.widgets.active.bg_stroke.width, 2.0);
            assert_eq!(visuals.selection.stroke, Stroke::new(2.0, t.text));
        }
    }
}
