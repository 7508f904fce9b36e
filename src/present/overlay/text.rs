//! Draws text into images without a window.
//!
//! `imageproc` draws text, too, but it is a large image-processing library. This needs 60 lines on
//! top of `ab_glyph`.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use image::{Rgb, RgbImage};

/// A pen that draws text of one size and color.
pub struct Pen {
    font: FontRef<'static>,
    scale: PxScale,
    color: [u8; 3],
}

impl Pen {
    /// Creates a pen. `size` is the height of a line in pixels.
    pub fn new(size: f32, color: [u8; 3]) -> Pen {
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT)
            .expect("the font is part of the program");
        Pen {
            font,
            scale: PxScale::from(size),
            color,
        }
    }

    /// Returns the distance between lines, in pixels.
    pub fn line_height(&self) -> u32 {
        let font = self.font.as_scaled(self.scale);
        (font.height() + font.line_gap()).ceil() as u32
    }

    /// Returns the width of a text in pixels.
    pub fn width(&self, text: &str) -> u32 {
        self.walk(text, |_, _| ()).ceil() as u32
    }

    /// Breaks the text between words into lines of at most this width. A longer word stays in one
    /// piece.
    pub fn wrapped(&self, text: &str, width: u32) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split(' ') {
            match lines.last_mut() {
                Some(line) if self.width(&format!("{line} {word}")) <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines
    }

    /// Draws a line of text with its upper left corner at (`x`, `y`). Clips what lies outside the
    /// image.
    pub fn draw(&self, image: &mut RgbImage, x: u32, y: u32, text: &str) {
        let top = y as f32 + self.font.as_scaled(self.scale).ascent();
        self.walk(text, |glyph, along| {
            let placed = glyph.with_scale_and_position(self.scale, point(x as f32 + along, top));
            let Some(outline) = self.font.outline_glyph(placed) else {
                return;
            };
            let corner = outline.px_bounds().min;
            outline.draw(|column, row, covered| {
                let (px, py) = (
                    corner.x as i64 + i64::from(column),
                    corner.y as i64 + i64::from(row),
                );
                let (Ok(px), Ok(py)) = (u32::try_from(px), u32::try_from(py)) else {
                    return;
                };
                if let Some(Rgb(pixel)) = image.get_pixel_mut_checked(px, py) {
                    for (value, ink) in pixel.iter_mut().zip(self.color) {
                        let covered = covered.clamp(0.0, 1.0);
                        let mixed =
                            f32::from(*value) + (f32::from(ink) - f32::from(*value)) * covered;
                        *value = mixed.round() as u8;
                    }
                }
            });
        });
    }

    /// Calls back with each glyph and its offset along the line. Returns the width of the line.
    fn walk(&self, text: &str, mut each: impl FnMut(ab_glyph::GlyphId, f32)) -> f32 {
        let font = self.font.as_scaled(self.scale);
        let (mut along, mut last) = (0.0, None);
        for c in text.chars() {
            let glyph = font.glyph_id(c);
            along += last.map_or(0.0, |last| font.kern(last, glyph));
            each(glyph, along);
            along += font.h_advance(glyph);
            last = Some(glyph);
        }
        along
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_characters_of_numbers_have_glyphs() {
        let pen = Pen::new(16.0, [0; 3]);
        let missing = pen.font.glyph_id('\u{10ffff}');
        for c in ['\u{a0}', '−', '×', 'µ', '–', '³', '≤'] {
            assert_ne!(pen.font.glyph_id(c), missing, "{c:?}");
        }
        assert_eq!(pen.width("1\u{a0}200"), pen.width("1 200"));
    }
}
