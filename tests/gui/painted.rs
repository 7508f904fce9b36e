//! The texts that the window painted in its last frame, as a person sees them.

use crate::harness::Window;
use egui::Rect;
use egui::epaint::{Shape, TextShape};

/// A text on the screen.
#[derive(Clone, Debug)]
pub struct Text {
    /// Its rows, as they are broken.
    pub rows: Vec<String>,
    /// Whether its end is replaced by an ellipsis.
    pub is_elided: bool,
    /// Whether a side of it is not painted.
    pub is_clipped: bool,
    /// Its smallest font, in points.
    pub size: f32,
    /// Where it is.
    pub rect: Rect,
}

impl Text {
    /// Whether a row ends inside a number, or between a number and its unit.
    pub fn breaks_a_number(&self) -> bool {
        self.rows.windows(2).any(|pair| {
            let (end, start) = (pair[0].chars().last(), pair[1].chars().next());
            let is_of_number = |c: Option<char>| {
                c.is_some_and(|c| c.is_ascii_digit() || matches!(c, '.' | '%' | '\u{a0}'))
            };
            is_of_number(end) && is_of_number(start)
        })
    }
}

/// Returns all texts whose middle lies in this part of the window and that are not clipped away.
pub fn texts_in(window: &Window<'_>, part: Rect) -> Vec<Text> {
    let mut found = Vec::new();
    for clipped in &window.output().shapes {
        collect(&clipped.shape, clipped.clip_rect, part, &mut found);
    }
    found
}

fn collect(shape: &Shape, clip: Rect, part: Rect, found: &mut Vec<Text>) {
    match shape {
        Shape::Vec(shapes) => {
            for shape in shapes {
                collect(shape, clip, part, found);
            }
        }
        Shape::Text(TextShape { pos, galley, .. }) => {
            let rect = galley.rect.translate(pos.to_vec2());
            if clip.intersect(part).contains(rect.center()) {
                let room = clip.expand(1.0).x_range();
                let sections = galley.job.sections.iter();
                let sizes = sections.map(|section| section.format.font_id.size);
                let is_inside = room.contains(rect.left()) && room.contains(rect.right());
                found.push(Text {
                    rows: galley.rows.iter().map(|row| row.text()).collect(),
                    is_elided: galley.elided,
                    is_clipped: !is_inside,
                    size: sizes.fold(f32::INFINITY, f32::min),
                    rect,
                });
            }
        }
        _ => {}
    }
}

/// Asserts that in this part of the window, which does not scroll sideways, no text is cut and no number
/// is broken, and that there are texts.
pub fn assert_whole(window: &Window<'_>, part: Rect) {
    let texts = texts_in(window, part);
    assert!(texts.len() > 5, "{texts:?}");
    for text in texts {
        let is_cut = text.is_elided || text.is_clipped;
        assert!(!is_cut && !text.breaks_a_number(), "{text:?}");
    }
}
