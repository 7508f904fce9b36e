//! A color of the picture in words.

use egui::ecolor::gamma_u8_from_linear_f32;

/// A pixel's colour in words: linear values and 8-bit sRGB.
pub fn color_text(color: [f32; 3]) -> String {
    let [r, g, b] = color;
    let [r8, g8, b8] = color.map(gamma_u8_from_linear_f32);
    format!("linear {r:.3} {g:.3} {b:.3} · sRGB #{r8:02x}{g8:02x}{b8:02x}")
}
