//! The colors, by their role.
//!
//! The tests below check that each can be read, with the contrast ratio of WCAG 2.

use egui::{Color32, Theme};

/// The colors of one theme. Surfaces come first, from the back to the front.
pub struct Tokens {
    /// Behind the panels, and in text fields.
    pub ground: Color32,
    pub panel: Color32,
    /// Cards, menus, windows and tooltips.
    pub card: Color32,
    /// Buttons and other controls.
    pub control: Color32,
    /// A control under the pointer.
    pub hover: Color32,
    /// Selected items; text on it must have the color [`Tokens::text`].
    pub selected: Color32,
    /// Lines between parts of the window.
    pub divider: Color32,
    /// Outlines of controls, and of the widget with the focus.
    pub border: Color32,
    /// Values, headings and the text of controls.
    pub text: Color32,
    /// The names of values, and sentences.
    pub label: Color32,
    /// Secondary text, such as explanations and units.
    pub hint: Color32,
    /// Links, the main button, progress.
    pub accent: Color32,
    /// Text on [`Tokens::accent`].
    pub on_accent: Color32,
    /// Tree A of two that are compared.
    pub a: Color32,
    /// Tree B of two that are compared.
    pub b: Color32,
    pub better: Color32,
    pub worse: Color32,
    pub warning: Color32,
    pub error: Color32,
}

impl Tokens {
    /// Returns the colors of a theme.
    pub fn of(theme: Theme) -> &'static Tokens {
        match theme {
            Theme::Dark => &DARK,
            Theme::Light => &LIGHT,
        }
    }
}

static DARK: Tokens = Tokens {
    ground: rgb(0x0f1216),
    panel: rgb(0x171b21),
    card: rgb(0x1f242c),
    control: rgb(0x2b323c),
    hover: rgb(0x343d49),
    selected: rgb(0x1d4a78),
    divider: rgb(0x333b46),
    border: rgb(0x8793a3),
    text: rgb(0xf4f6f8),
    label: rgb(0xd6dce4),
    hint: rgb(0xaab4c1),
    accent: rgb(0x7cc0ff),
    on_accent: rgb(0x0f1216),
    a: rgb(0xffb74d),
    b: rgb(0x6ccbff),
    better: rgb(0x7fe3da),
    worse: rgb(0xff9a76),
    warning: rgb(0xf5cf5b),
    error: rgb(0xff9c9c),
};

static LIGHT: Tokens = Tokens {
    ground: rgb(0xe6e9ee),
    panel: rgb(0xf5f6f8),
    card: rgb(0xffffff),
    control: rgb(0xe4e8ee),
    hover: rgb(0xd8dee6),
    selected: rgb(0xcfe3fa),
    divider: rgb(0xc3cad3),
    border: rgb(0x6b7686),
    text: rgb(0x12161c),
    label: rgb(0x2f3742),
    hint: rgb(0x4a5462),
    accent: rgb(0x0a4fa3),
    on_accent: rgb(0xffffff),
    a: rgb(0x7a4100),
    b: rgb(0x004e7d),
    better: rgb(0x00566b),
    worse: rgb(0x8c2d08),
    warning: rgb(0x654900),
    error: rgb(0x961217),
};

const fn rgb(code: u32) -> Color32 {
    let [_, r, g, b] = code.to_be_bytes();
    Color32::from_rgb(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Red, green and blue as amounts of light from 0 to 1.
    fn linear(color: Color32) -> [f64; 3] {
        [color.r(), color.g(), color.b()].map(|byte| {
            let value = f64::from(byte) / 255.0;
            if value <= 0.04045 {
                value / 12.92
            } else {
                ((value + 0.055) / 1.055).powf(2.4)
            }
        })
    }

    fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// The contrast ratio of WCAG 2, from 1 to 21.
    fn contrast(a: Color32, b: Color32) -> f64 {
        let luminance = |color| {
            let [r, g, b] = linear(color);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// What a person without red cones sees, after F. Viénot, H. Brettel and J. Mollon, "Digital
    /// video colourmaps for checking the legibility of displays by dichromats" (1999).
    fn protanopia(light: [f64; 3]) -> [f64; 3] {
        times(
            [
                [0.11238, 0.88762, 0.0],
                [0.11238, 0.88762, 0.0],
                [0.00401, -0.00401, 1.0],
            ],
            light,
        )
    }

    /// CIE L*a*b* under D65.
    fn lab(light: [f64; 3]) -> [f64; 3] {
        let xyz = times(
            [
                [0.4124564, 0.3575761, 0.1804375],
                [0.2126729, 0.7151522, 0.0721750],
                [0.0193339, 0.1191920, 0.9503041],
            ],
            light,
        );
        let root = |t: f64| {
            if t > 216.0 / 24389.0 {
                t.cbrt()
            } else {
                t * 841.0 / 108.0 + 4.0 / 29.0
            }
        };
        let [x, y, z] = [xyz[0] / 0.95047, xyz[1], xyz[2] / 1.08883].map(root);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// The distance of two colors in L*a*b* (CIE76).
    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        let [a, b] = [lab(a), lab(b)];
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    }

    fn assert_contrast(least: f64, name: &str, front: Color32, backs: &[Color32]) {
        for &back in backs {
            let found = contrast(front, back);
            assert!(
                found >= least,
                "{name} {front:?} on {back:?}: {found:.2} < {least}"
            );
        }
    }

    #[test]
    fn contrast_is_that_of_wcag() {
        let gray = Color32::from_rgb(0x76, 0x76, 0x76);
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
        assert!((contrast(gray, Color32::WHITE) - 4.54).abs() < 0.01);
    }

    #[test]
    fn text_can_be_read_on_every_surface() {
        for t in [&DARK, &LIGHT] {
            let surfaces = [t.ground, t.panel, t.card, t.control, t.hover];
            assert_contrast(10.0, "text", t.text, &surfaces);
            assert_contrast(7.8, "label", t.label, &surfaces);
            assert_contrast(5.1, "hint", t.hint, &surfaces);
            assert_contrast(3.4, "border", t.border, &surfaces);
            assert_contrast(8.4, "text", t.text, &[t.selected]);
            assert_contrast(7.3, "on_accent", t.on_accent, &[t.accent]);
        }
    }

    #[test]
    fn colored_text_can_be_read_on_panels_and_cards() {
        for t in [&DARK, &LIGHT] {
            for (name, color) in [
                ("accent", t.accent),
                ("a", t.a),
                ("b", t.b),
                ("better", t.better),
                ("worse", t.worse),
                ("warning", t.warning),
                ("error", t.error),
            ] {
                assert_contrast(7.3, name, color, &[t.panel, t.card]);
            }
        }
    }

    #[test]
    fn better_and_worse_differ_without_red_cones() {
        for t in [&DARK, &LIGHT] {
            let [better, worse] = [t.better, t.worse].map(|color| protanopia(linear(color)));
            let found = distance(better, worse);
            assert!(found >= 32.0, "{found:.1}");
        }
    }
}
